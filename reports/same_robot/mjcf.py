"""Is our MJCF the same robot: as MuJoCo reads the URDF itself, and as Drake reads the SDF?"""

import re

from reports.harness.known import Known
from reports.harness.needs import corpus, drake, mujoco
from reports.harness.sample import Sample
from reports.harness.section import Findings, Section
from reports.same_robot.mjcf_verdicts import judge
from reports.same_robot.reader_verdicts import Outcomes, Verdict, complaints
from testbed.corpus.files import Kind
from testbed.markdown import subsection

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


def measure(sample: Sample) -> Findings:
    """Write, compile and compare."""
    found, died = sample.lists(judge, sample.models(Kind.URDF, Kind.SDF), seconds=120)
    found.sort(key=lambda one: (one.ways, one.name))
    outcomes = Outcomes(found, KNOWN, {"kind": "file"})
    refused = [((*one.ways, _shortened(one.cause)), one.name) for one in found if one.verdict is Verdict.SOURCE]
    parts = [
        subsection("What becomes of a file", outcomes.counts()),
        subsection("What is not the same, and why", outcomes.reasons()),
        subsection("Complaints about the sources", complaints(["file", "complaint", "files"], refused, most=30)),
    ]
    return Findings(parts, outcomes.counts(), [*outcomes.unexplained(), *died])


def _shortened(cause: str, most: int = 90) -> str:
    """A complaint without the names in it, so that like ones are counted together."""
    cause = _PLACE.sub("", cause)
    text = cause.partition("Element")[0].partition("'")[0].partition("[")[0].strip()
    return (text[:most] or cause[:most]).replace("<", "&lt;")  # a page takes it for HTML


SECTION = Section("mjcf", _ABOUT, measure, (corpus, drake, mujoco), KNOWN)
