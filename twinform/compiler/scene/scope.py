"""The names of one model or world: where its frames are in the world, and what its parts are called in the scene."""

from dataclasses import dataclass, field

from twinform.ir import Joint, Pose
from twinform.ir.frames import MODEL, WORLD, FrameGraph, Kind
from twinform.ir.transform import Transform


@dataclass(frozen=True, slots=True)
class SceneScope:
    """The frames of a graph; `place` puts its root in the world, and `prefix` stands before the names of its parts."""

    graph: FrameGraph
    place: Transform = field(default_factory=Transform)
    prefix: str = ""

    def name(self, name: str) -> str:
        """What a link or joint is called in the scene."""
        return name if name in {WORLD, MODEL} else self.prefix + name

    def body(self, name: str | None, kind: Kind = "link") -> str:
        """The link that a frame moves with, by the name that it has here."""
        return self.graph.body(name or WORLD, kind=kind)

    def frame(self, name: str, kind: Kind = "frame") -> Transform:
        """Where a frame is in the world."""
        root = self.graph.root
        return self.place.compose(self.graph.pose(name, root.name or MODEL, kind=kind, base=root.kind))

    def pose_in_link(self, pose: Pose | None, link: str) -> Transform:
        """Where something of a link is in it."""
        return self.graph.resolve(pose, link, link)

    def pose_of_joint_part(self, pose: Pose | None, joint: Joint, link: str) -> Transform:
        """Where something of a joint is in the link that it moves with."""
        return self.graph.resolve(pose, joint.name, link, kind="joint")
