"""What a file is, by its name: mesh, image, sound, material script, data of a mesh. All else is put into no package."""

from pathlib import PurePath
from typing import Literal

FileKind = Literal["mesh", "image", "sound", "script", "data"]

_SUFFIXES: dict[FileKind, str] = {
    "mesh": "3ds 3mf blend bvh dae fbx glb gltf iv lwo lws msh obj off ply stl stla stlb usd usda usdc usdz vtk vtp "
    "wrl x x3d",
    "image": "asc bmp dds dem exr gif hdr hgt jpeg jpg ktx ktx2 pgm png ppm svg tga tif tiff vrt webp",
    "sound": "flac mp3 ogg wav",
    "script": "cg compositor frag glsl hlsl material metal particle program vert",
    "data": "bin mtl",
}
_KINDS: dict[str, FileKind] = {suffix: kind for kind, suffixes in _SUFFIXES.items() for suffix in suffixes.split()}


def suffix_of(path: PurePath | str) -> str:
    """The last ending of a name in lower case, without the dot."""
    return PurePath(path).suffix.lower().removeprefix(".")


def kind_of(path: PurePath | str) -> FileKind | None:
    """What a file is; None where its name says nothing that is known."""
    return _KINDS.get(suffix_of(path))
