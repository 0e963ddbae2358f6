"""One file, converted for each consumer, before Drake; runs in a worker process."""

from dataclasses import dataclass, field
from enum import StrEnum

from lxml import etree

import twinform
from testbed import output_files
from testbed.corpus.files import CorpusFile, Kind
from testbed.engines.readers.meshless import without_meshes
from testbed.ledger_changes import NotApplicableError, applied, reshaped
from testbed.output_files import kept
from twinform import Conversion
from twinform.compiler import Language, LoadOptions, expand, read
from twinform.compiler.fitting import assessed, newest_sdf
from twinform.diagnostics import PhysicsChange
from twinform.ir import Format
from twinform.profiles import ConsumerVerdict as Taken
from twinform.profiles import load, names
from twinform.profiles.remedies import of_ledger, remedies
from twinform.testing import oracles

OUT = output_files.OUT / "physics"
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
class Outcome:
    """What came of a conversion; `changed` are the links and joints that the ledger lists."""

    name: str
    profile: str
    verdict: Verdict
    cause: str = ""
    changed: int = 0
    passes: tuple[str, ...] = ()


def judge(file: CorpusFile) -> list[Outcome]:
    """Convert a file for every consumer, and ask Drake whether it is the robot that the ledger describes."""
    trial = _Trial(file, without_meshes(file.path.read_bytes()))
    return [trial.outcome(profile) for profile in names()]


def target(file: CorpusFile, profile: str) -> Language:
    """The format of the file if the consumer reads it, or else the one that it reads; SDF for Gazebo."""
    own: Language = "urdf" if file.kind is Kind.URDF else "sdf"
    if profile.startswith("gazebo"):
        return "sdf"
    formats = {str(format_) for each in load(profile) for format_ in each.formats}
    return own if own in formats and profile != "portable" else "urdf"


@dataclass
class _Trial:
    """A file, and what is the same for several consumers: conversions for nobody, and what Drake said."""

    file: CorpusFile
    source: bytes
    plain: dict[tuple[Language, str | None], Conversion] = field(default_factory=dict)
    told: dict[tuple[str, str], tuple[bool, str]] = field(default_factory=dict)

    def outcome(self, profile: str) -> Outcome:
        name, to = f"{self.file.name} for {profile}", target(self.file, profile)
        try:
            if not self._is_needy(profile, to):
                return Outcome(name, profile, Verdict.UNTOUCHED)
            made = twinform.convert(self.source, to=to, profiles=profile, comments=False)
        except twinform.CompileError as error:
            first = next(each for each in error.diagnostics if each.is_error)
            return Outcome(name, profile, Verdict.REFUSED, first.rule.name)
        changes = of_ledger(made.ledger.entries)
        passes = tuple(sorted({change.step for change in changes}))
        try:
            verdict, cause = self._ask_once(made, changes, to)
        except NotApplicableError as error:
            verdict, cause = Verdict.DIFFERENT, f"the ledger: {error}"
        except twinform.CompileError as error:
            verdict, cause = Verdict.DIFFERENT, f"what the ledger describes is not accepted: {error}"[:200]
        return Outcome(name, profile, verdict, cause, len(changes), passes)

    def _is_needy(self, profile: str, to: Language) -> bool:
        """Whether passes run for a consumer: otherwise the conversion is the one for nobody."""
        profiles = load(profile)
        version = newest_sdf(profiles) if to == "sdf" else None
        if (to, version) not in self.plain:
            try:
                made = twinform.convert(self.source, to=to, sdf_version=version, comments=False)
            except twinform.CompileError:
                return True
            self.plain[to, version] = made
        found = assessed(self.plain[to, version], LoadOptions(profiles=profiles), self.file.name)
        return bool(remedies(found, Format(to))) or any(each.verdict is Taken.REFUSES for each in found)

    def _ask_once(self, made: Conversion, changes: tuple[PhysicsChange, ...], to: Language) -> tuple[Verdict, str]:
        links = reshaped(changes)
        texts = _shapeless(self._described(changes, made, to), links), _shapeless(made.text, links)
        if texts not in self.told:
            self.told[texts] = self._compared(*texts, to)
        is_read, cause = self.told[texts]
        if not is_read:
            return Verdict.UNREAD, cause
        if cause:
            return Verdict.DIFFERENT, cause
        return (Verdict.AS_LISTED if changes else Verdict.SAME), ""

    def _described(self, changes: tuple[PhysicsChange, ...], made: Conversion, to: Language) -> str:
        """The text of the source with the changes that the ledger lists, made without a pass."""
        loaded = read(self.source, _TOLERANT)
        loaded = expand(loaded, _TOLERANT) if to == "urdf" else loaded
        assert loaded.document is not None
        version = made.document.version if to == "sdf" else None
        return twinform.convert(applied(loaded.document, changes), to=to, sdf_version=version, comments=False).text

    def _compared(self, expected: str, text: str, to: Language) -> tuple[bool, str]:
        """Whether Drake reads both, and what is different."""
        name = f"{self.file.name}.{len(self.told)}"
        first, second = kept(OUT / f"{name}.expected.{to}", expected), kept(OUT / f"{name}.{to}", text)
        try:
            found = oracles.compare(first, second, engine="drake")
        except oracles.EngineUnreadableError as error:
            return False, str(error.cause)[:200]
        return True, "" if found else found.cause


def _shapeless(text: str, links: frozenset[str]) -> str:
    """The text without the collisions of these links."""
    if not links:
        return text
    root = etree.fromstring(text.encode())
    for link in root.iter("link"):
        if link.get("name") in links:
            for collision in link.findall("collision"):
                link.remove(collision)
    return etree.tostring(root, encoding="unicode")
