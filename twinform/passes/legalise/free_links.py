"""Links that need no joint in SDF: free ones, with frames that place them, and those in static models."""

from collections.abc import Container, Iterable, Iterator, Mapping
from collections.abc import Set as AbstractSet
from typing import ClassVar

from twinform.diagnostics import DiagnosticSink
from twinform.diagnostics.rules import STALE_CARRIER
from twinform.ir import Element, Format, Frame, GazeboExtension, Joint, Link, Model, Opaque
from twinform.ir.frames import WORLD, FrameError, FrameGraph
from twinform.ir.transform import Transform
from twinform.passes.carriers.annotations import (
    annotate_synthesized,
    came_from,
    find_annotation,
    is_annotation,
    is_synthesized,
)
from twinform.passes.carriers.carriers import to_element
from twinform.passes.framework.pass_base import ModelPass
from twinform.passes.legalise.changed_names import scoped_name, scopes_in
from twinform.passes.legalise.frame_links import frame_as_before
from twinform.passes.legalise.to_urdf_pass import ToUrdfPass, UrdfKeeper
from twinform.passes.shared.poses import FRAME, NESTED

_CLOSE = 1e-9
"""The relative tolerance for numbers that were written from the same value."""


def links_in_static_models(model: Model) -> frozenset[str]:
    """The links of a model that is static in the SDF that it came from, or of the static models that it has there.

    A static model that does not say so keeps its joints to the world: nobody makes them anew, with their frames and all
    that is set for them.
    """
    if model.static:
        return frozenset(link.name for link in model.links if came_from(model, Format.SDF))
    frames = (*model.links, *model.frames)  # a frame of SDF is a link at first
    scopes = tuple(f"{scoped_name(frame)}::" for frame in frames if is_static(find_annotation(frame, NESTED)))
    return frozenset(link.name for link in model.links if scoped_name(link).startswith(scopes))


def needs_no_joint(joint: Joint, held: frozenset[str]) -> bool:
    """Whether a joint is left out in SDF; `held` are the links of static models."""
    if joint.type == "floating":
        return True
    return joint.type == "fixed" and joint.parent == WORLD and joint.child in held and is_synthesized(joint)


def placing_frames(model: Model, joints: Iterable[Joint]) -> Mapping[str, Frame]:
    """A frame in `<gazebo>` for each floating joint of URDF, by its name; none where the links form no tree.

    libsdformat writes no such joint, and still poses the link relative to it, so that it refuses the file without a
    frame of that name: parser_urdf.cc, CreateLink.
    """
    children = {joint.child for joint in model.joints}
    root = next((link.name for link in model.links if link.name not in children), "")
    graph = FrameGraph(model)
    try:
        poses = {joint.name: graph.pose(joint.child or "", root).to_pose() for joint in joints}
    except FrameError:
        return {}
    return {name: annotate_synthesized(Frame.unchecked(name=name, pose=pose)) for name, pose in poses.items()}


def are_at_one_place(frame: Frame, other: Frame) -> bool:
    """Whether the poses of two frames are equal within the precision of files."""
    one, two = (Transform.from_pose(each.pose) for each in (frame, other))
    numbers = zip((*one.translation, *one.rotation), (*two.translation, *two.rotation), strict=True)
    return all(abs(a - b) <= _CLOSE * max(1.0, abs(a)) for a, b in numbers)


def is_static(nested: Element | None) -> bool:
    """Whether the annotation of a nested model says that it is static."""
    static = nested.find("static") if nested else None
    return static is not None and (static.text or "").strip() in {"true", "1"}


class PlaceFreeLinks(ToUrdfPass):
    """Say where Gazebo finds the links that hang from the first root by floating joints.

    libsdformat writes no such joint, and still poses the link relative to it, so that it refuses the file. A frame by
    the name of the joint, in a `<gazebo>` element, is what it looks for.
    Changes: 1. each floating joint that a conversion synthesized gets such a frame, with the pose of the link; 2. what
    was a frame by the name of a floating joint is none of the links but such a frame again: a `<gazebo>` for the joint
    would set something in the link.
    Never touches: floating joints of the source; a link from which another one hangs.
    Diagnostics: none.
    """

    name: ClassVar[str] = "place-free-links"

    def run_model(self, model: Model, keeper: UrdfKeeper) -> Model:
        """The model with a frame for each synthesized floating joint, and those that others wrote."""
        floating = [joint for joint in model.joints if joint.type == "floating"]
        if not floating:
            return model
        written = {frame.name: frame for frame in _frames_of(model, {joint.name for joint in floating})}
        # The frame is a second pose, and there is no way around it. The one of the joint counts;
        # `stale-carrier` says where an edit has made the two differ.
        frames = (*placing_frames(model, filter(is_synthesized, floating)).values(), *written.values())
        extensions = (GazeboExtension.unchecked(content=(to_element(frame, "frame", "sdf"),)) for frame in frames)
        return model.copy(
            links=tuple(link for link in model.links if link.name not in written),
            joints=tuple(joint for joint in model.joints if joint.child not in written),
            extensions=(*model.extensions, *extensions),
        )


def _frames_of(model: Model, names: Container[str]) -> Iterator[Frame]:
    """The frames with these names that became links, and from which nothing hangs."""
    links = {link.name: link for link in model.links if link.name in names}
    parents = {joint.parent for joint in model.joints}
    for joint in filter(is_synthesized, model.joints):
        link = links.get(joint.child or "")
        annotation = find_annotation(link, FRAME) if link else None
        if link and annotation and link.name not in parents:
            yield frame_as_before(joint, link, annotation, joint.pose)


class FreeStaticModels(ModelPass):
    """Let go of the static models of SDF that the URDF does not hold to the world.

    Changes: the annotation of a nested model says no more that it is static, if one of its links hangs from something
    else than the world or one of its own, by a joint that moves or by none.
    Never touches: nested models in a static one.
    Diagnostics: `stale-carrier`.
    """

    name: ClassVar[str] = "free-static-models"

    def run_model(self, model: Model, sink: DiagnosticSink) -> Model:
        """The model whose nested static models are held."""
        static = [link for link in model.links if is_static(find_annotation(link, NESTED))]
        if not static or model.static:
            return model
        free = _free_models(model, frozenset(map(scoped_name, static)))
        for link in static:
            if scoped_name(link) in free:
                message = f"model {scoped_name(link)!r} is not static any more: the joints of the URDF let it move"
                sink.report(STALE_CARRIER, message, link.location, found=link.name)
        links = tuple(_without_static(link) if scoped_name(link) in free else link for link in model.links)
        return model.copy(links=links)


def _free_models(model: Model, static: AbstractSet[str]) -> AbstractSet[str]:
    """Return the static nested models that have a link which neither the world nor the model itself holds."""
    above = {joint.child: joint for joint in model.joints}
    names = {link.name: scoped_name(link) for link in model.links}
    free = set[str]()
    for link, scoped in names.items():
        joint = above.get(link)
        if joint is None or joint.type != "fixed" or joint.parent != WORLD:
            # A joint between two links of one model is its own affair, so only the models that the
            # parent is not in are let go.
            free |= (scopes_in(scoped) & static) - scopes_in(names.get((joint and joint.parent) or "", ""))
    return free


def _without_static(link: Link) -> Link:
    opaque = tuple(_without_static_element(part) if is_annotation(part, NESTED) else part for part in link.opaque)
    return link.copy(opaque=opaque)


def _without_static_element(part: Opaque) -> Opaque:
    element = part.element or Element.unchecked(name="")
    children = tuple(child for child in element.children if child.name != "static")
    return part.copy(element=element.copy(children=children))
