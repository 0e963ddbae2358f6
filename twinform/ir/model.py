"""Models: links, joints, frames, nested models, and the `<gazebo>` elements of URDF."""

from collections.abc import Mapping
from typing import Self, TypeVar

from twinform.diagnostics.did_you_mean import did_you_mean
from twinform.ir.element import Element
from twinform.ir.joint import Joint
from twinform.ir.link import Link
from twinform.ir.node import Node
from twinform.ir.pose import Frame, Pose
from twinform.ir.record import record
from twinform.ir.sensor import Plugin
from twinform.ir.visual import Material


@record
class GazeboExtension(Node):
    """A `<gazebo>` element: what URDF has no elements for and Gazebo reads.

    Attributes:
        reference: the link or joint that it is about; `None` for the model.
        content: the elements in it, in their order.
    """

    reference: str | None = None
    content: tuple[Element, ...] = ()


@record
class Include(Node):
    """Another file's model, put here by its URI.

    Attributes:
        uri: of the model, as it is written.
        name: of the model here; `None` for the one that its file gives it.
        pose: of the model, in the frame of the holder unless it names another; `None` for the one in its file.
        static: whether it never moves; `None` for what its file says.
        placement_frame: the frame of the model that `pose` places; `None` for the model frame.
        merge: whether its parts become parts of the holder, without a model of their own.
        plugins: that are added to it.
    """

    uri: str | None = None
    name: str | None = None
    pose: Pose | None = None
    static: bool | None = None
    placement_frame: str | None = None
    merge: bool | None = None
    plugins: tuple[Plugin, ...] = ()


@record
class Model(Node):
    """Links and joints that belong together: a robot or a thing.

    Attributes:
        name: unique in its holder.
        pose: of the model frame, in the frame of the world or model around it unless it names another.
        static: whether it never moves.
        self_collide: whether its links collide with each other.
        allow_auto_disable: whether a simulator may let it sleep when it rests.
        enable_wind: whether wind acts on its links.
        canonical_link: the link that the model frame is attached to; `None` for the first one.
        placement_frame: the frame that `pose` places; `None` for the model frame.
        materials: of URDF, which visuals name.
        links: in their order.
        joints: in their order.
        frames: the named frames, of SDF.
        models: the nested models, of SDF.
        includes: models of other files, of SDF.
        plugins: code that a simulator loads with it.
        extensions: the `<gazebo>` elements of URDF.
    """

    name: str
    pose: Pose | None = None
    static: bool | None = None
    self_collide: bool | None = None
    allow_auto_disable: bool | None = None
    enable_wind: bool | None = None
    canonical_link: str | None = None
    placement_frame: str | None = None
    materials: tuple[Material, ...] = ()
    links: tuple[Link, ...] = ()
    joints: tuple[Joint, ...] = ()
    frames: tuple[Frame, ...] = ()
    models: tuple[Self, ...] = ()
    includes: tuple[Include, ...] = ()
    plugins: tuple[Plugin, ...] = ()
    extensions: tuple[GazeboExtension, ...] = ()

    def link(self, name: str) -> Link:
        """The link of a name; of several, the first.

        Raises:
            KeyError: there is none; the message has the name that may be meant.
        """
        return look_up({each.name: each for each in reversed(self.links)}, name, "link")

    def joint(self, name: str) -> Joint:
        """The joint of a name; of several, the first.

        Raises:
            KeyError: there is none; the message has the name that may be meant.
        """
        return look_up({each.name: each for each in reversed(self.joints)}, name, "joint")

    def frame(self, name: str) -> Frame:
        """The named frame (`<frame>` of SDF) of a name; of several, the first.

        Raises:
            KeyError: there is none; the message has the name that may be meant.
        """
        return look_up({each.name: each for each in reversed(self.frames)}, name, "frame")


AnyPart = TypeVar("AnyPart")


def look_up(parts: Mapping[str, AnyPart], name: str, kind: str) -> AnyPart:
    """The part of a name.

    Raises:
        KeyError: there is none; the message has the name that may be meant.
    """
    if name in parts:
        return parts[name]
    help_ = did_you_mean(name, parts)
    raise KeyError(f"there is no {kind} {name!r}{f'; {help_}' if help_ else ''}")
