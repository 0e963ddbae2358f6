"""Is every URDF of the corpus the same robot in the other versions of URDF, to urdfdom and to Drake?"""

from reports.harness.known import Known
from reports.harness.needs import corpus, drake, urdfdom, urdfdom_6
from reports.harness.sample import Sample
from reports.harness.section import UNEXPLAINED, Findings, Section
from reports.same_robot.other_urdf import Outcome, Verdict, judge
from testbed.corpus.files import Kind
from testbed.markdown import cross_table, first, frequent, grouped, listing, subsection

KNOWN = Known.beside(__file__)
_ABOUT = """\
Every URDF of the corpus that is accepted is written as 1.2, as 1.1 and as 1.0 (`convert --urdf-version`). urdfdom 6
reads all of them, urdfdom 3, which Debian and ROS 2 Humble have, those of 1.0. Drake, which knows no versions, compares
each with the source: link frames, masses, inertias, the mass matrix, gravity and limits. *Source not taken* are files
about which the reader has the same complaint before they are converted."""
ODD = frozenset({Verdict.REFUSED, Verdict.DIFFERENT, Verdict.NOT_WRITTEN})


def measure(sample: Sample) -> Findings:
    """Write, read and compare."""
    found, died = sample.lists(judge, sample.models(Kind.URDF), seconds=120)
    found.sort(key=lambda one: (one.version, one.reader, one.name))
    counts = cross_table(["version", "reader"], ((one.version, one.reader, one.verdict) for one in found), Verdict)
    head = ["version", "reader", "verdict", "why", "files", "for example"]
    odd = grouped(
        ((one.version, one.reader, one.verdict, why(one) or UNEXPLAINED), one.name)
        for one in found
        if one.verdict in ODD
    )
    listed = listing(head, ((*key, len(names), first(names, 2)) for key, names in odd.items()))
    before = frequent(((one.reader, one.cause), one.name) for one in found if one.verdict is Verdict.SOURCE)
    sources = listing(["reader", "complaint", "results", "for example"], ((*key, *rest) for key, *rest in before))
    parts = [
        subsection("Robots in other versions", counts),
        subsection("What is not the same, and why", listed),
        subsection("Complaints about the sources", sources),
    ]
    unexplained = [str(one) for one in found if one.verdict in ODD and not why(one)]
    return Findings(parts, counts, [*unexplained, *died])


def why(one: Outcome) -> str:
    """Why a robot is not written, not taken or another one; empty where nobody knows."""
    return KNOWN.why(one.verdict.name.lower(), file=one.name, version=one.version, reader=one.reader, cause=one.cause)


SECTION = Section("older_urdf", _ABOUT, measure, (corpus, drake, urdfdom, urdfdom_6), KNOWN)
