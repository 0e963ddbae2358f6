"""What is known of a robot when its ROS 2 package is written."""

from collections.abc import Sequence
from dataclasses import dataclass

from twinform.compiler.packaging.order import PackageDetails
from twinform.compiler.packaging.ros2.controllers import Controller
from twinform.ir import Document, Model
from twinform.passes.plugins.bridge import Bridge

_FIXED = frozenset({"fixed", "floating", "planar"})
"""Joints that no joint state moves."""


@dataclass(frozen=True, slots=True, kw_only=True)
class PackageContents:
    """The robot as the URDF of a package has it, the name and details of the package, and what was found out for it.

    `started` are those of the controllers that Gazebo runs. `folders` are those of the files that come from elsewhere,
    and `files` those that lie beside `package.xml`.
    """

    package: str
    details: PackageDetails
    document: Document
    release: str
    controllers: Sequence[Controller] = ()
    started: Sequence[Controller] = ()
    bridges: Sequence[Bridge] = ()
    folders: Sequence[str] = ()
    files: Sequence[str] = ()

    @property
    def model(self) -> Model:
        """The robot."""
        return self.document.models[0]

    @property
    def controlled(self) -> bool:
        """Whether Gazebo runs controllers."""
        return bool(self.started)

    @property
    def moves(self) -> bool:
        """Whether it has joints that move."""
        return any(joint.type not in _FIXED for joint in self.model.joints)
