"""Mesh files as solids, read by `trimesh`, in the frame of the shape."""

import importlib
import math
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from twinform.diagnostics import Rule
from twinform.diagnostics.rules import meshes as rules
from twinform.ir import Element, Mesh, Vector3
from twinform.ir.principal_moments import times_each
from twinform.ir.scaling import common_exponent, times_power
from twinform.ir.solids import Solid
from twinform.passes.analyses.mesh_files import EXTRA, READ, kind_of, open_scene
from twinform.passes.framework.asset_access import AssetError, Assets

_Triangles = Any
"""A `trimesh.Trimesh`."""


class MeshError(Exception):
    """Why nothing can be computed from a mesh, as a diagnostic would say it."""

    def __init__(self, rule: Rule, message: str, help: str | None = None) -> None:
        super().__init__(message)
        self.rule = rule
        self.message = message
        self.help = help


@dataclass(frozen=True, slots=True)
class Meshes:
    """The mesh files of a document, each read once. Where `hull`, an open mesh stands for its convex hull.

    Lengths are in meters: a COLLADA file names its unit, and other formats are taken to be in meters, as in simulators.
    Like Gazebo and RViz this does not turn a mesh whose file has another axis than z pointing up.
    """

    assets: Assets
    hull: bool = False
    _read: dict[tuple[Path, str | None, bool], _Triangles] = field(
        default_factory=dict[tuple[Path, str | None, bool], _Triangles], repr=False
    )

    def solid(self, mesh: Mesh, density: float) -> Solid:
        """The mesh filled with a density in kg/m^3, in the frame of its shape.

        Raises:
            MeshError: the file is not there, cannot be read, or its mesh has no inside.
        """
        whole, middle, exponent = _in_units(mesh, self._scaled(mesh))
        with_unit_density = self._closed(mesh, whole).mass_properties
        volume = float(with_unit_density["volume"])
        x, y, z = (times_power(float(at), exponent) for at in with_unit_density["center_mass"])
        rows = [[density * float(entry) + 0.0 for entry in row] for row in with_unit_density["inertia"]]  # never -0
        inertia = (rows[0][0], rows[1][1], rows[2][2], rows[0][1], rows[0][2], rows[1][2])
        center = (x + middle[0], y + middle[1], z + middle[2])
        return Solid(times_power(density * volume, 3 * exponent), center, times_each(inertia, 5 * exponent))

    def bounds(self, mesh: Mesh) -> tuple[Vector3, Vector3]:
        """The least and the greatest coordinates of the mesh, in the frame of its shape.

        Raises:
            MeshError: the file is not there, or cannot be read.
        """
        least, greatest = self._scaled(mesh).bounds.tolist()
        return (least[0], least[1], least[2]), (greatest[0], greatest[1], greatest[2])

    def triangles(self, mesh: Mesh) -> _Triangles:
        """The triangles of the mesh, in the frame of the shape.

        Raises:
            MeshError: the file is not there, or cannot be read.
        """
        return self._scaled(mesh)

    def _scaled(self, mesh: Mesh) -> _Triangles:
        try:
            path = self.assets.find(mesh.uri or "")
        except AssetError as error:
            raise MeshError(error.rule, error.message, error.help) from error
        key = (path, *submesh_of(mesh))
        if key not in self._read:
            self._read[key] = _read(path, mesh.uri or "", *submesh_of(mesh))
        triangles = self._read[key].copy()
        if mesh.scale:
            triangles.vertices = triangles.vertices * mesh.scale  # `apply_scale` leaves out what is nearly one
        return triangles

    def _closed(self, mesh: Mesh, triangles: _Triangles) -> _Triangles:
        """The mesh, or its hull, with faces that look outward."""
        if triangles.is_watertight and triangles.is_winding_consistent and triangles.volume:
            if triangles.volume < 0:  # turned inside out, by the file or by a negative scale
                triangles.invert()
            return triangles
        if self.hull:
            return _hull(mesh, triangles)
        message = f"the mesh {mesh.uri!r} has no inside: {_fault(triangles)}"
        raise MeshError(rules.OPEN_MESH, message, "close it, or use its convex hull")


