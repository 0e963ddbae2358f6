"""Makes the pages of features from what was measured."""

import json
from collections.abc import Iterator, Mapping, Sequence
from typing import NotRequired, TypedDict

from lxml import etree

from testbed.corpus.files import ROOT
from testbed.markdown import grouped, paragraphs, table

FOLDER = ROOT / "docs" / "reference" / "who_reads_what"
CELLS = FOLDER / "cells.json"
_ABOUT = """\
# Who reads what?

What programs make of URDF and SDF, feature by feature: each row is [a file of about ten lines](#how-it-was-found-out)
that asks one question, each column a program in one release. A row leads to the file, to what each program said and
kept, and to what helps.

* **reads**: it takes the file without a word, and what can be counted is there: joints that move, masses, shapes.
* **warns**: it takes the file and writes a warning or an error on the terminal.
* **differs**: it takes the file, and leaves something out or reads it otherwise.
* **refuses**: it throws, returns nothing, crashes or comes to no end.
* An empty cell: it does not read the format, or nothing is known. *In italics*: it was not asked; its sources were
  read.

[cells.json](cells.json) has all of it for programs."""
_METHOD = """\
## How it was found out

`make report NAME=who_reads_what` asks the programs that are installed, each in a process of its own, compares the
verdicts with those of the last time, names each that changed, and writes these pages. How a program is asked, and how
often it is as [its profile](../profiles/README.md) says, stands in
[the evidence](../../evidence/who_reads_it.md#who-reads-what). The files are in `twinform/profiles/data/features/`.
`twinform check --for NAME` looks for the same in your own file, and `twinform explain joints/mimic` shows a feature on
the terminal.

`cells.json` has three lists: `consumers` (`name`, `title`, `release`, `also`, which are other names of the release,
`formats`, whether they were `measured`, and the `source`), `features` (`name`, `format`, `title`, `question`, and the
`file`), and `cells`: `feature`, `consumer`, `verdict`; where they are not empty, `measured`, which is what was seen,
the `message`, what was `kept` where that differs, the `rows` of the profile, and how it `disagrees`. A key may be
added; none is renamed."""


class Consumer(TypedDict):
    """A column."""

    name: str
    title: str
    release: str
    also: list[str]
    formats: list[str]
    measured: bool
    source: str


class FeatureRow(TypedDict):
    """A row."""

    name: str
    format: str
    title: str
    question: str
    file: str


class CellRow(TypedDict):
    """What a consumer makes of a feature."""

    feature: str
    consumer: str
    verdict: str
    measured: NotRequired[str]
    message: NotRequired[str]
    kept: NotRequired[str]
    rows: NotRequired[list[str]]
    disagrees: NotRequired[str]


class Matrix(TypedDict):
    """The document of `cells.json`."""

    consumers: list[Consumer]
    features: list[FeatureRow]
    cells: list[CellRow]


def measured_pages() -> dict[str, str]:
    """The pages of what was measured last."""
    return pages(CELLS.read_text(encoding="utf-8"))


def pages(text: str) -> dict[str, str]:
    """The matrix, and a page for each group of features, by the names of their files."""
    matrix: Matrix = json.loads(text)
    groups = grouped((each["name"].partition("/")[0], each) for each in matrix["features"])
    found = {(each["feature"], each["consumer"]): each for each in matrix["cells"]}
    return {
        "README.md": _matrix_page(matrix["consumers"], groups, found),
        **{f"{name}.md": _group_page(name, features, matrix, found) for name, features in groups.items()},
    }


_Found = Mapping[tuple[str, str], CellRow]


def _matrix_page(consumers: Sequence[Consumer], groups: Mapping[str, list[FeatureRow]], found: _Found) -> str:
    columns = merge_columns(consumers, [each for features in groups.values() for each in features], found)
    parts = (_group_part(name, features, columns, found) for name, features in groups.items())
    return paragraphs(_ABOUT, '<div id="matrix" markdown>', *parts, "</div>", _METHOD) + "\n"


