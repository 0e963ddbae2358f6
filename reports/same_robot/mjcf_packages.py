"""Is what twinform makes of published MJCF the robot that MuJoCo reads, and does the file come home?"""

from reports.harness.known import Known
from reports.harness.needs import drake, mujoco, need, scipy
from reports.harness.sample import Sample
from reports.harness.section import UNEXPLAINED, Findings, Section
from reports.same_robot.mjcf_package_verdicts import Answer, PackageFile, Question, judge
from testbed.markdown import first, grouped, listing, subsection
from testbed.mjcf.canonical_models import PACKAGES, package_files

KNOWN = Known.beside(__file__)
_ABOUT = """\
Files of published packages (`make mjcf` downloads some; TWINFORM_MJCF names another folder), all that MuJoCo itself
reads. Asked of each is:

* **read**: is it read without an error, and is `convert --to mjcf` the **same tree**?
* **SDF in Drake**, **URDF in Drake**: joints, their types and ranges, the mass, center and inertia of each link, and at
  4 random positions and velocities the poses of all links, the mass matrix and the bias forces, against MuJoCo's own
  model of the MJCF, to 1e-9 (moments 1e-6; with meshes, whose points MuJoCo has in single precision, masses 1e-5).
  Armature is taken out of MuJoCo's model: the ledger names it; a free body stays where the file draws it, without
  `alignfree`. Each tree of bodies is a robot of URDF; of a file, the first eight are asked.
* **home from SDF**, **home from URDF**: the MJCF that the SDF or URDF becomes, against the source: each array of
  MuJoCo's model, to 1e-9, and the normal form of the canonical tree. Put aside are the order of elements, the carrier
  of nothing, and a written inertial where the source leaves it to MuJoCo. A world does not come home from URDF, which
  holds a robot alone.

A cell has how many files are the same, and of how many. Differences are explained where the conversion itself says
why, in its ledger or a finding: then the reason begins with the name of the rule. Other reasons were found by hand."""


def measure(sample: Sample) -> Findings:
    """Convert, compare, and bring home."""
    files = sample.of([PackageFile(path) for path in package_files()])
    found, died = sample.lists(judge, files, seconds=300)
    found.sort(key=lambda one: (one.name, one.question))
    counts = listing(["package", "files", *Question], _rows(found))
    odd = grouped(((one.question, why(one) or UNEXPLAINED, _shortened(one)), one.name) for one in found if one.cause)
    head = ["question", "why", "difference", "files", "for example"]
    listed = listing(head, ((*key, len(names), first(names, 1)) for key, names in odd.items()))
    parts = [subsection("Files by package", counts), subsection("What differs, and why", listed)]
    return Findings(parts, counts, [*(str(one) for one in found if one.cause and not why(one)), *died])


def why(one: Answer) -> str:
    """Why an answer is right as it is: by the conversion itself, or by hand; empty where nobody knows."""
    return one.reason or KNOWN.why(one.question.name.lower(), file=one.name, cause=one.cause)


def _rows(found: list[Answer]) -> list[list[object]]:
    by_package = {**grouped((one.package, one) for one in found), "all": found}
    return [
        [package, len({one.name for one in answers}), *(_share(answers, each) for each in Question)]
        for package, answers in by_package.items()
    ]


def _share(answers: list[Answer], question: Question) -> str:
    asked = [one for one in answers if one.question is question]
    named = sum(1 for one in asked if one.cause and why(one))
    same = sum(1 for one in asked if not one.cause)
    return f"{same} of {len(asked)}" + (f", {named} explained" if named else "")


def _shortened(one: Answer, most: int = 60) -> str:
    return one.cause.partition(";")[0].partition("'")[0][:most].strip()


SECTION = Section(
    "mjcf_packages",
    _ABOUT,
    measure,
    (
        need(lambda: bool(PACKAGES.is_dir()), f"there are no packages in {PACKAGES.name}: make mjcf"),
        drake,
        mujoco,
        scipy,
    ),
    KNOWN,
)
