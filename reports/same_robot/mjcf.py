"""Is our MJCF the same robot: as MuJoCo reads the URDF itself, and as Drake reads the SDF?"""

import re

from reports.harness.known import Known
from reports.harness.needs import corpus, drake, mujoco
from reports.harness.sample import Sample
from reports.harness.section import UNEXPLAINED, Findings, Section
from reports.same_robot.mjcf_verdicts import Outcome, Verdict, judge
from testbed.corpus.files import Kind
from testbed.markdown import cross_table, first, frequent, grouped, listing, subsection

KNOWN = Known.beside(__file__)
_ABOUT = """\
Every URDF and SDF file of the corpus is written as MJCF (`convert --to mjcf`) and compiled by MuJoCo. The corpus has no
meshes, so that each is a box, or left out.

* **URDF** against MuJoCo's own reading of the file, with `fusestatic`, `discardvisual` and `balanceinertia` off: joints
  and their ranges, forces, damping and friction, all geoms, and at 20 random positions and velocities the poses of all
  links and geoms, the mass matrix and the bias forces, to 1e-9. Rotors that elements of Drake describe are given to
  its reading: they are the armatures of joints in ours.
* **SDF models** against Drake: ranges, damping, and at 20 positions the poses of all links to 1e-9, the mass matrix and
  the bias forces to 1e-6. Free bodies, universal, ball and screw joints are compared as well.
* **SDF worlds** are compiled.

*Same without `<inertial>`* means: MuJoCo's URDF reader gives a link without `<inertial>` the mass that its collisions
have at 1000 kg/m³. URDF says that it has none, and so does our MJCF; with that, the two agree. *Source not taken* are
files that MuJoCo, or Drake, refuses before they are converted."""
_PLACE = re.compile(r"^\S*/\S+: |\S*/(?=[^/\s]+$)")
"""Where a reader found something: a path with a line, or a folder."""
ODD = frozenset({Verdict.REFUSED, Verdict.DIFFERENT, Verdict.NOT_WRITTEN})


def measure(sample: Sample) -> Findings:
    """Write, compile and compare."""
    found, died = sample.lists(judge, sample.models(Kind.URDF, Kind.SDF), seconds=120)
    found.sort(key=lambda one: (one.kind, one.name))
    counts = cross_table(["file"], ((one.kind, one.verdict) for one in found), Verdict)
    odd = grouped(((one.kind, one.verdict, why(one) or UNEXPLAINED), one.name) for one in found if one.verdict in ODD)
    head = ["file", "verdict", "why", "files", "for example"]
    listed = listing(head, ((*key, len(names), first(names, 2)) for key, names in odd.items()))
    before = frequent(((one.kind, _shortened(one.cause)), one.name) for one in found if one.verdict is Verdict.SOURCE)
    sources = listing(["file", "complaint", "files", "for example"], ((*key, *rest) for key, *rest in before), most=30)
    parts = [
        subsection("What becomes of a file", counts),
        subsection("What is not the same, and why", listed),
        subsection("Complaints about the sources", sources),
    ]
    unexplained = [str(one) for one in found if one.verdict in ODD and not why(one)]
    return Findings(parts, counts, [*unexplained, *died])


def why(one: Outcome) -> str:
    """Why a robot is not written, not taken or another one; empty where nobody knows."""
    return KNOWN.why(one.verdict.name.lower(), file=one.name, kind=one.kind, cause=one.cause)


def _shortened(cause: str, most: int = 90) -> str:
    """A complaint without the names in it, so that like ones are counted together."""
    cause = _PLACE.sub("", cause)
    text = cause.partition("Element")[0].partition("'")[0].partition("[")[0].strip()
    return (text[:most] or cause[:most]).replace("<", "&lt;")  # a page takes it for HTML


SECTION = Section("mjcf", _ABOUT, measure, (corpus, drake, mujoco), KNOWN)
