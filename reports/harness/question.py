"""A question that a page of `docs/evidence` answers, in sections that are measured one by one."""

import ast
import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib import import_module
from pathlib import Path

from reports.harness.section import Section
from testbed.corpus.files import ROOT
from testbed.markdown import anchor, paragraphs

NAMES = (
    "same_robot", "who_reads_it", "text_survives", "mistakes_found",
    "speed", "safety", "worlds_and_packages", "fixes_and_passes",
)  # fmt: skip
_REPORTS = Path(__file__).parents[1]
_SECTION = re.compile(r"^(?=## )", re.MULTILINE)


@dataclass(frozen=True, slots=True)
class Question:
    """A question, and the titles of its sections by their names, in the order of the page."""

    name: str
    title: str
    sections: Mapping[str, str]

    @property
    def page(self) -> Path:
        """The page that answers it."""
        return ROOT / "docs" / "evidence" / f"{self.name}.md"

    def section(self, name: str) -> Section:
        """The section of a name, whose module is imported only now: some need programs of their own."""
        return import_module(f"reports.{self.name}.{name}").SECTION

    def asked(self, name: str) -> str:
        """What a section asks: the first line of the docstring of its module."""
        text = (_REPORTS / self.name / f"{name}.py").read_text(encoding="utf-8")
        return (ast.get_docstring(ast.parse(text)) or "").partition("\n")[0]

    def text(self, measured: Mapping[str, str]) -> str:
        """The page with the sections that were measured, by name; the others stay as they stand in it."""
        before = self.page.read_text(encoding="utf-8") if self.page.is_file() else ""
        texts = sections_by_title(before) | {self.sections[name]: text for name, text in measured.items()}
        titles = [(name, title) for name, title in self.sections.items() if title in texts]
        contents = "\n".join(f"* [{title}](#{anchor(title)}): {self.asked(name)}" for name, title in titles)
        return paragraphs(f"# {self.title}", contents, *(texts[title] for _, title in titles)) + "\n"


def sections_by_title(page: str) -> dict[str, str]:
    """The sections of a page, each with its heading."""
    found = (part.strip("\n") for part in _SECTION.split(page)[1:])
    return {part.partition("\n")[0].removeprefix("## "): part for part in found}


@cache
def questions() -> dict[str, Question]:
    """All questions by their names."""
    modules = {name: import_module(f"reports.{name}") for name in NAMES}
    return {name: Question(name, module.__doc__ or "", module.SECTIONS) for name, module in modules.items()}


def question_of(section: str) -> Question | None:
    """The question that a section is about; None where there is no such section."""
    return next((each for each in questions().values() if section in each.sections), None)