def _in_units(mesh: Mesh, triangles: _Triangles) -> tuple[_Triangles, Vector3, int]:
    """The mesh with its middle at the origin and of about unit size, where its middle was, and the power of two.

    The integrals of a mesh that is far from the origin are differences of large numbers.

    Raises:
        MeshError: it is larger than doubles say.
    """
    least, greatest = triangles.bounds.tolist()
    x, y, z = (low / 2 + high / 2 for low, high in zip(least, greatest, strict=True))
    exponent = common_exponent(high / 2 - low / 2 for low, high in zip(least, greatest, strict=True))
    if not all(map(math.isfinite, (*least, *greatest))):
        raise MeshError(rules.UNREADABLE_MESH, f"the mesh {mesh.uri!r} is too large for numbers")
    half = math.ldexp(1.0, -exponent // 2)  # in two steps: the power itself may be no double
    triangles.vertices = (triangles.vertices - (x, y, z)) * half * math.ldexp(1.0, -exponent - (-exponent // 2))
    return triangles, (x, y, z), exponent


def _fault(triangles: _Triangles) -> str:
    if not triangles.is_watertight:
        return "its surface has holes"
    return "it encloses nothing" if triangles.is_winding_consistent else "its faces do not agree which side is outside"


def _hull(mesh: Mesh, triangles: _Triangles) -> _Triangles:
    try:
        hull = triangles.convex_hull
    except ImportError as error:
        raise MeshError(rules.MESH_READER_MISSING, f"convex hulls need scipy: {error}", EXTRA) from error
    except Exception as error:  # flat, or of fewer than four points; scipy raises an error of its own
        message = f"the mesh {mesh.uri!r} has no convex hull with an inside"
        raise MeshError(rules.OPEN_MESH, message) from error
    if not hull.volume > 0:
        raise MeshError(rules.OPEN_MESH, f"the mesh {mesh.uri!r} is flat")
    return hull


def submesh_of(mesh: Mesh) -> tuple[str | None, bool]:
    """The part of the file that `<submesh>` names, and whether it is moved to the origin."""
    found = next((part.element for part in mesh.opaque if part.element and part.element.name == "submesh"), None)
    if found is None:
        return None, False
    return _text(found, "name"), _text(found, "center") in {"1", "true"}


def _text(element: Element, name: str) -> str | None:
    child = element.find(name)
    return (child.text or "").strip() if child else None


def _read(path: Path, uri: str, submesh: str | None, center: bool) -> _Triangles:
    if not path.is_file():
        raise MeshError(rules.UNREADABLE_MESH, f"the mesh {uri!r} is no file")
    if kind_of(path) not in READ:
        message = f"the mesh {uri!r} is in no format that is read here: {', '.join(sorted(READ))}"
        raise MeshError(rules.UNREADABLE_MESH, message)
    try:
        triangles = _triangles(path, submesh)
    except ImportError as error:
        message = f"the mesh {uri!r} is not looked into: {error.name} is not installed"
        raise MeshError(rules.MESH_READER_MISSING, message, EXTRA) from error
    except Exception as error:  # readers of six formats raise whatever they like
        message = f"the mesh {uri!r} cannot be read: {str(error) or type(error).__name__}"
        raise MeshError(rules.UNREADABLE_MESH, message) from error
    if center:
        triangles.apply_translation(-triangles.bounds.mean(axis=0))
    return triangles


def _triangles(path: Path, submesh: str | None) -> _Triangles:
    """The triangles of a file in meters, with vertices merged that are at one place.

    Raises:
        Exception: what the reader of the format raises, or ours where nothing is left.
    """
    scene = open_scene(path)
    trimesh: Any = importlib.import_module("trimesh")
    whole = scene.to_mesh() if submesh is None else _part(trimesh, scene, submesh)
    meter = _unit(trimesh, scene.geometry.values()) if kind_of(path) == "dae" else 1.0
    # made anew, so that vertices which differ in their appearance are merged as well
    triangles = trimesh.Trimesh(vertices=whole.vertices * meter, faces=whole.faces, process=True)
    if not len(triangles.faces):
        raise ValueError("it has no triangles")
    return triangles


def _part(trimesh: Any, scene: Any, name: str) -> _Triangles:
    """One submesh, wherever the file puts it."""
    placed = (scene.graph[node] for node in scene.graph.nodes_geometry)
    found = [scene.geometry[name].copy().apply_transform(at) for at, which in placed if which == name]
    if not found:
        known = ", ".join(sorted(map(str, scene.geometry))[:6])
        raise ValueError(f"it has no submesh {name!r}, it has {known}")
    return trimesh.util.concatenate(found)


def _unit(trimesh: Any, geometry: Iterable[Any]) -> float:
    """The unit of a COLLADA file in meters, which `trimesh` leaves in the notes of its meshes."""
    unit = next((str(each.metadata["units"]) for each in geometry if each.metadata.get("units")), "meters")
    return float(trimesh.units.unit_conversion(unit, "meters"))
