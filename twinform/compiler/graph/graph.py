"""`Graph`: the links and joints of a document as nodes and edges, in clusters for worlds and models."""

from dataclasses import dataclass
from typing import Literal

from twinform.diagnostics import NOWHERE, Location

NodeKind = Literal["link", "frame", "world", "include", "missing"]
"""`include` is a model of another file that was not read, and `missing` a name that stands for nothing."""


@dataclass(frozen=True, slots=True)
class Cluster:
    """A world or model; `inside` is the id of the cluster around it."""

    id: str
    kind: Literal["world", "model"]
    name: str
    inside: str | None = None


@dataclass(frozen=True, slots=True)
class GraphNode:
    """What joints connect. `name` has the models around it, `label` has not."""

    id: str
    kind: NodeKind
    name: str
    label: str
    cluster: str | None = None
    where: Location = NOWHERE


@dataclass(frozen=True, slots=True)
class GraphJoint:
    """A joint between two nodes, by their ids; `details` are its limits, one text for each axis."""

    id: str
    name: str
    label: str
    type: str
    parent: str
    child: str
    details: tuple[str, ...] = ()
    cluster: str | None = None
    where: Location = NOWHERE


@dataclass(frozen=True, slots=True)
class Attachment:
    """A frame and the node that it is attached to."""

    frame: str
    to: str


@dataclass(frozen=True, slots=True)
class Follower:
    """A joint that follows another one, by their ids, and how."""

    joint: str
    leader: str
    detail: str = ""


@dataclass(frozen=True, slots=True)
class Graph:
    """All of a document. Ids are short words of letters and digits, unlike names."""

    title: str
    clusters: tuple[Cluster, ...] = ()
    nodes: tuple[GraphNode, ...] = ()
    joints: tuple[GraphJoint, ...] = ()
    attachments: tuple[Attachment, ...] = ()
    followers: tuple[Follower, ...] = ()

    def summary(self) -> str:
        """What is in it, in words."""
        kinds = [node.kind for node in self.nodes]
        counts = (
            (kinds.count("link"), "link"),
            (len(self.joints), "joint"),
            (kinds.count("frame"), "frame"),
            (kinds.count("include"), "include"),
            (kinds.count("missing"), "missing part"),
            (len(self.followers), "mimic"),
        )
        found = [f"{count} {word}{'' if count == 1 else 's'}" for count, word in counts if count]
        return ", ".join(found) or "no links"
