"""Fixed joints lumped as libsdformat 12 does, beside what it does itself."""

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass

import twinform
from reports.harness.files import OUT, SDF_VERSION, kept
from reports.harness.needs import corpus, libsdformat
from reports.harness.pages import section, table
from reports.harness.report import Findings, Report
from reports.harness.sample import Sample
from reports.lumping.causes import CAUSES, cause_of
from reports.lumping.differences import Difference, differences
from reports.lumping.motion import MODES, Moved, moved
from tests.corpus.examine import rules_of
from tests.corpus.files import CorpusFile, Kind
from twinform.testing.oracles.libsdformat.library import describe

PASSES = "lump-fixed-joints{compat=libsdformat}"
_SECONDS = 120
_ABOUT = """\
libsdformat lumps fixed joints whenever it reads URDF. Every URDF file of the corpus is read by libsdformat 12, and so
is the SDF that `lump-fixed-joints{compat=libsdformat}` makes of it. Compared are the names of links, joints, visuals
and collisions, and, to 1e-9, masses, centers of mass, inertias, poses, axes and limits. Where something differs, its
cause is a fault of libsdformat that the numbers or the file show; what has no such cause makes the command fail."""


@dataclass(frozen=True, slots=True)
class Outcome:
    """A file, what differs and why; `theirs` and `ours` are the reasons why either refuses it."""

    name: str
    links: int = 0
    lumped: int = 0
    theirs: str = ""
    ours: str = ""
    found: tuple[tuple[Difference, str], ...] = ()

    @property
    def refusal(self) -> str:
        """Who refuses it, and why; empty where neither does."""
        return f"libsdformat: {self.theirs}" if self.theirs else self.ours and f"here: {self.ours}"

    @property
    def summary(self) -> str:
        """What became of it."""
        if self.theirs:
            return "refused by libsdformat"
        if self.ours:
            return "refused here"
        if not self.found:
            return "the same"
        return "explained" if all(cause for _, cause in self.found) else "different"


def measure(sample: Sample) -> Findings:
    """Compare what libsdformat reads, and the motion of lumped robots in Drake."""
    files = sample.models(Kind.URDF)
    outcomes = sample.outcomes(_judge, files, lambda file, why: Outcome(file.name, ours=why), seconds=_SECONDS)
    motions = [motion for mode in MODES for motion in moved(mode, sample)]
    unexplained = [f"{one.name}: {each}" for one in outcomes for each, cause in one.found if not cause]
    failures = [*unexplained, *(f"{one.mode}: {one.name}: {one.cause}" for one in motions if one.differs)]
    return Findings(list(_page(outcomes, motions)), f"{len(outcomes)} files", failures)


def _judge(file: CorpusFile) -> Outcome:
    try:
        theirs = describe(file.path)
    except RuntimeError as error:
        return Outcome(file.name, theirs=_code(str(error)))
    try:
        conversion = twinform.convert(file.path, to="sdf", sdf_version=SDF_VERSION, passes=PASSES, paths=file.paths)
        plain = twinform.load(file.path, paths=file.paths)
    except twinform.CompileError as error:
        return Outcome(file.name, ours=", ".join(rules_of(error.diagnostics)))
    try:
        ours = describe(kept(OUT / "lumping" / f"{file.name}.sdf", conversion.text))
    except RuntimeError as error:
        return Outcome(file.name, ours=str(error))
    model = plain.models[0]
    found = tuple((each, cause_of(each, theirs, ours, model)) for each in differences(theirs, ours))
    links = len(model.links)
    return Outcome(file.name, links, links - len(ours["links"]), found=found)


def _code(message: str) -> str:
    """The first error without the names in it, so that files with one cause can be counted."""
    return next((why for sign, why in _REFUSALS.items() if sign in message), message.partition(";")[0][:80])


_REFUSALS = {
    "must have at least one link": "no link is left, since links without mass are dropped",
    "has invalid inertia": "an inertia that no body can have",
    "Unable to read": "urdfdom refuses it",
    "non-unique name": "a joint with the name of a link, or two of one name",
}


def _page(outcomes: list[Outcome], motions: list[Moved]) -> Iterable[str]:
    counts = Counter(one.summary for one in outcomes)
    refused = Counter(one.refusal for one in outcomes if one.refusal)
    lumped = [one for one in outcomes if one.lumped and one.summary in {"the same", "explained"}]
    yield table(["files", "number"], [(summary, counts[summary]) for summary in _SUMMARIES])
    yield f"In {len(lumped)} of those compared links are lumped: {sum(one.lumped for one in lumped)} in all."
    yield section("Why they differ", table(["cause", "files", "differences", "fault"], _causes(outcomes)))
    different = map(_row, (one for one in outcomes if one.found))
    yield section("File by file", table(["file", "differences", "the first", "cause"], different))
    yield section("Refused", table(["who and why", "files"], refused.most_common()))
    yield _motion_section(motions)


_SUMMARIES = ("the same", "explained", "different", "refused by libsdformat", "refused here")


def _causes(outcomes: list[Outcome]) -> Iterable[tuple[object, ...]]:
    counts = Counter(cause for one in outcomes for _, cause in one.found)
    files = Counter(cause for one in outcomes for cause in {cause for _, cause in one.found})
    for cause, number in counts.most_common():
        yield cause or "none was found", files[cause], number, CAUSES.get(cause, "")


def _row(one: Outcome) -> tuple[object, ...]:
    causes = "; ".join(dict.fromkeys(cause or "none was found" for _, cause in one.found))
    return one.name, len(one.found), one.found[0][0].short, causes


def _motion_section(motions: list[Moved]) -> str:
    about = """Robots with fixed joints are let go in Drake from the same state, as they are and lumped, for one second
without control: positions and velocities of all joints, and of the base where it is free, at eleven times. They are
from as many repositories as there are; passed over are those that Drake cannot simulate at
all, and those with inertias that no body can have, in the place of which Drake puts others."""
    head = ["mode", "robot", "links", "lumped", "largest gap", "verdict"]
    rows = [(one.mode, one.name, one.links, one.lumped, f"{one.gap:.1e}", one.summary) for one in motions]
    return section("The same motion", about, table(head, rows))


REPORT = Report("lumping", "Lumping of fixed joints", _ABOUT, measure, (corpus, libsdformat))
