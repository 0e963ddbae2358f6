"""Reads the Markdown files of `rules/`, one for each built-in rule: a head of `key: value` lines, and its page."""

import re
from typing import TYPE_CHECKING

from twinform.lazy import lazy_pattern
from twinform.package_files import package_files

if TYPE_CHECKING:
    from importlib.resources.abc import Traversable

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
