"""Assets of MJCF: meshes and height fields, one for each file and scale, and the paths of their files.

MuJoCo knows no packages: URIs are looked up, and written as paths from the folder of the document.
"""

import os
from pathlib import Path, PurePosixPath
from urllib.parse import unquote

from twinform.diagnostics import Location, rules
from twinform.ir import Node
from twinform.ir.geometry import Heightmap, Mesh
from twinform.ir.node import Vector3
from twinform.passes.framework.assets import AssetError
from twinform.passes.legalise.to_mjcf.elements import Value, make_element
from twinform.passes.legalise.to_mjcf.flat_meshes import Extent, extent_of
from twinform.passes.legalise.to_mjcf.kept_mjcf import kept_elements
from twinform.passes.legalise.to_mjcf.writing_context import MjcfContext

_MESHES = frozenset({"obj", "stl", "msh"})
"""The formats that MuJoCo reads without plugins."""
_CONVERT = "--passes 'convert-meshes{for=mujoco}' writes it as OBJ or STL beside the result"
_HEADER, _TRIANGLE = 84, 50
"""The bytes of a binary STL file before its triangles, and of each of them."""


def mesh_asset(context: MjcfContext, mesh: Mesh, wanted: str = "", *, touches: bool = False) -> str | None:
    """The name of the asset of a mesh; None, with a finding, where MuJoCo cannot read the file.

    The name is `wanted`, which it had in MJCF, or that of the file. `touches` is whether it is of a collision, of which
    MuJoCo wants a convex hull.
    """
    uri = (mesh.uri or "").strip()
    scale = None if mesh.scale in (None, (1.0, 1.0, 1.0)) else mesh.scale
    extent = _extent(context, uri)
    if extent is Extent.PLANE and touches:
        message = f"mesh {uri!r} is flat, and MuJoCo takes none for a collision"
        help_ = "make it a thin box, or show it in a visual alone"
        context.sink.report(rules.UNREADABLE_MESH, message, mesh.location, found=uri, help=help_)
        return None
    key = ("mesh", uri, scale, wanted)
    if key not in context.files:
        context.files[key] = _new_mesh(context, mesh, uri, scale, wanted)
    return context.files[key]


def _extent(context: MjcfContext, uri: str) -> Extent:
    """What the points of a file span; each file is looked at once."""
    key = ("extent", uri)
    if key not in context.files:
        path = find_file(context, uri) if PurePosixPath(uri).suffix.lower().removeprefix(".") in _MESHES else None
        context.files[key] = (Extent.SOLID if path is None else extent_of(context.assets.readable, path)).value
    return Extent(context.files[key])


def _new_mesh(context: MjcfContext, mesh: Mesh, uri: str, scale: Vector3 | None, wanted: str) -> str | None:
    why, extent = _why_unread(context, mesh, uri), _extent(context, uri)
    if why is None and extent is Extent.LINE:
        message = f"mesh {uri!r} has no surface, or less than four points, and MuJoCo refuses it"
        context.sink.report(rules.UNREADABLE_MESH, message, mesh.location, found=uri, help="leave it out")
        return None
    if why is not None:
        context.sink.report(rules.UNREADABLE_MESH, f"mesh {uri!r} {why}", mesh.location, found=uri, help=_CONVERT)
        return None
    file = file_path(context, uri, mesh.location)
    name = _asset_name(context, "mesh", wanted, PurePosixPath(file).stem or "mesh", mesh)
    # MuJoCo refuses a mesh without a volume unless its inertia is that of its surface.
    shell = "shell" if extent is Extent.PLANE else None
    attributes: list[tuple[str, Value]] = [("name", name), ("file", file), ("scale", scale), ("inertia", shell)]
    context.add("asset", make_element("mesh", attributes, (), mesh.source))
    return name


def _asset_name(context: MjcfContext, kind: str, wanted: str, usual: str, shape: Mesh | Heightmap) -> str | None:
    """The name that an asset had in MJCF, or else the usual one, if none that is kept has it."""
    if wanted:
        return context.name(kind, wanted, shape.location)
    return context.name(kind, usual, shape.location, context.kept_names(kind))


