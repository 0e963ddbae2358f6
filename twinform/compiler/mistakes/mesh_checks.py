"""Checks of meshes: broken files, packages without their manifest, collisions that are missing or too detailed."""

import struct
from collections.abc import Sequence
from dataclasses import field
from pathlib import Path
from typing import NamedTuple

from twinform.compiler.resolve_uris import SearchPath, UriError, exists
from twinform.compiler.ros_packages import MANIFEST
from twinform.dataclass import dataclass
from twinform.diagnostics import DiagnosticSink, Rule, Severity, rules
from twinform.file_access import Readable
from twinform.ir import Document, Link, Mesh, Model, Vector3
from twinform.ir.bounds import Bounds
from twinform.passes.mesh_jobs.mesh_files import is_pointer, kind_of
from twinform.passes.shared.moving_bodies import movable_models

_HEAD = 2**18
"""So many bytes are read: more than enough for the kind, and for some thousand triangles."""
# Python looks at no more triangles and vertices of a file, which takes it a millisecond.
_MOST_POINTS = 600
_STL_HEADER = 84
_TRIANGLE = struct.Struct("<12x9f2x")
_OBJ_WORDS = frozenset({b"v", b"vn", b"vt", b"vp", b"f", b"o", b"g", b"s", b"mtllib", b"usemtl", b"#", b"l", b"p"})
_STARTS = {"glb": b"glTF", "ply": b"ply"}


@dataclass(slots=True)
class MeshFiles:
    """The files of the meshes of a document, by URI; each is read once."""

    readable: Readable
    paths: dict[str, Path] = field(default_factory=dict[str, Path])
    _heads: dict[Path, tuple[bytes, int]] = field(default_factory=dict[Path, "tuple[bytes, int]"])

    def head(self, path: Path) -> tuple[bytes, int] | None:
        """The first bytes of a file and its size; None where it cannot be read, which others report."""
        if path not in self._heads:
            try:
                self._heads[path] = self.readable.read(path, _HEAD)[:_HEAD], path.stat().st_size
            except OSError:
                return None
        return self._heads[path]

    def fault(self, path: Path) -> str | None:
        """What is wrong with a file, as the end of a sentence; None for a mesh, and for what is not known."""
        found = self.head(path)
        if found is None:
            return None
        content, size = found
        if not size:
            return "is empty"
        if is_pointer(content):
            return "is a pointer of Git LFS and not the mesh: run `git lfs pull`"
        return _fault_of_kind(kind_of(path), content, size)

    def box(self, uri: str, *, whole: bool = True) -> Bounds | None:
        """The box around a mesh, in its own units; None where it is not known.

        Of a large file only some points are looked at: where not the `whole` is asked for, a mesh is as large at least.
        """
        path = self.paths.get(uri.strip())
        found = self.head(path) if path else None
        if path is None or found is None or self.fault(path):
            return None
        content, size = found
        points = _points_of_stl(content) if kind_of(path) == "stl" else _points_of_obj(content, kind_of(path))
        return None if whole and (size > _HEAD or len(points) > _MOST_POINTS) else _box_of(points)


def _fault_of_kind(kind: str, content: bytes, size: int) -> str | None:
    text = content.lstrip()
    if kind == "stl" and text[:5].lower() != b"solid":
        return _fault_of_binary_stl(content, size)
    if kind == "stl" and b"facet" not in content and b"endsolid" not in content:
        return _fault_of_binary_stl(content, size)  # some binary files begin with the word `solid`
    if kind == "dae" and b"COLLADA" not in content:
        return "is no COLLADA file: it has no <COLLADA>"
    if kind == "obj" and not any(
        line.split(None, 1)[:1] == [word] for line in content.splitlines()[:200] for word in _OBJ_WORDS
    ):
        return "is no OBJ file: it has no vertices"
    start = _STARTS.get(kind)
    return f"is no {kind.upper()} file: it does not begin as one" if start and not content.startswith(start) else None


def _fault_of_binary_stl(content: bytes, size: int) -> str | None:
    if size < _STL_HEADER or content.lstrip()[:1] == b"<":
        return "is no STL file"
    count = int.from_bytes(content[80:_STL_HEADER], "little")
    need = _STL_HEADER + 50 * count
    if need > size:
        is_text = all(byte in b"\t\r\n" or 32 <= byte < 127 for byte in content[:200])
        return (
            "is no STL file" if is_text else f"is cut off: its {count} triangles take {need} bytes, and it has {size}"
        )
    return None


