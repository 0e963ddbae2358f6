"""The parts of the section about Drake and other engines."""

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

from reports.harness.known import Known
from reports.harness.let_go import ABOUT as LET_GO
from reports.harness.let_go import Motion, motion_table
from reports.same_robot.drake_verdicts import Outcome, Verdict
from reports.same_robot.other_engines import Agreement, Answer
from testbed.markdown import cross_table, first, grouped, listing, subsection, table
from twinform.testing.oracles.robot_comparison import TOLERANCE

ABOUT = f"""\
Every URDF file of the corpus is converted to SDF, and every SDF model that libsdformat 12 takes without an error to
URDF. Drake reads source and result, and at five joint positions the poses of links, centers of mass, inertias, the mass
matrix and gravity torques are compared, with a tolerance of {TOLERANCE:g} (of the largest number of the kind, where
that is more than one). Joint limits and damping must be equal, and only massless links may come and go.

* *same (frames)*: all of that is equal.
* *same (inertial)*: all but the poses of link frames, which a conversion to URDF moves onto the joints, or a massless
  link became a frame, which Drake does not list among the links.
* *source not readable*: Drake refuses the source, so there is nothing to compare with."""

KNOWN = Known(Path(__file__).with_name("oracle.toml"))
_OTHERS = """\
The same comparison by engines that read one of the two formats, without shapes. *URDF, and the same after SDF 1.11* is
the file and what it becomes in SDF and back in URDF. libsdformat reads URDF as Gazebo does, lumping fixed joints, so
that links that are fixed to each other are weighed together; Pinocchio does so too."""
_GROUPS = (
    (Verdict.DIFFERENT, "Different"),
    (Verdict.RESULT, "Results that Drake cannot read"),
    (Verdict.CRASH, "Crashes"),
    (Verdict.REFUSED, "Not converted"),
    (Verdict.SOURCE, "Sources that Drake cannot read"),
)
_IN_FULL = frozenset({Verdict.DIFFERENT, Verdict.RESULT, Verdict.CRASH})


def parts(outcomes: list[Outcome], known: Mapping[str, str], more: Sequence[str]) -> list[str]:
    """The section, with `more` before the lists of exceptions."""
    groups = (subsection(title, _group(outcomes, verdict, known)) for verdict, title in _GROUPS)
    return [subsection("Counts", counts(outcomes)), *more, *groups]


def counts(outcomes: list[Outcome]) -> str:
    """How many conversions met each verdict."""
    return cross_table(["conversion"], ((one.direction, one.verdict) for one in outcomes), Verdict)


def _group(outcomes: list[Outcome], verdict: Verdict, known: Mapping[str, str]) -> str:
    met = ((one.name, _cause(one), one.direction) for one in outcomes if one.verdict is verdict)
    conversions = grouped(((name, cause), direction) for name, cause, direction in met)
    reasons = {name: f" ({known[name]})" if name in known else "" for name, _ in conversions}
    groups = grouped(((", ".join(those), cause + reasons[name]), name) for (name, cause), those in conversions.items())
    ordered = sorted(groups.items(), key=lambda item: (item[0][0], -len(item[1]), item[0][1]))
    rows = ((*key, len(names), first(names, None if verdict in _IN_FULL else 3)) for key, names in ordered)
    return listing(["conversion", "cause", "files", "which"], rows)


def _cause(one: Outcome) -> str:
    return one.cause.partition(":")[0] if one.verdict is Verdict.REFUSED else one.cause


def explained(one: Agreement) -> str:
    """The reason for which an engine does not agree; nothing where none is known."""
    return KNOWN.why("agreement", engine=one.question.engine, file=one.question.name, cause=one.cause)


def agreement_part(agreements: Sequence[Agreement]) -> str:
    """How many results other engines call the same, and all that they do not."""
    met = sorted((one.question.what, one.question.engine, one.answer) for one in agreements)
    counted = cross_table(["compared", "engine"], met, Answer)
    return subsection("Other engines", _OTHERS, counted, _exceptions(agreements))


def _exceptions(agreements: Iterable[Agreement]) -> str:
    doubted = (one for one in agreements if one.answer in {Answer.DIFFERENT, Answer.RESULT})
    groups = grouped(
        ((one.question.what, one.question.engine, one.answer, explained(one) or one.cause), one.question.name)
        for one in doubted
    )
    rows = [(*key, len(names), first(sorted(names))) for key, names in sorted(groups.items())]
    return table(["compared", "engine", "answer", "cause", "files", "which"], rows)


def motion_part(motions: Iterable[Motion]) -> str:
    """The robots that were let go."""
    return subsection("Let go", LET_GO, motion_table(motions, "joints", why_moved))


def why_moved(one: Motion) -> str:
    """The reason for which a robot moves otherwise; nothing where none is known."""
    return KNOWN.why("motion", one.name) if one.is_fault else ""
