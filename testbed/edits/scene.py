"""The elements of a robot file that edits are drawn from: its links, joints and other parts."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

from lxml import etree

from testbed.edits.edit import is_ours
from twinform.schemas import XmlElement

PARTS = ("visual", "collision", "sensor", "material", "gazebo", "plugin", "frame", "inertial", "dynamics", "surface")
"""Parts that a person takes out, in either format; links and joints hang together and are apart."""
PARTS_OF_MJCF = ("geom", "site", "joint", "freejoint", "inertial", "camera", "light", "exclude", "connect", "weld")
MORE_PARTS = ("transmission", "ros2_control", "light", "safety_controller", "calibration", "mimic", "axis", "pose")
_MODEL = frozenset({"model", "robot"})


@dataclass(frozen=True)
class Scene:
    """The tree of a converted file, URDF, SDF or MJCF, whose bodies are its links."""

    root: XmlElement

    @property
    def is_urdf(self) -> bool:
        """Whether it is URDF."""
        return self.root.tag == "robot"

    @property
    def is_mjcf(self) -> bool:
        """Whether it is MJCF."""
        return self.root.tag == "mujoco"

    @cached_property
    def own(self) -> tuple[XmlElement, ...]:
        """All elements but the root that are none of ours, in the order of the file."""
        return tuple(each for each in self.root.iter(etree.Element) if each is not self.root and not is_ours(each))

    @cached_property
    def carried(self) -> tuple[XmlElement, ...]:
        """All elements of ours, and what is in them."""
        return tuple(each for each in self.root.iter(etree.Element) if is_ours(each))

    @cached_property
    def models(self) -> tuple[XmlElement, ...]:
        """The robot, or the models of SDF, nested ones too."""
        if self.is_urdf or self.is_mjcf:
            return (self.root,)
        return tuple(each for each in self.own if each.tag == "model")

    @cached_property
    def links(self) -> tuple[XmlElement, ...]:
        """All links."""
        return tuple(self._children("worldbody//body" if self.is_mjcf else "link"))

    @cached_property
    def joints(self) -> tuple[XmlElement, ...]:
        """All joints between links."""
        return tuple(self._children("worldbody//joint" if self.is_mjcf else "joint"))

    def parts(self, *tags: str) -> list[XmlElement]:
        """The elements with one of these tags, outside carriers."""
        return [each for each in self.own if each.tag in tags]

    def fresh(self, base: str) -> str:
        """A name that the file does not use."""
        used = {value for each in self.root.iter(etree.Element) for value in (*each.attrib.values(), each.text or "")}
        names = (f"{base}_{number}" for number in range(1, len(used) + 2))
        return next(name for name in names if name not in used)

    def _children(self, tag: str) -> Iterator[XmlElement]:
        for model in self.models:
            yield from model.iterfind(tag)


def name_of(element: XmlElement) -> str:
    """The name of a part; empty where it has none."""
    return element.get("name") or ""


def ends(joint: XmlElement) -> tuple[str, str]:
    """The names of the parent and the child of a joint, in either format."""
    return _end(joint, "parent"), _end(joint, "child")


def _end(joint: XmlElement, tag: str) -> str:
    found = joint.find(tag)
    if found is None:
        return ""
    return found.get("link") or (found.text or "").strip()