def _points_of_stl(content: bytes) -> Sequence[Vector3]:
    if content.lstrip()[:5].lower() == b"solid" and b"facet" in content:
        return _points_of_lines(content, b"vertex")
    body = content[_STL_HEADER:]
    count = len(body) // 50
    step = max(1, 3 * count // _MOST_POINTS)
    triangles = [_TRIANGLE.unpack_from(body, 50 * at) for at in range(0, count, step)]
    return [numbers[at : at + 3] for numbers in triangles for at in (0, 3, 6)]


def _points_of_obj(content: bytes, kind: str) -> Sequence[Vector3]:
    return _points_of_lines(content, b"v") if kind == "obj" else ()


def _points_of_lines(content: bytes, word: bytes) -> list[Vector3]:
    """The points of the lines that begin with a word."""
    rows = [parts for line in content.splitlines() if (parts := line.split())[:1] == [word] and len(parts) > 3]
    try:
        return [(float(x), float(y), float(z)) for _, x, y, z, *_ in rows[:: max(1, len(rows) // _MOST_POINTS)]]
    except ValueError:
        return []


def _box_of(points: Sequence[Vector3]) -> Bounds | None:
    if len(points) < 3:
        return None
    x, y, z = zip(*points, strict=True)
    return Bounds((min(x), min(y), min(z)), (max(x), max(y), max(z)))


_DETAILED = 2**20
"""A mesh of this size, in bytes, has 20,000 triangles as an STL: too many to touch with."""
_MOST_OF = 0.75
"""If so much of the links that are seen can be touched, a link that cannot was forgotten."""
_FEW = 5


class Fault(NamedTuple):
    """What is wrong with a file that is there."""

    rule: Rule
    message: str
    help: str | None = None


def find_mesh_fault(uri: str, shown: str, files: MeshFiles) -> Fault | None:
    """Find out whether a file that is there is no mesh of the kind that its name says; as `shown`."""
    fault = files.fault(files.paths[uri]) if uri in files.paths else None
    return Fault(rules.BROKEN_MESH, f"the mesh {shown!r} {fault}") if fault else None


def find_package_fault(uri: str, search: SearchPath, beside: Path) -> Fault | None:
    """Find out whether a package is a mere folder, which ROS does not find."""
    name = uri.removeprefix("package://").partition("/")[0]
    try:
        folder = search.package(name, beside)
    except UriError:
        return None
    if exists(folder / MANIFEST):
        return None
    message = f"package {name!r} is found as a folder, which has no {MANIFEST}: ROS knows no such package"
    hint = f"add a {MANIFEST} with <name>{name}</name>, or write the name of the package that the folder is in"
    return Fault(rules.PACKAGE_WITHOUT_MANIFEST, message, hint)


def report_collisions(document: Document, files: MeshFiles, sink: DiagnosticSink) -> None:
    """Report links that are seen and cannot be touched, and large meshes that serve for both."""
    for model in movable_models(document):
        _report_untouchable(model, sink)
        for link in model.links:
            _report_detailed(link, files, sink)


def _report_untouchable(model: Model, sink: DiagnosticSink) -> None:
    seen = [link for link in model.links if link.visuals and link.inertial and link.inertial.mass]
    without = [link for link in seen if not link.collisions]
    if len(seen) < _FEW or not without or len(without) > (1 - _MOST_OF) * len(seen):
        return
    moved = {joint.child for joint in model.joints if joint.type != "fixed"}
    # One that was forgotten stands out; where several have none, it is mostly meant.
    severity = None if len(without) == 1 else Severity.INFO
    for link in without:
        if link.name in moved:
            others = f"{len(seen) - len(without)} of {len(seen)} links"
            message = f"link {link.name!r} moves and has no <collision>; {others} of {model.name!r} have one"
            sink.report(rules.MISSING_COLLISION, message, link.location, expected="<collision>", severity=severity)


def _report_detailed(link: Link, files: MeshFiles, sink: DiagnosticSink) -> None:
    seen = {shape.uri for each in link.visuals if each.geometry and isinstance(shape := each.geometry.shape, Mesh)}
    for each in link.collisions:
        shape = each.geometry.shape if each.geometry else None
        path = files.paths.get((shape.uri or "").strip()) if isinstance(shape, Mesh) and shape.uri in seen else None
        found = files.head(path) if path else None
        if path and found and shape and found[1] > _DETAILED and not files.fault(path):
            size = f"{found[1] / 2**20:.1f} MiB"
            count = f", {(found[1] - 84) // 50} triangles" if kind_of(path) == "stl" else ""
            message = (
                f"the collision of link {link.name!r} is the mesh of its visual, of {size}{count}: contacts are slow"
            )
            hint = "make a simple one: --passes simplify-collisions"
            sink.report(rules.DETAILED_COLLISION, message, shape.location, found=path.name, help=hint)
