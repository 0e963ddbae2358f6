"""A report: what it measures, the page that it writes, and its command line."""

import argparse
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import twinform
from reports.harness.known import Known
from reports.harness.needs import corpus
from reports.harness.pages import paragraphs
from reports.harness.sample import Sample
from tests.corpus.files import ROOT

UNEXPLAINED = "**unexplained**"
_MOST_SHOWN = 60


@dataclass(frozen=True, slots=True)
class Findings:
    """The sections of the page, a few lines to print, and what is wrong and has no known cause."""

    sections: Sequence[str]
    summary: str
    faults: Sequence[str] = ()


@dataclass(frozen=True, slots=True)
class Report:
    """What is measured; `needs` explain why it cannot be, if so; `known` are the causes that all have to be met."""

    name: str
    title: str
    about: str
    measure: Callable[[Sample], Findings]
    needs: tuple[Callable[[], str], ...] = (corpus,)
    known: Known | None = None
    seed: int = 1
    folder: str = "evidence"

    @property
    def page(self) -> Path:
        """The page of all that there is."""
        return ROOT / "docs" / self.folder / f"{self.name}.md"

    def text(self, found: Findings, every: int = 1) -> str:
        """The page, of one of `every` models."""
        share = f' ARGS="--every {every}"`, from one of {every} models.' if every != 1 else "`."
        origin = f"Made by `make report NAME={self.name}{share}"
        return paragraphs(f"# {self.title}", origin, self.about, *found.sections) + "\n"


def run(report: Report, arguments: Sequence[str]) -> int:
    """Measure, and write the page of all, or print that of a sample.

    Returns:
        0, or 1 where something has no known cause or the page is not current, or 2 where nothing can be measured.
    """
    given = _options(report, arguments)
    if missing := next(filter(None, (need() for need in report.needs)), ""):
        print(missing, file=sys.stderr)
        return 2
    sample = Sample(given.every, tuple(given.file), given.seed, given.jobs, tuple(given.inputs))
    is_whole = sample.every == 1 and not sample.files and sample.seed == report.seed
    found = report.measure(sample)
    text = report.text(found, sample.every)
    if given.check:
        return _check(report.page, text)
    page: Path | None = given.output or (report.page if is_whole else None)
    if page is not None:
        twinform.write_atomically(page, text)
    print(text if page is None else f"{found.summary.rstrip()}\nwritten to {page}")
    unused = report.known.unused() if report.known is not None and is_whole else []
    return _conclude([*found.faults, *unused])


def _conclude(faults: Sequence[str]) -> int:
    print(*faults[:_MOST_SHOWN], f"{len(faults)} without a reason", sep="\n", file=sys.stderr)
    return 1 if faults else 0


def _check(page: Path, text: str) -> int:
    if page.is_file() and page.read_text(encoding="utf-8") == text:
        return 0
    print(f"{page} is out of date; run the report without --check", file=sys.stderr)
    return 1


def _options(report: Report, arguments: Sequence[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog=f"python -m reports {report.name}", description=report.about)
    parser.formatter_class = argparse.RawDescriptionHelpFormatter
    parser.add_argument("inputs", nargs="*", help="what the report reads beside the models, such as checkouts")
    parser.add_argument("--every", type=int, default=1, help="one of so many models; a part is printed, not written")
    parser.add_argument("--file", action="append", default=[], help="models with this in their names, or a path")
    parser.add_argument("--seed", type=int, default=report.seed, help="draw others, where something is drawn")
    parser.add_argument("--jobs", type=int, help="so many processes; as many as there are processors if not given")
    parser.add_argument("--output", type=Path, help="the page, in another file")
    parser.add_argument("--check", action="store_true", help="write nothing; 1 where the committed page is not current")
    return parser.parse_args(arguments)
