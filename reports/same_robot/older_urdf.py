"""Is every URDF of the corpus the same robot in the other versions of URDF, to urdfdom and to Drake?"""

from collections.abc import Sequence

from reports.harness.known import Known
from reports.harness.needs import corpus, drake, urdfdom, urdfdom_6
from reports.harness.sample import Sample
from reports.harness.section import Findings, Section
from reports.same_robot.other_urdf import judge
from reports.same_robot.reader_verdicts import Outcome, Outcomes, Verdict, complaints
from testbed.corpus.files import Kind
from testbed.markdown import subsection

KNOWN = Known.beside(__file__)
_ABOUT = """\
Every URDF of the corpus that is accepted is written as 1.2, as 1.1 and as 1.0 (`convert --urdf-version`). urdfdom 6
reads all of them, urdfdom 3, which Debian and ROS 2 Humble have, those of 1.0. Drake, which knows no versions, compares
each with the source: link frames, masses, inertias, the mass matrix, gravity and limits. *Source not taken* are files
about which the reader has the same complaint before they are converted."""


def measure(sample: Sample) -> Findings:
    """Write, read and compare."""
    found, died = sample.lists(judge, sample.models(Kind.URDF), seconds=120)
    found.sort(key=lambda one: (one.ways, one.name))
    outcomes = judged(found)
    counts = outcomes.counts([each for each in Verdict if each is not Verdict.ABSENT])
    refused = [((one.ways[1], one.cause), one.name) for one in found if one.verdict is Verdict.SOURCE]
    parts = [
        subsection("Robots in other versions", counts),
        subsection("What is not the same, and why", outcomes.reasons()),
        subsection("Complaints about the sources", complaints(["reader", "complaint", "results"], refused)),
    ]
    return Findings(parts, counts, [*outcomes.unexplained(), *died])


def judged(found: Sequence[Outcome]) -> Outcomes[Outcome]:
    """Outcomes with what is known of them."""
    return Outcomes(found, KNOWN, {"version": "version", "reader": "reader"})


SECTION = Section("older_urdf", _ABOUT, measure, (corpus, drake, urdfdom, urdfdom_6), KNOWN)
