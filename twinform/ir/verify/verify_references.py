"""Verifies references of SDF by name: whether what is named is there, and is one thing only."""

from collections.abc import Callable, Iterable, Iterator
from functools import cached_property, partial

from twinform.diagnostics import DiagnosticSink, Rule, Severity, did_you_mean, rules
from twinform.ir.document import World
from twinform.ir.element import Opaque
from twinform.ir.joint import Joint
from twinform.ir.link import Link
from twinform.ir.model import Include, Model
from twinform.ir.pose import Frame, Pose
from twinform.ir.record import Sourced
from twinform.ir.scopes import nested_includes, scoped_links
from twinform.ir.sensor import SENSOR_ELEMENTS, Light, Sensor
from twinform.ir.verify.verify_bodies import verify_rotation
from twinform.ir.verify.verify_names import VerifiedScope
from twinform.ir.visual import Collision, Visual

_Placed = Collision | Frame | Include | Joint | Light | Link | Model | Sensor | Visual

_NONE: frozenset[str] = frozenset()
MODEL = "__model__"
WORLD = "world"


class References:
    """Looks up the references in one model or world; `own` is the name of its own frame inside it.

    Where links and joints have a scope each, a reference means one of its own kind: nothing is ambiguous.
    """

    def __init__(self, holder: Model | World, sink: DiagnosticSink, *, one_scope: bool) -> None:
        self.one_scope = one_scope
        self.scope = VerifiedScope(holder)
        self.own = MODEL if isinstance(holder, Model) else WORLD
        self.sink = sink
        self._holder = holder
        self._moved = {joint.child for joint in holder.joints}
        self._inner_frames = _NONE

    def verify(self) -> None:
        """Report every reference to nothing, or to two things."""
        holder = self._holder
        if isinstance(holder, Model):
            self._model(holder)
        else:
            self._lights(holder.lights)
        for joint in holder.joints:
            self._joint(joint)
        for frame in holder.frames:
            self._frame(frame.attached_to, frame, "@attached_to")
            self._pose(frame)
        for inner in (*holder.models, *holder.includes):
            self._pose(inner)

    def is_link(self, name: str) -> bool:
        """Whether a name stands for a link, or for something in an include that was not read."""
        # A name that only the file of an unread include knows is taken for good, so that such an
        # include does not hide what is wrong beside it.
        return self.scope.find(name) in {"link", "unread", "twice"}

    def _model(self, model: Model) -> None:
        for link in model.links:
            self._link(link)
        if model.canonical_link and not self.is_link(model.canonical_link):
            message = f"the canonical link of model {model.name!r} is {model.canonical_link!r}, but it has no such link"
            where = model.location.at("@canonical_link")
            hint = did_you_mean(model.canonical_link, self.scope.names("link"))
            self.sink.report(rules.UNKNOWN_CANONICAL_LINK, message, where, found=model.canonical_link, help=hint)
        self._frame(model.placement_frame, model, "@placement_frame")

    def _link(self, link: Link) -> None:
        self._pose(link)
        if not self.one_scope:
            self._inner_frames = _frames_inside(link)
        for visual in link.visuals:
            self._pose(visual)
        for collision in link.collisions:
            self._pose(collision)
        for sensor in link.sensors:
            self._pose(sensor)
        self._lights(link.lights)
        self._inner_frames = _NONE

    def _lights(self, lights: Iterable[Light]) -> None:
        for light in lights:
            self._pose(light)

    def _joint(self, joint: Joint) -> None:
        self._pose(joint)
        for end, name in (("parent", joint.parent), ("child", joint.child)):
            if name is not None and (name != WORLD or self.own == WORLD):
                self._verify_end(joint, end, name)
        for axis in (joint.axis, joint.axis2):
            if axis is not None and axis.expressed_in:
                self._frame(axis.expressed_in, axis, "xyz/@expressed_in")
        reference = joint.gearbox_reference_body
        if reference and joint.type == "gearbox" and not self.is_link(reference):
            where = joint.location.at("gearbox_reference_body")
            message = f"joint {joint.name!r} has the reference body {reference!r}, but there is no such link"
            hint = did_you_mean(reference, self.scope.names("link"))
            self.sink.report(rules.DANGLING_LINK, message, where, found=reference, severity=Severity.WARNING, help=hint)

    def _verify_end(self, joint: Joint, end: str, name: str) -> None:
        if name == joint.name and self.scope.find(name) == "joint":
            message = f"joint {joint.name!r} has itself as its {end}"
            self.sink.report(rules.SELF_JOINT, message, joint.location.at(end), found=name)
        elif name != self.own:
            what = f"joint {joint.name!r} has the {end} {name!r}, but there is no such link or frame in the "
            message = what + ("model" if self.own == MODEL else "world")

            def hint() -> str | None:
                # nothing is the child of two joints
                taken = {*self._moved, joint.parent} if end == "child" else {joint.parent, joint.child}
                return did_you_mean(name, self.scope.names("link", "frame", "model"), but=taken)

            self._look_up(rules.DANGLING_LINK, message, (joint, end), name, hint)

    def _pose(self, placed: _Placed) -> None:
        pose = placed.pose
        if pose is None:
            return
        verify_rotation(pose, self.sink)
        where, step = (placed, "pose/") if pose.source is None else (pose, "")  # a pass may have made it
        if pose.relative_to:
            self._frame(pose.relative_to, where, f"{step}@relative_to")
        elif pose.opaque and not self.one_scope:
            name = _old_frame(pose)
            if name not in self._inner_frames:
                self._frame(name, where, f"{step}@frame")

    def _frame(self, name: str | None, node: Sourced, step: str) -> None:
        if name and name != self.own:
            own = node.name if isinstance(node, Frame | Link | Joint) else None

            def hint() -> str | None:
                return did_you_mean(name, self.scope.names(), but=(own,))

            self._look_up(rules.DANGLING_FRAME, f"there is no frame {name!r}", (node, step), name, hint)

    def _look_up(
        self, rule: Rule, message: str, part: tuple[Sourced, str], name: str, hint: Callable[[], str | None]
    ) -> None:
        """Report a name that means nothing, or two things.

        `part` is where it stands, whose path is dear and made only then.
        """
        found = self.scope.find(name)
        if found is not None and not (found == "twice" and self.one_scope):
            return
        node, step = part
        where = node.location.at(step)
        if found is None:
            self.sink.report(rule, message, where, found=name, help=hint)
        else:
            message = f"{name!r} is the name of two things, so this reference is ambiguous"
            self.sink.report(rules.AMBIGUOUS_FRAME, message, where, found=name)


