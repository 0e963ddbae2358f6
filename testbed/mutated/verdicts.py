"""One mutated corpus file before us and before the parser of record: what each reports about it."""

import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from enum import StrEnum
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory

import twinform
from testbed.corpus.files import Kind
from testbed.mutated.mutated import Mutated
from testbed.oracles import mujoco_refusals, urdfdom
from twinform.compiler import as_refused
from twinform.diagnostics import Diagnostic
from twinform.testing.oracles import libsdformat
from twinform.testing.oracles.libsdformat import LibsdformatReading

_COLOR = re.compile(r"\x1b\[[0-9;]*m")
_CONSOLE = re.compile(r"^(?P<kind>Error|Warning)(?: \[\w+\.cc:\d+\]|:)\s*(?P<text>.*)")
_PLACE = re.compile(r"\[/[^\]]*(?:\][^\]]*)*:L\d+\]: ")


class Judge(StrEnum):
    """Who judges beside us."""

    LIBSDFORMAT = "libsdformat"
    URDFDOM = "urdfdom"
    URDFDOM_6 = "urdfdom 6"
    MUJOCO = "MuJoCo"


@dataclass(frozen=True, slots=True)
class Question:
    """Documents of a kind before a judge."""

    judge: Judge
    kind: Kind

    def __str__(self) -> str:
        return f"{self.kind.upper()} before {self.judge}"


QUESTIONS = (
    Question(Judge.LIBSDFORMAT, Kind.SDF),
    Question(Judge.LIBSDFORMAT, Kind.URDF),
    Question(Judge.URDFDOM, Kind.URDF),
)
"""About mutated files of the corpus."""
OF_VERSIONS = Question(Judge.URDFDOM_6, Kind.URDF)
"""About documents of all versions of URDF."""
OF_MJCF = Question(Judge.MUJOCO, Kind.MJCF)
"""About mutated files of MJCF."""


@dataclass(frozen=True, slots=True)
class Opinion:
    """The opinion of a judge: whether it reads the file, its objections, and its other remarks."""

    accepts: bool
    objections: tuple[str, ...] = ()
    remarks: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Verdict:
    """A document, what we find in it, and the judge's opinion."""

    document: Mutated
    question: Question
    findings: tuple[Diagnostic, ...]
    opinion: Opinion

    @property
    def accepted(self) -> bool:
        """Whether we take it."""
        return not any(finding.is_error for finding in self.findings)

    def __str__(self) -> str:
        ours = "; ".join(f"{one.rule.name}: {one.message}" for one in self.findings if one.is_error) or "we accept it"
        theirs = "; ".join(self.opinion.objections) if self.objected else "they accept it"
        return f"{self.document}, {self.question.judge}: {ours} | {theirs}"

    @property
    def objected(self) -> bool:
        """Whether the judge refuses it."""
        return not self.opinion.accepts


def verdicts(questions: Sequence[Question], documents: Iterable[Mutated]) -> Iterator[Verdict]:
    """Every document before every judge of its kind."""
    with TemporaryDirectory() as name:
        folder = Path(name).resolve()
        paths = {_written(folder, document): document for document in documents}
        # compat is the mode to compare: what a format does not know is a warning here, and with both parsers
        found = {path: as_refused(twinform.check(path)).diagnostics for path in paths}
        for question in questions:
            mine = [path for path, document in paths.items() if document.kind is question.kind]
            for path, opinion in _ASKED[question.judge](mine):
                yield Verdict(paths[path], question, found[path], opinion)


def _written(folder: Path, document: Mutated) -> Path:
    path = folder / f"{document.seed}.{document.kind}"
    path.write_bytes(document.text)
    return path


def _of_libsdformat(paths: Sequence[Path]) -> Iterator[tuple[Path, Opinion]]:
    for path, reading in libsdformat.judge(paths).items():
        yield path, _opinion(reading, str(path))


def _opinion(reading: LibsdformatReading, path: str) -> Opinion:
    printed = [_CONSOLE.match(line) for line in _COLOR.sub("", reading.console).splitlines()]
    lines = [(found["kind"], _PLACE.sub("", found["text"])) for found in printed if found]
    errors = tuple(dict.fromkeys(text for kind, text in lines if kind == "Error"))
    warnings = tuple(dict.fromkeys(text for kind, text in lines if kind == "Warning"))
    if reading.ok:
        return Opinion(accepts=True, remarks=errors + warnings)
    # the error often names an element alone, and the terminal has the reason
    own = (error.partition(": ")[2].replace(path, "FILE") for error in reading.errors)
    return Opinion(False, tuple(dict.fromkeys((*own, *errors))), warnings)


def _of_urdfdom(complaints: Callable[[Path], tuple[str, ...]], paths: Sequence[Path]) -> Iterator[tuple[Path, Opinion]]:
    for path in paths:
        objections = tuple(dict.fromkeys(complaints(path)))
        yield path, Opinion(not objections, objections)


def _of_mujoco(paths: Sequence[Path]) -> Iterator[tuple[Path, Opinion]]:
    for path, reason in mujoco_refusals.refusals(paths):
        yield path, Opinion(not reason, (reason,) if reason else ())


_ASKED: dict[Judge, Callable[[Sequence[Path]], Iterator[tuple[Path, Opinion]]]] = {
    Judge.LIBSDFORMAT: _of_libsdformat,
    Judge.URDFDOM: partial(_of_urdfdom, urdfdom.complaints),
    Judge.URDFDOM_6: partial(_of_urdfdom, urdfdom.complaints_of_6),
    Judge.MUJOCO: _of_mujoco,
}
