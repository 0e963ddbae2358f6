"""Does a robot that falls and is driven end in MuJoCo, with our MJCF, where it ends in DART, with our SDF?"""

from collections import Counter
from collections.abc import Iterable, Iterator

from reports.harness.known import Known
from reports.harness.needs import corpus, gazebo, mujoco
from reports.harness.sample import Sample
from reports.harness.section import UNEXPLAINED, Findings, Section
from reports.same_robot.mjcf_motion_verdicts import BOUNDS, Moved, Place, drive
from testbed.corpus.files import Kind
from testbed.markdown import first, grouped, listing, subsection, table
from testbed.mjcf.driven import DROP, FINE, GRAVITY, PERIOD, PUSH, SECONDS, STEP

KNOWN = Known.beside(__file__)
_BINS = {"1e-6 m": 1e-6, "0.1 mm": 1e-4, "1 mm": 1e-3, "5 mm": 5e-3, "2 cm": 2e-2}
_MOST_SHOWN = 120
_ABOUT = f"""\
Every robot with a joint that may be driven, and up to 40 joints, is simulated for {SECONDS:g} s in DART of gz-physics
5, which gets the SDF (of a URDF, what it is converted to), and in MuJoCo, which gets our MJCF of that SDF. A force
on each joint swings as a sine of {PERIOD:g} s; it is as great as what alone gives the joint {PUSH:g} rad/s² or m/s²
where it is drawn. Gravity is {GRAVITY:g} m/s², steps are {STEP * 1000:g} ms. *In the air* there is no ground: free
robots fall, others swing where they are fixed. *On the ground* the lowest collision begins {DROP * 100:g} cm above a
plane. Meshes are left out. What counts is how far apart the two ends of a link are, for the link for which that is
most.

The bound is {BOUNDS[Place.AIR] * 1000:g} mm in the air, and {BOUNDS[Place.GROUND] * 1000:g} mm on the ground. What is
beyond it is examined, in this order:

* **contacts** and **steps of time**: ten times stiffer contacts in MuJoCo (`solref` 0.002), or a fourth of the step
  ({FINE * 1000:g} ms) in one of the engines alone, change the end by at least a third of what is between the engines.
  So it is these that decide, not what is written: a robot that tips over, or rolls, ends elsewhere for any small
  change.
* **a limit**, **mimics and loops**, **friction of joints**, **links without gravity**, **friction by direction**: the
  robot is driven once more without any of them, and then ends within the bound, or where details decide as above. DART
  stops a joint at its limit within a step, and holds it by its friction; in MuJoCo these are soft constraints, and a
  joint that is drawn beyond its limit is pushed back at once. gz-physics 5 has no mimics and no loops, and gravity for
  all links. MJCF has no `slip1` and no `fdir1`.
* what `mjcf_motion.toml` says of single robots."""


def measure(sample: Sample) -> Findings:
    """Drive all robots, and group what is beyond the bounds."""
    found, died = sample.lists(drive, sample.models(Kind.URDF, Kind.SDF), seconds=300)
    found.sort(key=lambda one: (one.place, one.name))
    moved = [one for one in found if one.driven is not None]
    counts = _counts(moved)
    odd = grouped(((one.place, _why(one) or UNEXPLAINED), one.name) for one in moved if not one.is_within)
    rows = [(*key, len(names), first(names, 2)) for key, names in odd.items()]
    left = Counter((one.place, one.cause) for one in found if one.driven is None)
    parts = [
        subsection("How far apart they end", counts),
        subsection("Beyond the bound, and why", listing(["where", "why", "robots", "for example"], rows)),
        subsection("Not driven", listing(["where", "why", "robots"], ((*key, count) for key, count in left.items()))),
        subsection("Robots within the bound", _listed(one for one in moved if one.is_within)),
    ]
    faults = [f"{one.place}: {one.name}: {one.driven}" for one in moved if not one.is_within and not _why(one)]
    return Findings(parts, counts, [*faults, *died])


def _counts(moved: list[Moved]) -> str:
    rows: list[tuple[object, ...]] = []
    for place in Place:
        ends = [one.driven.apart for one in moved if one.place is place and one.driven is not None]
        within = sum(one.is_within for one in moved if one.place is place)
        rows.append((place, len(ends), *(sum(end <= most for end in ends) for most in _BINS.values()), within))
    return table(["where", "robots", *(f"within {name}" for name in _BINS), "within the bound"], rows)


def _listed(moved: Iterable[Moved]) -> str:
    head = ["where", "file", "joints driven", "way, m", "apart, m", "DART, finer step", "MuJoCo, finer step"]
    return listing(head, _rows(moved), most=_MOST_SHOWN)


def _rows(moved: Iterable[Moved]) -> Iterator[tuple[object, ...]]:
    for one in moved:
        if (ends := one.driven) is not None:
            numbers = (f"{value:.1e}" for value in (ends.apart, ends.dart, ends.mujoco))
            yield (one.place, one.name, ends.joints, f"{ends.way:.2f}", *numbers)


def _why(one: Moved) -> str:
    return one.reason or KNOWN.why("apart", file=one.name, place=one.place)


SECTION = Section("mjcf_motion", _ABOUT, measure, (corpus, gazebo, mujoco), KNOWN)
