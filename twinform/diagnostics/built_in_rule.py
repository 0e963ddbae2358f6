"""Built-in rules: what a finding needs of them is in a generated table; their pages are read when somebody asks."""

import re
from collections.abc import Mapping
from typing import TYPE_CHECKING

from twinform.diagnostics.diagnostic import Rule, Safety, Severity
from twinform.lazy import lazy_pattern
from twinform.package_files import package_files

if TYPE_CHECKING:
    from importlib.resources.abc import Traversable


def rule(
    name: str,
    severity: Severity,
    *,
    strict: Severity | None = None,
    fix: Safety | None = None,
    fatal: bool = False,
    unsound: bool = False,
    group: str = "structure",
) -> Rule:
    """Make a rule whose page is a file of `rules/`."""
    made = _BuiltInRule.__new__(_BuiltInRule)
    levels = {"severity": severity, "strict": strict, "fix": fix}
    _fill(made, {"name": name, **levels, "fatal": fatal, "unsound": unsound, "group": group})
    return made


class _BuiltInRule(Rule):
    """A rule whose page is read when one of its texts is first asked for."""

    __slots__ = ()
    __module__ = "twinform.diagnostics.rules"  # where pickle looks for the constant

    def __getattr__(self, field: str) -> str:
        # Python calls this where a slot is unset

        page = read_page(self.name)
        if field not in page:
            raise AttributeError(f"a rule has no {field}")
        _fill(self, page)
        return page[field]

    def __reduce__(self) -> str:
        # findings travel between processes: pickle writes the name of the constant, which the other process has too
        return self.name.upper().replace("-", "_")


def _fill(rule: Rule, values: Mapping[str, object]) -> None:
    for field, value in values.items():
        object.__setattr__(rule, field, value)


HEADINGS = {
    "What it finds": "finds",
    "Why it matters": "matters",
    "Example": "example",
    "Better": "better",
    "References": "references",
}
"""The headings of a page, and the fields of `Rule` that they are. The last one may be left out."""
# A run needs the name and the severity of each rule, and no page. The heads are generated into
# `rules/__init__.py`; a page is read when `explain`, an editor or SARIF asks for it.
_FILE = lazy_pattern(r"---\n(?P<head>([a-z]+: .+\n)+)---\n(?P<page>(\n## .+\n(\n([^#\n].*\n)+)+)+)")
_SECTION = lazy_pattern(r"^## (.+)\n((?:\n(?:[^#\n].*\n)+)+)", re.MULTILINE)


def rule_names() -> list[str]:
    """The names of all built-in rules, sorted."""
    files = (file.name for file in _folder().iterdir())
    return sorted(name.removesuffix(".md") for name in files if name.endswith(".md"))


def read_head(name: str) -> dict[str, str]:
    """Read the head of a rule's file: the fields of `Rule` other than its name and page.

    Raises:
        ValueError: the file is not a head and paragraphs below each heading, in their order.
    """
    found = _FILE.fullmatch(_text(name))
    if found is None:
        raise ValueError(f"{name}.md is not a head between two lines of --- and paragraphs below each heading")
    headings = [heading for heading, _ in _SECTION.findall(found["page"])]
    if headings not in (list(HEADINGS), list(HEADINGS)[:-1]):
        raise ValueError(f"{name}.md has the headings {', '.join(headings)}; expected are {', '.join(HEADINGS)}")
    return dict(line.split(": ", 1) for line in found["head"].splitlines())


def read_page(name: str) -> dict[str, str]:
    """Read the page of a built-in rule: a text for each field of `Rule`, with one line for each paragraph."""
    sections = _SECTION.findall(_text(name))
    return {"references": "", **{HEADINGS[heading]: _unwrapped(text) for heading, text in sections}}


def _unwrapped(text: str) -> str:
    return "\n\n".join(" ".join(paragraph.split()) for paragraph in text.split("\n\n"))


def _text(name: str) -> str:
    return _folder().joinpath(f"{name}.md").read_text(encoding="utf-8")


def _folder() -> "Traversable":
    return package_files("twinform.diagnostics").joinpath("rules")
