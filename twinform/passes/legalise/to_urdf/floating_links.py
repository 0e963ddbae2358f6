"""Reverse conversion of floating joints: restoring them between free links."""

from collections.abc import Iterator, Mapping

from twinform.diagnostics.rules import STALE_CARRIER
from twinform.ir import Element, Joint, Link, Model, Opaque, Pose
from twinform.ir.frames import WORLD, FrameError, FrameGraph
from twinform.passes.carriers.annotations import find_annotation, without_annotation
from twinform.passes.carriers.carriers import carry
from twinform.passes.legalise.to_sdf.joint_types import FLOATING
from twinform.passes.legalise.to_urdf.to_urdf_pass import UrdfKeeper


def with_floating_joints(model: Model, keeper: UrdfKeeper) -> Model:
    """The model with the annotated floating joints; one that fits the file no more is a `stale-carrier`."""
    if not _has_annotations(model):
        return model
    joints = list(model.joints)
    for link, annotation, fits in _annotated(model):
        name, parent = annotation.get("joint") or "", annotation.get("parent") or ""
        if not fits:
            message = f"link {link.name!r} hung from {parent!r} by the floating joint {name!r}, and no longer can"
            keeper.sink.report(STALE_CARRIER, message, link.location, found=name)
            continue
        joint = Joint(name=name, type="floating", parent=parent, child=link.name, pose=Pose(relative_to=link.name))
        rest = [Opaque.unchecked(element=child) for child in annotation.children]
        joints.append(carry(joint.copy(source=link.source), rest, "urdf"))
    links = tuple(without_annotation(link, FLOATING) for link in model.links)
    return model.copy(links=links, joints=tuple(joints))


def without_loose_floating(model: Model) -> Model:
    """The model without the annotations that fit the file no more."""
    if not _has_annotations(model):
        return model
    loose = {link.name for link, _, fits in _annotated(model) if not fits}
    links = (without_annotation(link, FLOATING) if link.name in loose else link for link in model.links)
    return model.copy(links=tuple(links))


def _has_annotations(model: Model) -> bool:
    return any(find_annotation(link, FLOATING) is not None for link in model.links)


def _annotated(model: Model) -> Iterator[tuple[Link, Element, bool]]:
    """Each annotated link, its annotation, and whether the joint can be: new name, free link, parent not below."""
    graph = FrameGraph(model)
    holders = {joint.child: joint.parent or WORLD for joint in model.joints if joint.child}
    names = {joint.name for joint in model.joints}
    for link in model.links:
        annotation = find_annotation(link, FLOATING)
        if annotation is None:
            continue
        name, parent = annotation.get("joint"), annotation.get("parent")
        fits = bool(name) and name not in names and link.name not in holders
        # A joint that an edit added may have put the old parent below the link: the floating joint
        # would close a circle.
        fits = fits and parent is not None and not _hangs_from(link.name, parent, holders, graph)
        if fits and name and parent:
            names.add(name)
            holders[link.name] = parent
        yield link, annotation, fits


def _hangs_from(link: str, name: str, holders: Mapping[str, str], graph: FrameGraph) -> bool:
    """Whether what is called `name` hangs from a link, or is nowhere."""
    seen: set[str] = set()
    while name != WORLD:
        try:
            name = graph.body(name, kind="link")
        except FrameError:
            return True
        if name == link:
            return True
        if name in seen or name not in holders:
            return False
        seen.add(name)
        name = holders[name]
    return False
