"""Models: links, joints, frames and nested models."""

from typing import Self

from twinform.ir.extension import GazeboExtension
from twinform.ir.joint import Joint
from twinform.ir.link import Link
from twinform.ir.node import Node
from twinform.ir.plugin import Plugin
from twinform.ir.pose import Frame, Pose
from twinform.ir.visual import Material


class Include(Node):
    """Another file's model, put here by its URI."""

    uri: str | None = None
    name: str | None = None
    pose: Pose | None = None
    static: bool | None = None
    placement_frame: str | None = None
    merge: bool | None = None
    plugins: tuple[Plugin, ...] = ()


class Model(Node):
    """Links and joints that belong together; `pose` is in the frame of the world or model around it.

    `materials` and `extensions` are URDF's shared materials and `<gazebo>` elements.
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
