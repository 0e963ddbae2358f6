"""Are fixed joints lumped as libsdformat 12 does, and is the motion the same?"""

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass

import twinform
from reports.fixes_and_passes.lumped_motion import MODES, move
from reports.harness.let_go import ABOUT as LET_GO
from reports.harness.let_go import Motion, motion_table, motions
from reports.harness.needs import corpus, libsdformat
from reports.harness.sample import Sample, in_turn
from reports.harness.section import Findings, Section
from testbed.corpus.examine import rules_of
from testbed.corpus.files import CorpusFile, Kind
from testbed.lumping.causes import CAUSES, cause_of
from testbed.lumping.differences import Difference, differences
from testbed.markdown import subsection, table
from testbed.output_files import OUT, SDF_VERSION, kept
from twinform.testing.oracles.libsdformat import describe

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
    jobs = {mode: [(mode, file) for file in in_turn(sample.models(Kind(mode.source)))] for mode in MODES}
    moved = [each for of_mode in jobs.values() for each in motions(sample, move, of_mode)]
    unexplained = [f"{one.name}: {each}" for one in outcomes for each, cause in one.found if not cause]
    failures = [*unexplained, *(f"{one.done}: {one.name}: {one.cause}" for one in moved if one.is_fault)]
    return Findings([*_parts(outcomes), _let_go(moved)], f"{len(outcomes)} files", failures)


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


def _parts(outcomes: list[Outcome]) -> Iterable[str]:
    counts = Counter(one.summary for one in outcomes)
    refused = Counter(one.refusal for one in outcomes if one.refusal)
    lumped = [one for one in outcomes if one.lumped and one.summary in {"the same", "explained"}]
    yield table(["files", "number"], [(summary, counts[summary]) for summary in _SUMMARIES])
    yield f"In {len(lumped)} of those compared links are lumped: {sum(one.lumped for one in lumped)} in all."
    yield subsection("Why they differ", table(["cause", "files", "differences", "fault"], _causes(outcomes)))
    different = map(_row, (one for one in outcomes if one.found))
    yield subsection("File by file", table(["file", "differences", "the first", "cause"], different))
    yield subsection("Refused", table(["who and why", "files"], refused.most_common()))


_SUMMARIES = ("the same", "explained", "different", "refused by libsdformat", "refused here")


def _causes(outcomes: list[Outcome]) -> Iterable[tuple[object, ...]]:
    counts = Counter(cause for one in outcomes for _, cause in one.found)
    files = Counter(cause for one in outcomes for cause in {cause for _, cause in one.found})
    for cause, number in counts.most_common():
        yield cause or "none was found", files[cause], number, CAUSES.get(cause, "")


def _row(one: Outcome) -> tuple[object, ...]:
    causes = "; ".join(dict.fromkeys(cause or "none was found" for _, cause in one.found))
    return one.name, len(one.found), one.found[0][0].short, causes


def _let_go(moved: list[Motion]) -> str:
    about = """They are robots with fixed joints, as they are and lumped. Passed over are those with inertias that no
body can have, in the place of which Drake puts others."""
    return subsection("The same motion", LET_GO, about, motion_table(moved, "links lumped"))


SECTION = Section("lumping", _ABOUT, measure, (corpus, libsdformat))