def merge_columns(consumers: Sequence[Consumer], features: Sequence[FeatureRow], found: _Found) -> list[list[Consumer]]:
    """Releases of a program that follow each other and of which the same is said: they share a column."""
    columns, last = list[list[Consumer]](), None
    for each in consumers:
        said = [_verdict(found.get((feature["name"], each["name"]))) for feature in features]
        if columns and last == (each["title"], said):
            columns[-1].append(each)
        else:
            columns.append([each])
        last = (each["title"], said)
    return columns


def _group_part(name: str, features: Sequence[FeatureRow], columns: Sequence[Sequence[Consumer]], found: _Found) -> str:
    head = ["feature", "format", *(_heading(each) for each in columns)]
    rows = (
        [_link(each), each["format"], *(_verdict(found.get((each["name"], one[0]["name"]))) for one in columns)]
        for each in features
    )
    part = paragraphs(f"## {name.capitalize()}", table(head, rows))
    return paragraphs('<div class="matrix-part" markdown>', part, "</div>")


def _heading(column: Sequence[Consumer]) -> str:
    first, last = column[0], column[-1]
    releases = first["release"] if first is last else f"{first['release']} to {last['release']}"
    return f"[{first['title']}](../profiles/{_profile(first)}.md) {releases}"


def _profile(consumer: Consumer) -> str:
    return consumer["name"].partition("@")[0]


def _link(feature: FeatureRow) -> str:
    group, _, stem = feature["name"].partition("/")
    return f"[{_escape(feature['title'])}]({group}.md#{stem})"


def _verdict(cell: CellRow | None) -> str:
    if cell is None:
        return ""
    return cell["verdict"] if "measured" in cell else f"*{cell['verdict']}*"


def _group_page(name: str, features: Sequence[FeatureRow], matrix: Matrix, found: _Found) -> str:
    about = f"# Who reads what: {name}\n\nA part of [the matrix](README.md), which says what the words mean."
    return paragraphs(about, *(_feature_part(each, matrix["consumers"], found) for each in features)) + "\n"


def _feature_part(feature: FeatureRow, consumers: Sequence[Consumer], found: _Found) -> str:
    stem = feature["name"].partition("/")[2]
    cells = [
        (each, found[feature["name"], each["name"]]) for each in consumers if (feature["name"], each["name"]) in found
    ]
    alike = grouped((tuple(_describe_cell(cell)), consumer) for consumer, cell in cells)
    rows = ([verdict, _label(who), *rest] for (verdict, *rest), who in sorted(alike.items(), key=_gravest))
    text = feature["file"].rstrip("\n")
    return paragraphs(
        f"## {stem}",
        f"**{_escape(feature['title'])}.** {_escape(feature['question'])}",
        f"```{'xml' if _is_xml(text) else 'text'}\n{text}\n```",
        table(["verdict", "of", "seen", "by its profile"], rows),
    )


def _is_xml(text: str) -> bool:
    """Whether a text can be shown as XML; some files are no XML on purpose."""
    try:
        etree.fromstring(f"<robot>{text}</robot>")
    except etree.XMLSyntaxError:
        return False
    return True


def _gravest(item: tuple[tuple[str, ...], list[Consumer]]) -> int:
    return -("*reads*", "reads", "*warns*", "warns", "*differs*", "differs", "*refuses*", "refuses").index(item[0][0])


def _describe_cell(cell: CellRow) -> Iterator[str]:
    yield _verdict(cell)
    message, kept = cell.get("message", ""), cell.get("kept", "")
    shown = [f"`{message.replace('`', chr(39))}`"] if message else []
    yield "; ".join([*shown, *([f"keeps {_escape(kept)}"] if kept and cell["verdict"] == "differs" else [])])
    yield _escape("; ".join(cell.get("rows", [])))


def _label(consumers: Sequence[Consumer]) -> str:
    releases = grouped((_profile(each), each["release"]) for each in consumers)
    return ", ".join(f"[{name}](../profiles/{name}.md) {', '.join(each)}" for name, each in releases.items())


def _escape(text: str) -> str:
    return text.replace("<", "\\<").replace("*", "\\*")
