"""The pages for people: links lead somewhere, the map names files that exist, and the glossary can be searched."""

import re
from functools import cache
from pathlib import Path

import pytest

_ROOT = Path(__file__).parents[1]
_MAP = _ROOT / "ARCHITECTURE.md"
_PAGES = [
    _ROOT / "README.md",
    _MAP,
    _ROOT / "CONTRIBUTING.md",
    _ROOT / "SECURITY.md",
    *sorted((_ROOT / "docs").rglob("*.md")),
]
_CODE = re.compile(r"^```.*?^```$", re.MULTILINE | re.DOTALL)
_LINK = re.compile(r"\]\((?!https?:)([^)#\s]*)(?:#([^)\s]*))?\)")
_PLACEHOLDER = re.compile(r"[A-Z_]{4,}|[{}*]")
"""Part of a path in the map that stands for many, such as NAME."""


@cache
def _anchors(page: Path) -> set[str]:
    headings = re.findall(r"^#+ (.*)$", _CODE.sub("", page.read_text(encoding="utf-8")), re.MULTILINE)
    return {_anchor(heading) for heading in headings}


def _anchor(heading: str) -> str:
    return re.sub(r"[^\w\- ]", "", heading.lower()).strip().replace(" ", "-")


@pytest.mark.parametrize("page", _PAGES, ids=lambda page: page.relative_to(_ROOT).as_posix())
def test_links_lead_somewhere(page: Path) -> None:
    text = re.sub(r"`[^`\n]*`", "", _CODE.sub("", page.read_text(encoding="utf-8")))
    for path, anchor in _LINK.findall(text):
        target = (page.parent / path).resolve() if path else page
        assert target.exists(), path
        assert not anchor or target.suffix != ".md" or anchor in _anchors(target), f"{path}#{anchor}"


def test_agents_are_led_to_pages_that_there_are() -> None:
    list_ = _ROOT / "docs/llms.txt"
    paths = re.findall(r"^- \[[^\]]+\]\(([^)]+)\): \S", list_.read_text(encoding="utf-8"), re.MULTILINE)
    assert len(paths) > 10
    assert [path for path in paths if not (list_.parent / path).with_suffix(".md").is_file()] == []


def test_numbers_of_the_readme_are_those_that_were_measured() -> None:
    links = re.findall(
        r"\[([^\]]*\d[^\]]*)\]\((docs/evidence/[^)#]*)#([^)]*)\)", (_ROOT / "README.md").read_text("utf-8")
    )
    assert links
    for text, page, anchor in links:
        section = _section((_ROOT / page).read_text("utf-8"), anchor)
        cells = {cell.strip().replace(",", "") for line in section.splitlines() for cell in line.split("|")}
        assert [number for number in re.findall(r"\d[\d.,]*\d|\d", text) if number.replace(",", "") not in cells] == []


def _section(text: str, anchor: str) -> str:
    """The part of a page from a heading to the next one."""
    return next(
        part for part in re.split(r"^#+ ", text, flags=re.MULTILINE) if _anchor(part.partition("\n")[0]) == anchor
    )


def test_the_map_is_short_and_names_what_there_is() -> None:
    text = _MAP.read_text(encoding="utf-8")
    assert len(text.splitlines()) <= 100
    paths = [path for path in re.findall(r"`([\w.]+/[\w./]+)`", text) if not _PLACEHOLDER.search(path)]
    rooms = [_ROOT, _ROOT / "twinform", *(_ROOT / "twinform").iterdir()]
    assert [path for path in paths if not any((room / path).exists() for room in rooms)] == []


def test_the_glossary_is_in_alphabetical_order() -> None:
    text = (_ROOT / "docs/explanation/glossary.md").read_text(encoding="utf-8")
    words = [word.lower() for word in re.findall(r"^\*\*(.+?)\.\*\*", text, re.MULTILINE)]
    assert words == sorted(words)
