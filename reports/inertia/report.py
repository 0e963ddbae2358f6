"""Robots of the corpus that engines refuse for their inertias, before and after they are mended."""

import re
from collections import Counter
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from lxml import etree

import twinform
from reports.harness.files import OUT, kept
from reports.harness.known import Known
from reports.harness.needs import corpus, drake
from reports.harness.pages import section, table
from reports.harness.report import Findings, Report
from reports.harness.sample import Sample
from reports.inertia.loading import ENGINES, Messages, complaints
from tests.corpus.examine import rules_of
from tests.corpus.files import CorpusFile, Kind
from twinform.testing.oracles.shapes import without_shapes

PIPELINE = (
    "fill-limits{effort=1000 velocity=100 lower=-1 upper=1},fill-inertia{replace=impossible shapes=either},"
    "split-massless,balance-inertia"
)
KNOWN = Known.beside(__file__)
_OF_INERTIAS = re.compile(r"inertia|\bmass\b", re.IGNORECASE)
_WHY = {
    "A + B >= C": "triangle inequality",
    "triangle inequality": "triangle inequality",
    "positive eigenvalues": "not positive definite",
    "at least one is negative": "not positive definite",
    "mjMINVAL": "moves without mass",
    "mass > 0": "an inertia without mass",
    "missing element: 'inertia'": "no <inertia>",
}
_ABOUT = f"""\
Every URDF file of the corpus is loaded by Drake and MuJoCo as it is, without its shapes, which come without their
meshes. Files of which an engine does not take a mass or an inertia, by an error or a warning, are given to
`twinform convert --passes '{PIPELINE}'` and loaded again."""


@dataclass(frozen=True, slots=True)
class Mended:
    """A file that some engine complained of; `refused` are the rules where it was not mended at all."""

    name: str
    before: dict[str, Messages]
    after: dict[str, Messages]
    deeds: Counter[str]
    refused: tuple[str, ...] = ()

    @property
    def content(self) -> bool:
        """Whether no engine reports anything about its inertias any more."""
        return not self.refused and not any(self.after.values())


def about_inertia(messages: Messages) -> Messages:
    """The messages about masses and inertias."""
    return tuple(each for each in messages if _OF_INERTIAS.search(each))


def measure(sample: Sample) -> Findings:
    """Ask, mend, and ask again."""
    files = _files(sample)
    before = {file: answers for file, answers in _asked(files).items() if any(answers.values())}
    outcome = {file: _mend(file) for file in before}
    after = _asked({file: without_shapes(_output(file)) for file, (_, refused) in outcome.items() if not refused})
    mended = [Mended(file.name, answers, after.get(file, answers), *outcome[file]) for file, answers in before.items()]
    left = {each.name: KNOWN.why("left", each.name) for each in mended if not each.content}
    totals = _totals(len(files), mended)
    faults = [f"not explained: {name}" for name, why in left.items() if not why]
    return Findings([totals, _left(mended, left), _list(mended)], totals, faults)


def _files(sample: Sample) -> dict[CorpusFile, bytes]:
    """The URDF files that are XML, with their texts without shapes."""
    found = dict[CorpusFile, bytes]()
    for file in sample.models(Kind.URDF):
        with suppress(etree.XMLSyntaxError):
            found[file] = without_shapes(file.path)
    return found


def _asked(texts: Mapping[CorpusFile, bytes]) -> dict[CorpusFile, dict[str, Messages]]:
    answers = {engine: complaints(engine, list(texts.values())) for engine in ENGINES}
    return {
        file: {engine: about_inertia(answers[engine][number]) for engine in ENGINES}
        for number, file in enumerate(texts)
    }


def _output(file: CorpusFile) -> Path:
    return OUT / "inertia" / file.name


def _mend(file: CorpusFile) -> tuple[Counter[str], tuple[str, ...]]:
    """Mend a file; what was done by rule, and the rules that stand against it."""
    try:
        conversion = twinform.convert(file.path, to="urdf", passes=PIPELINE, paths=file.paths)
    except twinform.CompileError as error:
        return Counter(), rules_of(error.diagnostics)
    kept(_output(file), conversion.text)
    done = {"filled-inertia", "balanced-inertia", "split-mass", "token-mass"}
    return Counter(each.rule.name for each in conversion.diagnostics if each.rule.name in done), ()


def _totals(files: int, mended: Sequence[Mended]) -> str:
    rows: list[tuple[object, ...]] = []
    for engine in ENGINES:
        complained = [each for each in mended if each.before[engine]]
        still = sum(1 for each in complained if each.after[engine])
        rows.append((engine, files, len(complained), len(complained) - still, still))
    return table(("engine", "files", "complains of inertias", "content after", "still complains"), rows)


def _left(mended: Sequence[Mended], known: dict[str, str]) -> str:
    rows = [(each.name, _why(each.after), known[each.name] or "?") for each in mended if not each.content]
    if not rows:
        return "Afterwards no engine complains of any of them."
    return section("Not mended", table(("file", "what they report", "why"), rows))


def _list(mended: Sequence[Mended]) -> str:
    rows: list[tuple[object, ...]] = []
    for each in mended:
        if each.content:
            engines = ", ".join(engine for engine in ENGINES if each.before[engine])
            deeds = ", ".join(f"{rule} {count}" for rule, count in sorted(each.deeds.items()))
            rows.append((each.name, engines, _why(each.before), deeds))
    return section("Mended", table(("file", "engine", "what it reports before", "what was done"), rows))


def _why(answers: dict[str, Messages]) -> str:
    """The complaints in short."""
    messages = [message for each in answers.values() for message in each]
    short = {next((short for sign, short in _WHY.items() if sign in message), message[:120]) for message in messages}
    return ", ".join(sorted(short))


REPORT = Report("inertia", "Inertias that engines refuse", _ABOUT, measure, (corpus, drake), KNOWN)
