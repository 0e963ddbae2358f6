"""Is our MJCF the same robot to Drake's reader of MJCF, beside its reading of the URDF or SDF?"""

from reports.harness.known import Known
from reports.harness.needs import corpus, drake
from reports.harness.sample import Sample
from reports.harness.section import Findings, Section
from reports.same_robot.mjcf_in_drake_verdicts import DrakeOutcome, judge
from reports.same_robot.reader_verdicts import ODD, Outcomes, Verdict, complaints
from testbed.corpus.files import Kind
from testbed.markdown import subsection

KNOWN = Known.beside(__file__)
_ABOUT = """\
Every URDF and SDF model of the corpus is written as MJCF, which Drake reads as it reads the source, with its own reader
of each language. Compared are joints, their limits and damping, and at five sets of positions the poses of all links,
their masses and inertias, the mass matrix and the forces of gravity, to 1e-9. Meshes are left out. So this judge shares
nothing with MuJoCo, neither its reader nor its engine.

What MJCF cannot say is not compared: the greatest speed of a joint. Drake wants mass in every body unless it may
compute it of the geoms, and URDF has links without any: these get 1e-12 kg here. What else Drake's reader says that it
leaves out is in the last table; nothing of that is among what is compared, unless a cause is given."""


def measure(sample: Sample) -> Findings:
    """Write, let Drake read both, and compare."""
    found, died = sample.lists(judge, sample.models(Kind.URDF, Kind.SDF), seconds=120)
    found.sort(key=lambda one: (one.ways, one.name))
    outcomes = Outcomes(found, KNOWN, {"kind": "file"}, ODD - {Verdict.NOT_WRITTEN})
    counts = outcomes.counts([each for each in Verdict if each not in {Verdict.ABSENT, Verdict.TAKEN}])
    said = [((line,), one.name) for one in found for line in one.said]
    parts = [
        subsection("What becomes of a file", counts),
        _largest(found),
        subsection("What is not the same, and why", outcomes.reasons()),
        subsection("What Drake says that it does not read", complaints(["warning", "files"], said)),
    ]
    return Findings(parts, counts, [*outcomes.unexplained(), *died])


def _largest(found: list[DrakeOutcome]) -> str:
    """The largest difference among those that are the same."""
    most = max((one for one in found if one.verdict is Verdict.SAME), key=lambda one: one.deviation, default=None)
    if most is None:
        return "Nothing was compared."
    return f"The largest difference of those that are the same is {most.deviation:.1g}, of {most.of}, in {most.name}."


SECTION = Section("mjcf_in_drake", _ABOUT, measure, (corpus, drake), KNOWN)
