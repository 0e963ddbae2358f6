"""Changing the frame in which the poses of a link or joint are expressed, without moving anything."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol, TypeVar

from twinform.ir import Collision, Inertial, Joint, Light, Link, Pose, Sensor, Visual
from twinform.ir.frames import FrameGraph, Kind
from twinform.ir.transform import Transform
from twinform.passes.transforms.element_poses import ElementPoses

Posed = Inertial | Visual | Collision | Sensor | Light
AnyPosed = TypeVar("AnyPosed", Inertial, Visual, Collision, Sensor, Light)
Base = tuple[str, Kind]


class Write(Protocol):
    """Gives what has a pose with its place in the new frame, or as it is where nothing changes."""

    def __call__(self, holder: AnyPosed, tag: str, transform: Transform, /) -> AnyPosed:
        """The holder, whose element is called `tag`, by its place."""
        ...


@dataclass(frozen=True, slots=True)
class Rebasing:
    """One link or joint, and the frame that the poses in it are to be in.

    `elements` does for poses in parts without a typed form what `write` does for others.
    """

    graph: FrameGraph
    name: str
    kind: Kind
    base: Base
    elements: ElementPoses
    write: Write
    stays: Callable[[Posed], bool]
    """Whether what has a pose need not be looked at where the frame is the one that it was."""

    def link(self, link: Link) -> Link:
        """The link with all that is in it; its own pose is somebody else's."""
        # Most frames of links are on their joints already, and then nothing in the link has to be
        # looked at.
        still = self.graph.pose(link.name, self.base[0], base=self.base[1]).is_identity
        update: dict[str, object] = {
            "inertial": link.inertial and self._move(link.inertial, "inertial", still=still),
            "visuals": tuple(self._move(visual, "visual", still=still) for visual in link.visuals),
            "collisions": tuple(self._move(collision, "collision", still=still) for collision in link.collisions),
            "sensors": tuple(self._sensor(one, still=still) for one in link.sensors),
            "lights": tuple(self._move(light, "light", still=still) for light in link.lights),
            "opaque": self.elements.parts(link.opaque, still=still),
        }
        return link.copy(**update)

    def joint(self, joint: Joint) -> Joint:
        """The joint with its sensors."""
        moved = tuple(self._sensor(one, still=True) for one in joint.sensors)
        return joint.copy(sensors=moved) if moved else joint

    def _sensor(self, sensor: Sensor, *, still: bool) -> Sensor:
        return self.elements.sensor(self._move(sensor, "sensor", still=still), sensor.pose)

    def _move(self, holder: AnyPosed, tag: str, *, still: bool) -> AnyPosed:
        if still and self.stays(holder):
            return holder
        pose: Pose | None = holder.pose
        transform = self.graph.resolve(pose, self.name, self.base[0], kind=self.kind, base=self.base[1])
        return self.write(holder, tag, transform)
