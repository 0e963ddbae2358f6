"""Is our MJCF the same robot to Drake's reader of MJCF, beside its reading of the URDF or SDF?"""

from reports.harness.known import Known
from reports.harness.needs import corpus, drake
from reports.harness.sample import Sample
from reports.harness.section import UNEXPLAINED, Findings, Section
from reports.same_robot.mjcf_in_drake_verdicts import Outcome, Verdict, judge
from testbed.corpus.files import Kind
from testbed.markdown import cross_table, first, frequent, grouped, listing, subsection

KNOWN = Known.beside(__file__)
_ABOUT = """\
Every URDF and SDF model of the corpus is written as MJCF, which Drake reads as it reads the source, with its own reader
of each language. Compared are joints, their limits and damping, and at five sets of positions the poses of all links,
their masses and inertias, the mass matrix and the forces of gravity, to 1e-9. Meshes are left out. So this judge shares
nothing with MuJoCo, neither its reader nor its engine.

What MJCF cannot say is not compared: the greatest speed of a joint. Drake wants mass in every body unless it may
compute it of the geoms, and URDF has links without any: these get 1e-12 kg here. What else Drake's reader says that it
leaves out is in the last table; nothing of that is among what is compared, unless a cause is given."""
_ODD = frozenset({Verdict.DIFFERENT, Verdict.REFUSED})


def measure(sample: Sample) -> Findings:
    """Write, let Drake read both, and compare."""
    found, died = sample.lists(judge, sample.models(Kind.URDF, Kind.SDF), seconds=120)
    found.sort(key=lambda one: (one.kind, one.name))
    counts = cross_table(["file"], ((one.kind, one.verdict) for one in found), Verdict)
    odd = grouped(((one.kind, one.verdict, _why(one) or UNEXPLAINED), one.name) for one in found if one.verdict in _ODD)
    head = ["file", "verdict", "why", "files", "for example"]
    said = frequent((line, one.name) for one in found for line in one.said)
    parts = [
        subsection("What becomes of a file", counts),
        _largest(found),
        subsection("What is not the same, and why", listing(head, _rows(odd))),
        subsection("What Drake says that it does not read", listing(["warning", "files", "for example"], said)),
    ]
    return Findings(parts, counts, [*(str(one) for one in found if one.verdict in _ODD and not _why(one)), *died])


def _rows(odd: dict[tuple[str, Verdict, str], list[str]]) -> list[tuple[object, ...]]:
    return [(*key, len(names), first(names, 2)) for key, names in odd.items()]


def _largest(found: list[Outcome]) -> str:
    """The largest difference among those that are the same."""
    most = max((one for one in found if one.verdict is Verdict.SAME), key=lambda one: one.deviation, default=None)
    if most is None:
        return "Nothing was compared."
    return f"The largest difference of those that are the same is {most.deviation:.1g}, of {most.of}, in {most.name}."


def _why(one: Outcome) -> str:
    return KNOWN.why(one.verdict.name.lower(), file=one.name, kind=one.kind, cause=one.cause)


SECTION = Section("mjcf_in_drake", _ABOUT, measure, (corpus, drake), KNOWN)