def _old_frame(pose: Pose) -> str:
    """Return the frame of a pose before SDF 1.7, which `relative_to` has replaced."""
    return next((part.attribute[1] for part in pose.opaque if part.attribute and part.attribute[0] == "frame"), "")


def _frames_inside(link: Link) -> frozenset[str]:
    """Return the frames that only the inside of a link knows, as in SDF 1.5 and 1.6."""
    frames = [part.element for part in link.opaque if part.element and part.element.name == "frame"]
    return frozenset(frame.get("name") or "" for frame in frames)


_PARAMETERS = frozenset[str]().union(*SENSOR_ELEMENTS.values())
_DEFAULT = "__default__"
"""What SDF takes for the name of a collision that is not written."""


class NamedCollisions:
    """The collisions that contact sensors of a model can name; they are looked for when the first sensor names one."""

    def __init__(self, model: Model) -> None:
        self._model = model

    @cached_property
    def names(self) -> frozenset[str]:
        """The names of all collisions in the model and those nested in it."""
        return frozenset(one.name or "" for _, link in scoped_links(self._model) for one in link.collisions)

    @cached_property
    def are_all_known(self) -> bool:
        """Whether no include could have more of them."""
        return not any(nested_includes(self._model))


def verify_sensors(link: Link, collisions: NamedCollisions, sink: DiagnosticSink) -> None:
    """Report sensors of a link whose parameters are not those of their type."""
    for sensor in link.sensors:
        _verify_content(sensor, sink)
        if sensor.type == "force_torque":
            message = f"sensor {sensor.name!r} belongs in a joint, whose force it measures; it is on link {link.name!r}"
            sink.report(rules.MISPLACED_SENSOR, message, sensor.location, found="force_torque")
        if sensor.type == "contact":
            _verify_contact(sensor, collisions, sink)


def verify_joint_sensors(model: Model, sink: DiagnosticSink) -> None:
    """Report what is wrong with the content of sensors on joints."""
    for joint in model.joints:
        for sensor in joint.sensors:
            _verify_content(sensor, sink)


def _verify_content(sensor: Sensor, sink: DiagnosticSink) -> None:
    allowed = SENSOR_ELEMENTS.get(sensor.type or "")
    if allowed is None:
        return
    for part in sensor.opaque:
        name = part.element.name if part.element and not part.at else ""
        if name in _PARAMETERS and name not in allowed:
            message = f"sensor {sensor.name!r} is of the type {sensor.type!r} and has <{name}>"
            expected = " or ".join(f"<{one}>" for one in sorted(allowed))
            sink.report(rules.SENSOR_MISMATCH, message, part.location, found=f"<{name}>", expected=expected)


def _verify_contact(sensor: Sensor, collisions: NamedCollisions, sink: DiagnosticSink) -> None:
    for part, step, name in _texts(sensor.opaque, "contact", "collision"):
        own_name = name.rpartition("::")[2]
        if own_name not in collisions.names and name != _DEFAULT and collisions.are_all_known:
            message = f"contact sensor {sensor.name!r} names the collision {name!r}, which does not exist"
            hint = partial(did_you_mean, own_name, collisions.names)
            sink.report(rules.UNKNOWN_COLLISION, message, part.location.at(step), found=name, help=hint)


def verify_grippers(model: Model, is_link: Callable[[str], bool], sink: DiagnosticSink) -> None:
    """Report grippers whose links do not exist."""
    for word in ("gripper_link", "palm_link"):
        for part, step, name in _texts(model.opaque, "gripper", word):
            if not is_link(name):
                message = f"<{word}> of a gripper names {name!r}, but model {model.name!r} has no such link"
                hint = partial(did_you_mean, name, [link.name for link in model.links])
                sink.report(rules.UNKNOWN_GRIPPER_LINK, message, part.location.at(step), found=name, help=hint)


def _texts(parts: tuple[Opaque, ...], outer: str, inner: str) -> Iterator[tuple[Opaque, str, str]]:
    """The texts of the `inner` children of the parts that are an `outer` element, and the step to each."""
    for part in parts:
        if part.element and part.element.name == outer:
            found = [child.text or "" for child in part.element.find_all(inner)]
            for place, text in enumerate(found, 1):
                yield part, f"{inner}[{place}]" if len(found) > 1 else inner, text
