"""Writes meshes as OBJ with materials, binary STL or binary glTF, each with our mark in it, and says how they look."""

import re
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from twinform.passes.mesh_jobs.libraries import np, trimesh
from twinform.passes.mesh_jobs.mesh_files import MARK

_DIGITS = 9
_STL_HEADER = 80
_Y_UP = np.array([[1, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]], dtype=float)
"""Turns a mesh whose z axis points up so that its y axis does."""

Parts = Sequence[tuple[str, Any]]


def write_mesh(parts: Parts, kind: str, *, stem: str = "mesh", y_up: bool = False) -> dict[str, bytes]:
    """Write meshes in a format; the files by what follows the stem in their names, the one of the format first."""
    return _WRITERS[kind](parts, stem, y_up)


def _obj(parts: Parts, stem: str, y_up: bool) -> dict[str, bytes]:
    del y_up
    text, others = trimesh.exchange.obj.export_obj(
        _scene(parts), include_normals=None, return_texture=True, digits=_DIGITS, mtl_name=f"{stem}.mtl", header=MARK
    )
    files = {".obj": text.encode()}
    if not any(name.endswith(".mtl") for name in others):
        files[".obj"] = re.sub(rb"(?m)^(mtllib|usemtl) .*\n", b"", files[".obj"])
    for name, data in others.items():
        if name.endswith(".mtl"):
            files[".mtl"] = _rename_textures(data, others, stem)
        else:
            files[f"_{name}"] = data
    return files


def _rename_textures(material: bytes, others: Mapping[str, bytes], stem: str) -> bytes:
    """The text of an MTL file, with textures under the names that their files will have."""
    for name in others:
        material = re.sub(
            rb"(?m)(\s)" + re.escape(name.encode()) + rb"$", rb"\g<1>" + f"{stem}_{name}".encode(), material
        )
    return material


def _stl(parts: Parts, stem: str, y_up: bool) -> dict[str, bytes]:
    del stem, y_up
    whole = trimesh.util.concatenate([_without_appearance(part) for _, part in parts])
    data = trimesh.exchange.stl.export_stl(whole)
    # OBJ, STL and glTF each have a place for who wrote them. Only a file with this mark is ever
    # write_mesh over.
    return {".stl": MARK.encode().ljust(_STL_HEADER, b" ")[:_STL_HEADER] + data[_STL_HEADER:]}


def _glb(parts: Parts, stem: str, y_up: bool) -> dict[str, bytes]:
    del stem
    turned = parts
    if y_up:
        turned = [(name, part.copy().apply_transform(_Y_UP)) for name, part in parts]

    def sign(tree: dict[str, Any]) -> None:
        tree["asset"]["generator"] = MARK

    return {".glb": trimesh.exchange.gltf.export_glb(_scene(turned), tree_postprocessor=sign)}


def _without_appearance(part: Any) -> Any:
    return trimesh.Trimesh(vertices=part.vertices, faces=part.faces, process=False)


def _scene(parts: Parts) -> Any:
    scene = trimesh.Scene()
    for name, part in parts:
        scene.add_geometry(part, geom_name=name, node_name=None)
    return scene


_WRITERS: Mapping[str, Callable[[Parts, str, bool], dict[str, bytes]]] = {"obj": _obj, "stl": _stl, "glb": _glb}


def turn_z_up(parts: Parts) -> list[tuple[str, Any]]:
    """Turn meshes of a glTF file, which has y up by its specification, so that z is up."""
    return [(name, part.copy().apply_transform(_Y_UP.T)) for name, part in parts]


def appearance_of(parts: Parts) -> set[str]:
    """What meshes have besides triangles: a set of `textures`, `vertex colors` and `colors`."""
    found: set[str] = set()
    for _, part in parts:
        visual = part.visual
        if visual.kind == "texture":
            material = visual.material
            image = getattr(material, "image", None) or getattr(material, "baseColorTexture", None)
            found.add("textures" if image is not None else "colors")
        elif visual.kind in {"vertex", "face"}:
            found.add("vertex colors")
    return found
