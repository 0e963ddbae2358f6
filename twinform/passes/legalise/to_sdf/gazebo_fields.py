"""Assigning the values of `<gazebo>` tags to the SDF fields that they set."""

from collections.abc import Iterable, Iterator
from typing import Any

from lxml import etree

from twinform.ir import (
    Axis,
    Collision,
    Dynamics,
    Joint,
    Link,
    Material,
    Model,
    Opaque,
    Script,
    Surface,
    Visual,
)
from twinform.passes.carriers.carriers import from_xml
from twinform.passes.legalise.to_sdf.gazebo_merging import merge
from twinform.passes.shared.gazebo_tags import SCRIPT_URI, Tag
from twinform.schemas import format_value

Values = Iterable[tuple[Tag, Any]]


def set_model_fields(model: Model, values: Values) -> Model:
    """The model with the fields that tags set."""
    return model.copy(**{tag.field: value for tag, value in values})


def set_link_fields(link: Link, values: Values) -> Link:
    """The link with the fields that tags set as a whole."""
    update = {tag.field: value for tag, value in values if tag.target == "link"}
    return link.copy(**update) if update else link


def old_values(tag: Tag, link: Link) -> Iterator[object]:
    """What the shapes of a link have where a tag sets something; nothing for a tag about something else."""
    if tag.target == "surface":
        yield from (getattr(collision.surface, tag.field) for collision in link.collisions if collision.surface)
    elif tag.target == "collision":
        yield from (getattr(collision, tag.field) for collision in link.collisions)
    elif tag.target == "visual":
        scripts = (visual.material.script for visual in link.visuals if visual.material)
        yield from (script.name if script and script.uris == (SCRIPT_URI,) else script for script in scripts)


def set_visual(visual: Visual, values: Values) -> Visual:
    """The visual with the material that a tag names."""
    names = [str(value) for tag, value in values if tag.target == "visual" and value]
    if not names:
        return visual
    script = Script(uris=(SCRIPT_URI,), name=names[-1])
    material = (visual.material or Material()).copy(script=script)
    return visual.copy(material=material)


def set_collision(collision: Collision, values: Values) -> Collision:
    """The collision with the surface that tags describe."""
    own = {tag.field: value for tag, value in values if tag.target == "collision"}
    surface = {tag.field: value for tag, value in values if tag.target == "surface"}
    if surface:
        own["surface"] = (collision.surface or Surface()).copy(**surface)
    return collision.copy(**own) if own else collision


def set_joint_fields(joint: Joint, values: Values) -> Joint:
    """The joint with the springs and the physics that tags describe."""
    springs = {tag.field: value for tag, value in values if tag.target == "dynamics"}
    if springs:
        axis = joint.axis or Axis()
        dynamics = (axis.dynamics or Dynamics()).copy(**springs)
        joint = joint.copy(axis=axis.copy(dynamics=dynamics))
    physics = [(tag.field, value) for tag, value in values if tag.target == "physics"]
    return merge(joint, {"opaque": (_physics(physics),)}, []) if physics else joint


def _physics(values: list[tuple[str, object]]) -> Opaque:
    """The `<physics>` of a joint from paths below it and their values."""
    root = etree.Element("physics")
    for path, value in values:
        holder = root
        for step in path.split("/"):
            found = holder.find(step)
            holder = found if found is not None else etree.SubElement(holder, step)
        holder.text = format_value(value)
    return Opaque.unchecked(element=from_xml(root))
