"""Nested models that an edit had put into a document of MJCF: they come back of the links that are parts of them."""

from collections.abc import Mapping, Sequence

from twinform.compiler.input.mjcf.models_of_world import is_static_frame
from twinform.compiler.input.mjcf.renamed_parts import name_in_file
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Element, Format, Frame, Joint, Model
from twinform.ir.frames import WORLD
from twinform.ir.scopes import SCOPE
from twinform.passes.carriers.annotations import MADE_NAME, find_annotation, is_annotation
from twinform.passes.carriers.mjcf_texts import PART
from twinform.passes.legalise.changed_names import Names, renamed
from twinform.passes.legalise.nested_models import NameScopes, RestoreNested


def nested_back(model: Model, frames: Sequence[Frame], bodies: Mapping[str, str], sink: DiagnosticSink) -> Model:
    """Put links, joints and frames into the nested models whose frames are carried, as far as they are still there.

    `bodies` has the names of links by those of bodies.
    """
    names: Names = {}
    for frame in frames:
        for part in _parts(frame):
            names |= _name(part, f"{frame.name}{SCOPE}", model, bodies)
    placed = tuple(_placed(each, bodies, model) for each in frames)
    static = tuple(f"{each.name}{SCOPE}" for each in frames if is_static_frame(each))
    joints = tuple(each for each in model.joints if not _only_holds(each, static, names))
    whole = renamed(model.copy(joints=joints, frames=(*model.frames, *placed)), names, Format.SDF)
    for step in (NameScopes.unchecked(), RestoreNested.unchecked()):
        whole = step.run_model(whole, sink)
    return whole


def is_nested_in(frame: Frame, bodies: Mapping[str, str]) -> bool:
    """Whether the frame of a nested model is of one among these bodies; those have the names of links."""
    return frame.attached_to in bodies or any(part.get("as") in bodies for part in _parts(frame))


def _parts(frame: Frame) -> list[Element]:
    return [part.element for part in frame.opaque if part.element is not None and is_annotation(part, PART)]


def _name(part: Element, scope: str, model: Model, bodies: Mapping[str, str]) -> Names:
    """The scoped name of a part of a nested model, by its kind and the name that it has in the file."""
    new, written, holds = f"{scope}{part.get('name')}", part.get("as"), bodies.get(part.get("holds") or "")
    match part.get("kind"):
        case "link":
            link = bodies.get(written or "")
            return {} if link is None else {("link", link): new}
        case "joint":
            found = (each for each in model.joints if holds == each.child or name_in_file(each) == written)
            return {("joint", each.name): new for each in found if written or each.type == "fixed"}
        case "frame":
            return {("frame", each.name): new for each in model.frames if name_in_file(each) == written}
        case _:
            return {}


def _placed(frame: Frame, bodies: Mapping[str, str], model: Model) -> Frame:
    """The frame of a nested model, attached to a link by its name in the document, or else to the model."""
    kept = tuple(part for part in frame.opaque if not is_annotation(part, PART))
    to = bodies.get(frame.attached_to or "")
    pose = frame.pose and frame.pose.copy(relative_to=None)
    return frame.copy(attached_to=to, pose=pose, opaque=kept, source=model.source)


def _only_holds(joint: Joint, static: tuple[str, ...], names: Names) -> bool:
    """Whether a joint was read because a static nested model has a body without one in the world."""
    is_made = joint.type == "fixed" and joint.parent == WORLD and find_annotation(joint, MADE_NAME) is not None
    return is_made and names.get(("link", joint.child or ""), "").startswith(static or "\0")
