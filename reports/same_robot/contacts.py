"""Do shapes that URDF lacks touch what they touch in SDF?"""

import importlib
import shutil
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from reports.harness.needs import drake, gazebo
from reports.harness.sample import Sample
from reports.harness.section import Findings, Section
from reports.same_robot.touched_shapes import BALLS, KINDS, Touched, touched_shapes
from testbed.corpus.files import ROOT
from testbed.engines.gazebo.contacts import Contact, contacts
from testbed.markdown import subsection, table

POSES = 200
SAME = 1e-9
"""The difference in m of what is the same."""
_SINGLE = 1e-6
"""What ODE adds for a mesh, which it keeps in single precision, and so does Drake's parser of OBJ files: m."""
_OUT = ROOT / "out" / "contacts"
_ABOUT = f"""\
{POSES} balls each touch capsules, ellipsoids and cones of any proportions, 2 cm to 50 cm large and placed at random,
{BALLS} each; the centers of the balls are outside of the shapes. Each shape is written as SDF and converted to URDF.
Both are read by libsdformat 12 and gz-physics 5, with the contacts of DART as Gazebo sets it up (ODE), and by Drake,
which says how far the center of a ball is away.

The parts of a capsule have to be as deep in a ball as the capsule, within {SAME:g} m, in the same engine. What
ellipsoids and cones are is computed from their definitions, as neither engine has cones, and the ellipsoids of both are
themselves approximations. Their meshes lie inside: a ball is never deeper in a mesh, and less deep by no more than the
error that the finding states. How deep ODE says that a ball is in a mesh depends on the triangles that it
touches, so in DART a ball grows until it touches the mesh."""


@dataclass(frozen=True, slots=True)
class Difference:
    """How much less deep a ball is in what stands for a shape, in m, and how much that may be."""

    kind: str
    engine: str
    missing: float
    error: float

    @property
    def fits(self) -> bool:
        """Whether it is as said."""
        slack = _SINGLE if self.error else SAME
        return -slack <= self.missing <= self.error + slack


def differences(count: int, seed: int, folder: Path, engines: Iterable[str]) -> Iterator[Difference]:
    """What differs for so many balls on shapes of each kind, in each engine."""
    for kind in KINDS:
        shapes = [*touched_shapes(kind, count, seed, folder)]
        for engine in engines:
            yield from _ENGINES[engine](shapes)


def _in_dart(shapes: list[Touched]) -> Iterator[Difference]:
    exact = [one for one in shapes if not one.error]
    meant = {one.sdf: each for one, each in zip(exact, _touches(exact, lambda one: one.sdf), strict=True)}
    for one, found in zip(shapes, _touches(shapes, lambda one: one.urdf), strict=True):
        if one.error:
            yield from _compared(one, "DART", one.depths, (one.radius - each.reach for each in found))
        else:
            own = meant[one.sdf]
            yield from _compared(one, "DART", (each.depth for each in own), (each.depth for each in found))


def _touches(shapes: list[Touched], file: Callable[[Touched], Path]) -> list[list[Contact]]:
    return contacts((file(one), one.radius, one.centers) for one in shapes)


def _in_drake(shapes: list[Touched]) -> Iterator[Difference]:
    for one in shapes:
        meant = one.depths if one.error else _drake_depths(one.sdf, one)
        yield from _compared(one, "Drake", meant, _drake_depths(one.urdf, one))


_ENGINES: Mapping[str, Callable[[list[Touched]], Iterator[Difference]]] = {"DART": _in_dart, "Drake": _in_drake}


def _compared(one: Touched, engine: str, meant: Iterable[float], found: Iterable[float]) -> Iterator[Difference]:
    return (Difference(one.kind, engine, a - b, one.error) for a, b in zip(meant, found, strict=True))


def _drake_depths(path: Path, one: Touched) -> list[float]:
    """How deep balls are in the shapes of a file in Drake."""
    plants: Any = importlib.import_module("pydrake.multibody.plant")
    parsing: Any = importlib.import_module("pydrake.multibody.parsing")
    builder: Any = importlib.import_module("pydrake.systems.framework").DiagramBuilder()
    plant, scene = plants.AddMultibodyPlantSceneGraph(builder, 0.0)
    parsing.Parser(plant).AddModels(str(path))
    plant.Finalize()
    diagram = builder.Build()
    query = scene.get_query_output_port().Eval(scene.GetMyContextFromRoot(diagram.CreateDefaultContext()))
    nearest = (min(each.distance for each in query.ComputeSignedDistanceToPoint(center)) for center in one.centers)
    return [one.radius - distance for distance in nearest]


def measure(sample: Sample) -> Findings:
    """Convert, read and touch."""
    shutil.rmtree(_OUT, ignore_errors=True)
    _OUT.mkdir(parents=True)
    found = [*differences(POSES // sample.every, sample.seed, _OUT, _ENGINES)]
    rows = [_row(kind, engine, found) for kind in KINDS for engine in _ENGINES]
    head = [
        "shape",
        "in URDF",
        "engine",
        "balls",
        "less deep, least",
        "less deep, most",
        "of the error, most",
        "as said",
    ]
    text = table(head, rows)
    wrong = [f"{each.engine}: {each.kind}: {each.missing:g} m of {each.error:g} m" for each in found if not each.fits]
    return Findings([subsection("How deep balls are", text)], text, wrong)


def _row(kind: str, engine: str, found: list[Difference]) -> tuple[object, ...]:
    own = [each for each in found if (each.kind, each.engine) == (kind, engine)]
    missing = [each.missing for each in own]
    share = f"{max(each.missing / each.error for each in own):.0%}" if own[0].error else ""
    what = "a mesh" if own[0].error else "a cylinder and two spheres"
    return (
        kind,
        what,
        engine,
        len(own),
        *(f"{1000 * each:.2g} mm" for each in (min(missing), max(missing))),
        share,
        sum(each.fits for each in own),
    )


SECTION = Section("contacts", _ABOUT, measure, (drake, gazebo))