def _why_unread(context: MjcfContext, mesh: Mesh, uri: str) -> str | None:
    """Why MuJoCo cannot read a mesh; None where it can."""
    if any(part.element and part.element.name == "submesh" for part in mesh.opaque):
        return "is meant in part, and MuJoCo reads a whole file"
    if not uri:
        return "has no file"
    kind = PurePosixPath(uri).suffix.lower().removeprefix(".")
    if kind not in _MESHES:
        return (
            f"is of the format {kind!r}, which MuJoCo does not read" if kind else "has no suffix, by which MuJoCo goes"
        )
    if mesh.scale is not None and 0.0 in mesh.scale:
        return "has a scale of 0, which MuJoCo refuses"
    if kind == "stl" and (path := find_file(context, uri)) is not None and not _is_binary_stl(context, path):
        return "is STL as text, and MuJoCo reads it as binary alone"
    return None


def _is_binary_stl(context: MjcfContext, path: Path) -> bool:
    """Whether a file has the size that its number of triangles asks for; true where it cannot be read."""
    try:
        head = context.assets.readable.read(path, _HEADER)[:_HEADER]
        size = path.stat().st_size
    except OSError:
        return True
    return len(head) == _HEADER and size >= _HEADER + _TRIANGLE * int.from_bytes(head[80:84], "little")


def height_field(context: MjcfContext, shape: Heightmap, wanted: str = "") -> str | None:
    """The name of the asset of a terrain, `wanted` or that of the file; None, with a finding, where it is no PNG."""
    uri = (shape.uri or "").strip()
    if PurePosixPath(uri).suffix.lower() != ".png":
        message = f"terrain {uri!r} is no PNG, and MuJoCo reads no other image"
        context.sink.report(rules.UNSAYABLE_SHAPE, message, shape.location, found=uri, help="save it as PNG, in gray")
        return None
    size = vector_in(shape, "size", (1.0, 1.0, 1.0))
    key = ("hfield", uri, size, wanted)
    if key not in context.files:
        file = file_path(context, uri, shape.location)
        name = _asset_name(context, "hfield", wanted, PurePosixPath(file).stem, shape)
        # Half of the extents, and the height above the origin.
        above = (size[0] / 2, size[1] / 2, size[2])
        extent = (*above, _depth(context, name, above))
        attributes: list[tuple[str, Value]] = [("name", name), ("file", file), ("size", extent)]
        context.add("asset", make_element("hfield", attributes, (), shape.source))
        context.files[key] = name
    return context.files[key]


def _depth(context: MjcfContext, name: str | None, above: Vector3) -> float:
    """How far the ground goes down below its origin: as it was read, if the rest of its size is still the same."""
    assets = [each for _, model in (("", context.holder), *context.models) for each in kept_elements(model)]
    for field in (child for each in assets if each.name == "asset" for child in each.children):
        numbers = tuple(map(float, (field.get("size") or "").split()))
        if field.name == "hfield" and field.get("name") == name and numbers[:-1] == above:
            return numbers[-1]
    return usual_depth(above[2])


def usual_depth(height: float) -> float:
    """How far the ground of a terrain goes down below its origin, which SDF does not say and MuJoCo asks for."""
    return max(height, 1.0) / 100


def vector_in(node: Node, name: str, usual: Vector3) -> Vector3:
    """Three numbers in an untyped element of a node, or the usual ones where it has none."""
    for part in node.opaque:
        if not part.at and part.element is not None and part.element.name == name and part.element.text:
            x, y, z = map(float, part.element.text.split())
            return (x, y, z)
    return usual


def file_path(context: MjcfContext, uri: str, where: Location) -> str:
    """The path of a file as MuJoCo needs it: from the folder of the document, or absolute where it has none."""
    _, separator, rest = uri.partition("://")
    if not separator:
        return uri
    found = find_file(context, uri)
    folder = context.assets.folder
    if found is None:
        path = unquote(rest)
        message = f"{uri!r} leads to no file, and is written as {path!r}"
        help_ = "--path FOLDER, or GZ_SIM_RESOURCE_PATH and ROS_PACKAGE_PATH, say where packages and models are"
        context.sink.report(rules.UNMAPPED_URI, message, where, found=uri, help=help_)
        return path
    if folder is None:
        return found.as_posix()
    return Path(os.path.relpath(found.absolute(), folder.absolute())).as_posix()


def find_file(context: MjcfContext, uri: str) -> Path | None:
    """The file of a URI; None where there is none that may be read."""
    try:
        return context.assets.find(uri)
    except AssetError:
        return None
