"""The sections of the page on what other engines find, and on robots that were let go."""

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence

from reports.harness.known import Known
from reports.harness.pages import first, grouped, section, table
from reports.oracle.agreeing import Agreement, Answer
from reports.oracle.moving import SECONDS, WANTED, Motion
from twinform.testing.oracles.dynamics import TOLERANCE

KNOWN = Known.beside(__file__)
_OTHERS = """\
The same comparison by engines that read one of the two formats, without shapes. *URDF, and the same after SDF 1.11* is
the file and what it becomes in SDF and back in URDF. libsdformat reads URDF as Gazebo does, lumping fixed joints, so
that links that are fixed to each other are weighed together; Pinocchio does so too."""
_MOVING = f"""\
Drake lets robots go for {SECONDS:g} s from one state, which is not at rest, under gravity and without motors or
contacts, by an integrator with an accuracy of 1e-10. Positions and velocities of joints and free links, at ten
moments, are the same where they differ by no more than {TOLERANCE:g} (of the largest number of the kind, where that is
more than one). For each direction robots are taken from one repository after another until {WANTED} move alike."""


def explained(one: Agreement) -> str:
    """The reason for which an engine does not agree; nothing where none is known."""
    return KNOWN.why("agreement", engine=one.question.engine, file=one.question.name, cause=one.cause)


def agreement_section(agreements: Sequence[Agreement]) -> str:
    """How many results other engines call the same, and all that they do not."""
    counts = Counter((one.question.what, one.question.engine, one.answer) for one in agreements)
    pairs = sorted({(what, engine) for what, engine, _ in counts})
    rows = [(what, engine, *(counts[what, engine, answer] for answer in Answer)) for what, engine in pairs]
    return section("Other engines", _OTHERS, table(["compared", "engine", *Answer], rows), _exceptions(agreements))


def _exceptions(agreements: Iterable[Agreement]) -> str:
    doubted = (one for one in agreements if one.answer in {Answer.DIFFERENT, Answer.RESULT})
    groups = grouped(
        ((one.question.what, one.question.engine, one.answer, explained(one) or one.cause), one.question.name)
        for one in doubted
    )
    rows = [(*key, len(names), first(sorted(names))) for key, names in sorted(groups.items())]
    return table(["compared", "engine", "answer", "cause", "files", "which"], rows)


def motion_section(motions: Sequence[Motion], known: Mapping[str, str]) -> str:
    """The robots that were let go."""
    rows = [(one.outcome.direction, one.outcome.name, one.outcome.joints, *_moved(one, known)) for one in motions]
    head = ["conversion", "file", "joints", "verdict", "largest difference", "of"]
    return section("Let go", _MOVING, table(head, rows))


def _moved(one: Motion, known: Mapping[str, str]) -> tuple[str, str, str]:
    if one.verdict is None:
        return ("Drake cannot simulate the source", "", one.cause)
    measure = f"{one.verdict.deviation:.1g}"
    if one.verdict:
        return ("the same", measure, one.verdict.of)
    return ("different", measure, known.get(one.outcome.name, one.verdict.cause))
