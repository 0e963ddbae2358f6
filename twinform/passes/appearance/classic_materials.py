"""The materials of Gazebo Classic as colors."""

import tomllib
from dataclasses import dataclass
from functools import cache
from importlib.resources import files

from twinform.ir import Color

_DATA = "data/classic_materials.toml"
# OGRE's default for an ambient or diffuse color that a material script does not set.
_WHITE = (1.0, 1.0, 1.0)


@dataclass(frozen=True, slots=True)
class ClassicMaterial:
    """The colors of a material; `shininess` is the exponent of the highlight, `textures` are file names."""

    ambient: Color
    diffuse: Color
    specular: Color | None
    emissive: Color | None
    shininess: float | None
    textures: tuple[str, ...]


@cache
def classic_materials() -> dict[str, ClassicMaterial]:
    """The materials of Gazebo Classic that have colors or images, by name."""
    text = files("twinform.passes.appearance").joinpath(_DATA).read_text(encoding="utf-8")
    rows: dict[str, dict[str, list[float] | list[str] | float]] = tomllib.loads(text)
    return {name: _read_material(row) for name, row in rows.items() if row}


def _read_material(row: dict[str, list[float] | list[str] | float]) -> ClassicMaterial:
    shininess, textures = row.get("shininess"), row.get("textures")
    return ClassicMaterial(
        ambient=_opaque_color(row.get("ambient")) or (*_WHITE, 1.0),
        diffuse=_opaque_color(row.get("diffuse")) or (*_WHITE, 1.0),
        specular=_opaque_color(row.get("specular")),
        emissive=_opaque_color(row.get("emissive")),
        shininess=float(shininess) if isinstance(shininess, int | float) else None,
        textures=tuple(map(str, textures)) if isinstance(textures, list) else (),
    )


def _opaque_color(value: object) -> Color | None:
    """Red, green, blue, and an alpha of one."""
    if not isinstance(value, list):
        return None
    parts: list[object] = value  # pyright: ignore[reportUnknownVariableType] - TOML promises no more than a list
    return (*(float(str(part)) for part in parts), 1.0)
