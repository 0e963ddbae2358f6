"""Markdown: tables, lists and sections of pages."""

import re
from collections import Counter
from collections.abc import Iterable, Sequence
from typing import TypeVar

_PREDICATE = re.compile(r"\[[^]]*\]")
Key = TypeVar("Key", str, tuple[str, ...])
Group = TypeVar("Group")
Item = TypeVar("Item")


def table(head: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    """A Markdown table; numbers are aligned to the right, and a column without a name says what its row is about."""
    body = [[_cell(value) for value in row] for row in rows]
    numeric = [bool(body) and all(_is_number(row[i]) for row in body) for i in range(len(head))]
    rule = ["---:" if number else "---" for number in numeric]
    names = [name or "what" for name in head]
    return "\n".join("| " + " | ".join(cells) + " |" for cells in [names, rule, *body]) + "\n"


def listing(
    head: Sequence[str], rows: Iterable[Sequence[object]], *, empty: str = "None.", most: int | None = None
) -> str:
    """A table of the first rows, with how many more there are; another text where there is no row."""
    every = list(rows)
    more = f"\n{len(every) - most} more.\n" if most is not None and len(every) > most else ""
    return table(head, every[:most]) + more if every else empty


def cross_table(head: Sequence[str], met: Iterable[tuple[str, ...]], columns: Iterable[str]) -> str:
    """How often each of `columns` is met with what stands before it: `head` names that, and each has a row."""
    counts, shown = Counter(met), list(columns)
    rows = dict.fromkeys(key[:-1] for key in counts)
    return table([*head, *shown], [(*row, *(counts[(*row, column)] for column in shown)) for row in rows])


def example_rows(pairs: Iterable[tuple[tuple[str, ...], str]]) -> list[tuple[object, ...]]:
    """A row for each key: its parts, how often it is there, and the first of its examples; the most frequent first."""
    return [(*key, count, example) for key, count, example in frequent(pairs)]


def frequent(pairs: Iterable[tuple[Key, str]]) -> list[tuple[Key, int, str]]:
    """How often each key is there, with the first of its examples: the most frequent keys first, then by key."""
    counts, examples = Counter[Key](), dict[Key, str]()
    for key, example in pairs:
        counts[key] += 1
        examples.setdefault(key, example)
    return sorted(((key, count, examples[key]) for key, count in counts.items()), key=lambda row: (-row[1], row[0]))


def grouped(pairs: Iterable[tuple[Group, Item]]) -> dict[Group, list[Item]]:
    """The second of each pair by the first, in the order in which they are met."""
    found: dict[Group, list[Item]] = {}
    for group, item in pairs:
        found.setdefault(group, []).append(item)
    return found


def first(names: Sequence[str], most: int | None = 3) -> str:
    """So many names, and whether there are more."""
    return ", ".join(names[:most]) + (", .." if most is not None and len(names) > most else "")


def rule_links(rules: Iterable[str], root: str = "../..") -> str:
    """Links to the pages of rules; `root` leads from the page to the root of the repository."""
    return ", ".join(f"[{rule}]({root}/twinform/diagnostics/rules/{rule}.md)" for rule in rules)


def without_names(path: str) -> str:
    """A path in XML without what distinguishes one element from its like, such as its name."""
    return _PREDICATE.sub("", path)


def subsection(title: str, *parts: str) -> str:
    """A part of a section, with a heading of its own."""
    return paragraphs(f"### {title}", *parts)


def anchor(title: str) -> str:
    """The anchor of a heading."""
    return re.sub(r"[^\w\- ]", "", title.lower()).strip().replace(" ", "-")


def paragraphs(*parts: str) -> str:
    """The parts with an empty line between them."""
    return "\n\n".join(part.strip("\n") for part in parts if part.strip())


def _cell(value: object) -> str:
    return str(value).replace("|", "\\|").replace("\n", " ")


def _is_number(cell: str) -> bool:
    return cell.replace(".", "", 1).replace(",", "").removeprefix("-").removesuffix("%").isdigit()
