"""Restoring `<gazebo>` tags that a later tag of the same field overrides."""

from twinform.ir import Element, GazeboExtension, Model, Opaque
from twinform.passes.shared.gazebo_tags import JOINT_TAGS, LINK_TAGS, MODEL_TAGS, Tag

_TAGS = MODEL_TAGS | JOINT_TAGS | LINK_TAGS
_ELEMENTS = {"surface": "collision", "collision": "collision", "physics": "physics", "dynamics": "axis"}
"""The SDF that does in an extension what tags of these targets do, and that counts after them."""


def with_overruled(model: Model, extension: Element) -> Model | None:
    """The model with the content of a `<gazebo>` back; None where nothing overrules it any more."""
    reference = extension.get("reference")
    for element in extension.children:
        if (found := _with_tag(model.extensions, reference, element)) is not None:
            model = model.copy(extensions=found)
        elif (parts := _before_carried(model.opaque, extension, element)) is not None:
            model = model.copy(opaque=parts)
        else:
            return None
    return model


def _before_carried(parts: tuple[Opaque, ...], extension: Element, element: Element) -> tuple[Opaque, ...] | None:
    """The parts of a model, with a tag before the `<gazebo>` that overrules it and that traveled itself."""
    tag, place = _TAGS.get(element.name), (extension.name, extension.attributes)
    for index, part in enumerate(parts):
        if tag is None or part.element is None or (part.element.name, part.element.attributes) != place:
            continue
        if any(_overrules(other, tag) for other in part.element.children):
            alone = Opaque.unchecked(element=extension.copy(children=(element,)))
            return (*parts[:index], alone, *parts[index:])
    return None


def _with_tag(
    extensions: tuple[GazeboExtension, ...], reference: str | None, element: Element
) -> tuple[GazeboExtension, ...] | None:
    tag = _TAGS.get(element.name)
    for index, one in enumerate(extensions):
        if tag is None or (one.reference or None) != (reference or None):
            continue
        place = next((at for at, other in enumerate(one.content) if _overrules(other, tag)), None)
        if place is not None:
            content = (*one.content[:place], element, *one.content[place:])
            return (*extensions[:index], one.copy(content=content), *extensions[index + 1 :])
    return None


def _overrules(other: Element, tag: Tag) -> bool:
    """Whether another element of an extension sets the same field, and after the tag where it stands behind it."""
    same = _TAGS.get(other.name)
    if same is not None and not other.children:
        return (same.target, same.field) == (tag.target, tag.field)
    leaf = tag.field.rpartition("/")[2]
    return other.name == _ELEMENTS.get(tag.target) and any(inner.name == leaf for inner in other.walk())
