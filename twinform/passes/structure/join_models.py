"""Joining two models into one by a fixed joint."""

from collections.abc import Iterable
from typing import NamedTuple

from twinform.diagnostics import DiagnosticSink, rules
from twinform.ir import Element, Include, Joint, Model, Node, Opaque, Pose, map_references
from twinform.ir.frames import WORLD
from twinform.ir.node import Vector3
from twinform.ir.transform import Transform
from twinform.passes.carriers.annotations import without_annotation
from twinform.passes.carriers.provenance import FROM
from twinform.passes.includes.merge import merge_into_model
from twinform.passes.transforms.pose_notation import OFFSET, POSE


class Mount(NamedTuple):
    """Where a model is attached: the link `held` of it to the link `to`, at a pose in that link's frame.

    `prefix` goes before names that would mean two things.
    """

    to: str
    held: str
    joint: str
    xyz: Vector3
    rpy: Vector3
    prefix: str

    def pose(self, relative_to: str) -> Pose:
        """The pose, without what is zero."""
        zero = (0.0, 0.0, 0.0)
        xyz, rpy = (None if each == zero else each for each in (self.xyz, self.rpy))
        return Pose(xyz=xyz, rpy=rpy, relative_to=relative_to)


def root_of(model: Model) -> str | None:
    """The link that all else hangs from, or that `world` holds; None where there are several."""
    children = {joint.child for joint in model.joints if joint.parent != WORLD}
    roots = [link.name for link in model.links if link.name not in children and link.name != WORLD]
    return roots[0] if len(roots) == 1 else None


def join_urdf(model: Model, guest: Model, mount: Mount, sink: DiagnosticSink) -> Model:
    """A robot with another one attached; the same robot after an error, which has been reported."""
    guest = _without_place(without_world(guest))
    # A link of URDF hangs from one joint, so only the root of a robot can be attached to another
    # one.
    if any(joint.child == mount.held for joint in guest.joints):
        message = f"link {mount.held!r} of the attached robot hangs from another one; `reroot` makes it the root"
        sink.report(rules.UNKNOWN_NAME, message, guest.location, found=mount.held)
        return model
    if _clash(model, guest, mount, sink, (("link", "links"), ("joint", "joints"))):
        return model
    # Two robots may define a material of one name with different colors; readers take the first.
    guest = _own_materials(model, guest, mount.prefix)
    joint = Joint(
        name=mount.joint,
        type="fixed",
        parent=mount.to,
        child=mount.held,
        pose=mount.pose(mount.to),
        source=guest.source,
    )
    held = Pose(relative_to=mount.joint)
    links = (link.copy(pose=held) if link.name == mount.held else link for link in guest.links)
    known = {material.name for material in model.materials}
    return model.copy(
        materials=(*model.materials, *(each for each in guest.materials if each.name not in known)),
        links=(*model.links, *links),
        joints=(*model.joints, joint, *guest.joints),
        extensions=(*model.extensions, *guest.extensions),
        opaque=(*model.opaque, *_own_blocks(model.opaque, guest.opaque, mount.prefix)),
    )


def join_sdf(model: Model, guest: Model, mount: Mount, sink: DiagnosticSink) -> Model:
    """A model with another one's parts in it; the same model after an error, which has been reported."""
    guest = without_world(guest)
    if _clash(model, guest, mount, sink, (("", "links"), ("", "joints"), ("", "frames"), ("", "models"))):
        return model
    # The merge of an include does all of it: the pose of one frame of the guest, and the names of
    # its parts in the model.
    placed = Include(uri=guest.name, pose=mount.pose(mount.to), placement_frame=mount.held, source=guest.source)
    unnamed = guest.copy(name=mount.prefix.rstrip("_") or guest.name)
    merged = merge_into_model(model, placed, unnamed, sink, Transform())
    if merged is model:
        return model
    joint = Joint(name=mount.joint, type="fixed", parent=mount.to, child=mount.held, source=guest.source)
    return merged.copy(joints=(*merged.joints, joint))


def _without_place(guest: Model) -> Model:
    """A robot of URDF without what it has as a whole: where it stands, and what it was converted from."""
    extensions = (
        each if each.reference else each.copy(content=_other_than_pose(each.content)) for each in guest.extensions
    )
    kept = tuple(each for each in extensions if each.reference or each.content or each.opaque)
    return without_annotation(guest.copy(extensions=kept), FROM, OFFSET, POSE)


def _other_than_pose(content: tuple[Element, ...]) -> tuple[Element, ...]:
    return tuple(each for each in content if each.name != "pose")


def _clash(model: Model, guest: Model, mount: Mount, sink: DiagnosticSink, kinds: Iterable[tuple[str, str]]) -> bool:
    """Report names that both have; links and joints of URDF may share one."""
    taken: dict[tuple[str, str], Node] = {}
    for kind, field in kinds:
        taken.update({(kind, node.name): node for node in getattr(model, field)})
    mounts = [Joint(name=mount.joint, type="fixed", source=guest.source)]
    clash = False
    for kind, field in kinds:
        own = mounts if field == "joints" else []
        for node in (*getattr(guest, field), *own):
            other = taken.get((kind, node.name))
            if other is not None:
                message = f"both models have something called {node.name!r}"
                sink.report(
                    rules.NAME_CLASH, message, other.location, found=node.name, related=(node.location,),
                    help="give the attached model a prefix",
                )  # fmt: skip
                clash = True
    return clash


def _own_materials(model: Model, guest: Model, prefix: str) -> Model:
    """The guest with other names for materials that mean something else in the model."""
    theirs, mine = _materials(model), _materials(guest)
    names = {name: prefix + name for name in mine.keys() & theirs.keys() if mine[name] != theirs[name]}
    if not names:
        return guest
    return map_references(guest, lambda kind, name: names.get(name, name) if kind == "material" else name)


def _materials(model: Model) -> dict[str, tuple[object, ...]]:
    """What each name of a material stands for: the robot's own, or else the first visual's that has more."""
    inline = (visual.material for link in model.links for visual in link.visuals if visual.material)
    found: dict[str, tuple[object, ...]] = {}
    for material in (*model.materials, *inline):
        if material.name and (material.color or material.texture):
            found.setdefault(material.name, (material.color, material.texture))
    return found


def _own_blocks(there: tuple[Opaque, ...], more: tuple[Opaque, ...], prefix: str) -> list[Opaque]:
    """Transmissions, ros2_control and the like of the guest, each by a name of its own."""
    taken = {(part.element.name, part.element.get("name")) for part in there if part.element}
    made: list[Opaque] = []
    for part in more:
        element = part.element
        if element is None:  # attributes of the other robot say something of its file
            continue
        if (element.name, element.get("name")) in taken and element.get("name"):
            attributes = tuple((key, prefix + text if key == "name" else text) for key, text in element.attributes)
            made.append(part.copy(element=element.copy(attributes=attributes)))
        else:
            made.append(part)
    return made


def without_world(model: Model) -> Model:
    """The model without what fixes it to the world: in URDF a root link `world` that is nothing else, and the joint."""
    held = [joint for joint in model.joints if joint.parent == WORLD]
    if not held or any(joint.type != "fixed" for joint in held) or len(held) > 1:
        return model
    joints = tuple(joint for joint in model.joints if joint is not held[0])
    links = tuple(link for link in model.links if link.name != WORLD)
    return model.copy(joints=joints, links=links)
