"""One scope for all names."""

from collections.abc import Callable, Collection
from typing import ClassVar, TypeVar

from twinform.diagnostics import Fate, Notes
from twinform.diagnostics.rules import to_sdf
from twinform.ir import Axis, Joint, Link, Model, Pose
from twinform.passes.legalise.model_pass import ModelPass
from twinform.passes.legalise.names import with_old_name

Named = TypeVar("Named", Link, Joint, Model)
_NO_NAME = "robot"
"""What a robot is called that has no name, which SDF asks for."""


class UniqueNames(ModelPass):
    """Give joints names that no link has, and links names that SDF does not keep for itself.

    Changes: 1. a joint with a link's name becomes `NAME_joint` (with a number if that is taken too), and mimics and
    poses follow; 2. a link called `world`, or with two underscores at both ends, becomes `NAME_link`, and joints and
    poses follow; 3. names lose the blanks around them, which libsdformat drops where it reads them; 4. a robot without
    a name is called `robot`.
    Never touches: names inside plugins, which only the plugins understand.
    Diagnostics: `renamed`. The old name is carried.
    """

    name: ClassVar[str] = "unique-names"
    carriers: bool = True

    def run_model(self, model: Model, notes: Notes) -> Model:
        """The model with one name for each thing."""
        if not model.name.strip():
            model = self._rename(model, _NO_NAME, notes)
        names = {link.name for link in model.links}
        taken = names | {joint.name for joint in model.joints}
        links = {name: free_name(_new(name, "link"), taken) for name in sorted(names) if _reserved(name)}
        clashes = [joint.name for joint in model.joints if joint.name in names or _reserved(joint.name)]
        joints = {name: free_name(_new(name, "joint", names), taken) for name in clashes}
        if not links and not joints:
            return model
        return model.model_copy(
            update={
                "links": tuple(self._link(link, links, joints, notes) for link in model.links),
                "joints": tuple(self._joint(joint, links, joints, notes) for joint in model.joints),
            }
        )

    def _link(self, link: Link, links: dict[str, str], joints: dict[str, str], notes: Notes) -> Link:
        link = link.model_copy(update={"pose": _renamed_pose(link.pose, lambda name: joints.get(name, name))})
        return self._rename(link, links[link.name], notes) if link.name in links else link

    def _joint(self, joint: Joint, links: dict[str, str], joints: dict[str, str], notes: Notes) -> Joint:
        def follow(name: str) -> str:
            return links.get(name, name)

        update: dict[str, object] = {
            "parent": follow(joint.parent or ""),
            "child": follow(joint.child or ""),
            "pose": _renamed_pose(joint.pose, follow),
        }
        if joint.gearbox_reference_body is not None:
            update["gearbox_reference_body"] = follow(joint.gearbox_reference_body)
        update |= {field: _followed(getattr(joint, field), joints) for field in ("axis", "axis2")}
        joint = joint.model_copy(update=update)
        return self._rename(joint, joints[joint.name], notes) if joint.name in joints else joint

    def _rename(self, node: Named, name: str, notes: Notes) -> Named:
        kind = type(node).__name__.lower()
        message = f"{kind} {node.name!r} is called {name!r} in SDF"
        notes.report(to_sdf.RENAMED, message, node.location, found=node.name)
        notes.account(Fate.CARRIED if self.carriers else Fate.DROPPED, to_sdf.RENAMED, message, node.location)
        if self.carriers:
            node = with_old_name(node, name)
        return node.model_copy(update={"name": name})


def _reserved(name: str) -> bool:
    return name == "world" or (name.startswith("__") and name.endswith("__")) or name != name.strip()


def _new(name: str, kind: str, links: Collection[str] = ()) -> str:
    """The name to take instead of one that is reserved, or that a link has."""
    bare = name.strip()
    return f"{bare.strip('_')}_{kind}" if bare == name or bare in links or _reserved(bare) else bare


def free_name(name: str, taken: set[str]) -> str:
    """The name, or the first numbered one that is free; it is taken from then on."""
    candidate, number = name, 1
    while candidate in taken:
        candidate, number = f"{name}_{number}", number + 1
    taken.add(candidate)
    return candidate


def _followed(axis: Axis | None, joints: dict[str, str]) -> Axis | None:
    """The axis with its mimic of a joint by that joint's new name."""
    mimic = axis.mimic if axis else None
    if axis is None or mimic is None or mimic.joint not in joints:
        return axis
    return axis.model_copy(update={"mimic": mimic.model_copy(update={"joint": joints[mimic.joint]})})


def _renamed_pose(pose: Pose | None, follow: Callable[[str], str]) -> Pose | None:
    if pose is None or pose.relative_to is None:
        return pose
    return pose.model_copy(update={"relative_to": follow(pose.relative_to)})
