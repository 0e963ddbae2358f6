"""One file, converted for one consumer, before Drake; runs in a worker process."""

from dataclasses import dataclass
from enum import StrEnum

import twinform
from reports.harness import files
from reports.harness.files import kept
from reports.physics.applying import NotApplicableError, applied
from tests.corpus.files import CorpusFile, Kind
from twinform import Conversion
from twinform.compiler import Language, LoadOptions, expand, read
from twinform.diagnostics import PhysicsChange
from twinform.profiles import load
from twinform.profiles.physics import of_ledger
from twinform.testing import oracles
from twinform.testing.oracles.readers.meshless import without_meshes

OUT = files.OUT / "physics"
_TOLERANT = LoadOptions(tolerant=True)


class Verdict(StrEnum):
    """What came of one conversion."""

    UNTOUCHED = "nothing was changed"
    SAME = "the same robot, by a pass that changes no physics"
    AS_LISTED = "the robot that the ledger describes"
    DIFFERENT = "different"
    UNREAD = "Drake does not read one of them"
    REFUSED = "not converted"


@dataclass(frozen=True, slots=True)
class Job:
    """A file and the profile that it is converted for."""

    file: CorpusFile
    profile: str

    @property
    def name(self) -> str:
        """What the job is called."""
        return f"{self.file.name} for {self.profile}"


@dataclass(frozen=True, slots=True)
class Outcome:
    """What came of a job; `changed` are the links and joints that the ledger lists."""

    name: str
    profile: str
    verdict: Verdict
    cause: str = ""
    changed: int = 0
    passes: tuple[str, ...] = ()


def judge(job: Job) -> Outcome:
    """Convert a file for a consumer, and ask Drake whether it is the robot that the ledger describes."""
    to, source = target(job), without_meshes(job.file.path.read_bytes())
    try:
        made = twinform.convert(source, to=to, profiles=job.profile, comments=False)
    except twinform.CompileError as error:
        first = next(each for each in error.diagnostics if each.is_error)
        return Outcome(job.name, job.profile, Verdict.REFUSED, first.rule.name)
    changes = of_ledger(made.ledger.entries)
    passes = tuple(sorted({change.step for change in changes}))
    try:
        expected = _described(source, changes, made, to)
        if expected == made.text and not changes:
            return Outcome(job.name, job.profile, Verdict.UNTOUCHED)
        verdict, cause = _asked(job, expected, made.text, to, changed=bool(changes))
    except NotApplicableError as error:
        verdict, cause = Verdict.DIFFERENT, f"the ledger: {error}"
    except twinform.CompileError as error:
        verdict, cause = Verdict.DIFFERENT, f"what the ledger describes is not accepted: {error}"[:200]
    return Outcome(job.name, job.profile, verdict, cause, len(changes), passes)


def target(job: Job) -> Language:
    """The format of the file if the consumer reads it, or else the one that it reads; SDF for Gazebo."""
    own: Language = "urdf" if job.file.kind is Kind.URDF else "sdf"
    if job.profile.startswith("gazebo"):
        return "sdf"
    formats = {str(format_) for profile in load(job.profile) for format_ in profile.formats}
    return own if own in formats and job.profile != "portable" else "urdf"


def _described(source: bytes, changes: tuple[PhysicsChange, ...], made: Conversion, to: Language) -> str:
    """The text of the source with the changes that the ledger lists, made without a pass."""
    loaded = read(source, _TOLERANT)
    loaded = expand(loaded, _TOLERANT) if to == "urdf" else loaded
    assert loaded.document is not None
    version = made.document.version if to == "sdf" else None
    return twinform.convert(applied(loaded.document, changes), to=to, sdf_version=version, comments=False).text


def _asked(job: Job, expected: str, text: str, to: Language, *, changed: bool) -> tuple[Verdict, str]:
    name = f"{job.file.name}.{job.profile}"
    first, second = kept(OUT / f"{name}.expected.{to}", expected), kept(OUT / f"{name}.{to}", text)
    try:
        found = oracles.compare(first, second, engine="drake")
    except oracles.UnreadableError as error:
        return Verdict.UNREAD, str(error.cause)[:200]
    if not found:
        return Verdict.DIFFERENT, found.cause
    return (Verdict.AS_LISTED if changed else Verdict.SAME), ""
