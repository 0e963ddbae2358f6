"""What MuJoCo makes of a URDF that says something else: masses from shapes, merged links, visuals left out.

MuJoCo has a reader of URDF with settings of its own, which a `<mujoco>` element of the file may change. The same robot
as MJCF has none of this, because everything is written out there.
"""

from collections.abc import Callable, Iterator

from twinform.diagnostics.wording import plural
from twinform.ir import Document, Element, Format, Model


def read_otherwise(document: Document) -> tuple[str, ...]:
    """Say what MuJoCo makes otherwise of a URDF than it says; nothing for other formats."""
    if document.format is not Format.URDF:
        return ()
    return tuple(words for model in document.models for each in _DIFFERENCES if (words := each(model)))


def _masses_from_shapes(model: Model) -> str:
    # Measured with 4.0: links without <inertial> get the mass of their collisions, at 1000 kg/m^3.
    number = sum(1 for link in model.links if link.inertial is None and link.collisions)
    return f"gives {plural(number, 'link')} without inertial a mass, 1000 kg/m³ of their collisions" if number else ""


def _merged_links(model: Model) -> str:
    if _setting(model, "fusestatic") == "false":
        return ""
    number = sum(1 for joint in model.joints if joint.type == "fixed")
    return f"merges {plural(number, 'link')} on fixed joints into their parents" if number else ""


def _left_visuals(model: Model) -> str:
    if _setting(model, "discardvisual") == "false":
        return ""
    number = sum(len(link.visuals) for link in model.links)
    return f"leaves {plural(number, 'visual')} out" if number else ""


_DIFFERENCES: tuple[Callable[[Model], str], ...] = (_masses_from_shapes, _merged_links, _left_visuals)


def _setting(model: Model, name: str) -> str | None:
    """Return a setting of the `<compiler>` in a `<mujoco>` element; None where it has none."""
    values = (each.get(name) for each in _compilers(model))
    return next((value for value in values if value is not None), None)


def _compilers(model: Model) -> Iterator[Element]:
    for part in model.opaque:
        if part.element is not None and part.element.name == "mujoco":
            yield from part.element.find_all("compiler")
