"""The content of URDF's `<gazebo>`: tags of its own, and elements of SDF's links, joints and models."""

from collections.abc import Iterator
from functools import cache

from twinform.compiler.compare.compared_values import Text, Value
from twinform.compiler.normal_form.value_meanings import parsed_value
from twinform.passes.shared.gazebo_tags import JOINT_TAGS, LINK_TAGS, MODEL_TAGS
from twinform.schemas import Fact, XmlElement, parse_value, rows_by_name, table

_TAGS = MODEL_TAGS | JOINT_TAGS | LINK_TAGS
_HOLDERS = ("model", "joint", "link")
"""What a reference leads to. Where two of them have a child of one tag, it is of the same kind."""
_FIELDS = frozenset({"gravity", "self_collide"})
"""Booleans of a link in SDF that tags set too."""
_MATERIAL = "material"
POOLED = frozenset({"visual", "collision", "axis", "physics"})
"""Elements that add to what is there: all visuals and collisions of the link, the axis and physics of the joint."""

Path = tuple[str, ...]
_IN_AXIS: Path = ("axis", "dynamics")
_DAMPING: tuple[Path, ...] = (("velocity_decay", "linear"), ("velocity_decay", "angular"))


def tag_value(element: XmlElement) -> tuple[str, Value] | None:
    """The value of one of the extension's own tags, as a text or an attribute, and the name of the field that it sets.

    None where it is none of them. A field of SDF that has a tag of its own is as good as that tag.
    """
    name = str(element.tag)
    tag, text = _TAGS.get(name), (element.get("value") or element.text or "").strip()
    if len(element):
        return None
    if tag is None:
        return (name, _read("bool", text)) if name in _FIELDS and not element.attrib else None
    try:
        return tag.field or name, parsed_value(tag.read(text))
    except ValueError:
        return tag.field or name, Text(text)


def tag_paths(element: XmlElement) -> tuple[Path, ...]:
    """Where SDF has what one of the extension's own tags sets, if that is not at the top of a link, joint or model."""
    tag = None if len(element) else _TAGS.get(str(element.tag))
    if tag is None:
        return ()
    if tag.field == "velocity_decay":
        return _DAMPING
    places: dict[str, Path] = {
        "surface": ("collision", "surface", *_surface_paths().get(tag.field, ())),
        "collision": ("collision", tag.field),
        "dynamics": (*_IN_AXIS, tag.field),
        "physics": ("physics", *tag.field.split("/")),
    }
    return (places[tag.target],) if tag.target in places else ()


@cache
def _surface_paths() -> dict[str, Path]:
    """Where a `<surface>` has the values of the IR's fields."""
    sdf = table("sdf")

    def paths(row: Fact, above: Path) -> Iterator[tuple[str, Path]]:
        for name, inner in rows_by_name(row.rows, sdf.newest).items():
            if inner.type and inner.place:
                yield inner.place, (*above, name)
            elif inner.place:
                yield from paths(inner, (*above, name))

    return dict(paths(sdf.definitions["surface"], ()))


def _read(type_: str, text: str) -> Value:
    try:
        return parsed_value(parse_value(type_, text))
    except ValueError:
        return Text(text)


@cache
def extension_rows() -> dict[str, Fact]:
    """The rows of what is SDF in an extension, by tag."""
    sdf = table("sdf")
    rows = {
        name: row for each in _HOLDERS for name, row in rows_by_name(sdf.definitions[each].rows, sdf.newest).items()
    }
    return {**rows, _MATERIAL: Fact(_MATERIAL, count="*", reference=_MATERIAL)}
