"""`Graph`: the links and joints of a document as nodes and edges, in clusters for worlds and models.

Names that stand for nothing are in it too, so that broken models can be drawn.
"""

import math
from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import field
from typing import Literal

from twinform.compiler.kinematics import range_of
from twinform.dataclass import dataclass
from twinform.diagnostics import NOWHERE, DiagnosticSink, Location
from twinform.diagnostics.reporters import printable
from twinform.diagnostics.wording import plural
from twinform.ir import Document, Format, Frame, Joint, Mimic, Model, World
from twinform.ir.defaults import multiplier
from twinform.ir.frames import MODEL, WORLD, FrameError, FrameGraph
from twinform.ir.motion import WITH_TWO_AXES, axes_of
from twinform.passes import PassError, Pipeline

NodeKind = Literal["link", "frame", "world", "include", "missing"]
"""`include` is a model of another file that was not read, and `missing` a name that stands for nothing."""
_LONGEST = 60
_BEGINNING = 40
_INDENT = "  "


@dataclass(frozen=True, slots=True)
class Cluster:
    """A world or model; `inside` is the id of the cluster around it."""

    id: str
    kind: Literal["world", "model"]
    name: str
    inside: str | None = None


@dataclass(frozen=True, slots=True)
class GraphNode:
    """What joints connect; `name` begins with the models around it, `label` does not."""

    id: str
    kind: NodeKind
    name: str
    label: str
    cluster: str | None = None
    where: Location = NOWHERE


@dataclass(frozen=True, slots=True)
class GraphJoint:
    """A joint between two nodes, which are given by id; `details` has the limits of each axis as text."""

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
    """A joint that mimics another one, both given by id, and how."""

    joint: str
    leader: str
    detail: str = ""


@dataclass(frozen=True, slots=True)
class Graph:
    """The graph of a document. Ids, unlike names, are short words of letters and digits."""

    title: str
    clusters: tuple[Cluster, ...] = ()
    nodes: tuple[GraphNode, ...] = ()
    joints: tuple[GraphJoint, ...] = ()
    attachments: tuple[Attachment, ...] = ()
    followers: tuple[Follower, ...] = ()

    def summary(self) -> str:
        """Return what is in the graph, in words."""
        kinds = [node.kind for node in self.nodes]
        counts = (
            (kinds.count("link"), "link"),
            (len(self.joints), "joint"),
            (kinds.count("frame"), "frame"),
            (kinds.count("include"), "include"),
            (kinds.count("missing"), "missing part"),
            (len(self.followers), "mimic"),
        )
        found = [plural(count, word) for count, word in counts if count]
        return ", ".join(found) or "no links"


def shortened(name: str) -> str:
    """Return a name without what a terminal or browser would obey, and without the middle if it is long."""
    if len(name) > _LONGEST:
        name = f"{name[:_BEGINNING]}\N{HORIZONTAL ELLIPSIS}{name[_BEGINNING + 1 - _LONGEST :]}"
    return printable(name)


def write_clusters(
    graph: Graph,
    node: Callable[[GraphNode], str],
    joint: Callable[[GraphJoint], str],
    begin: Callable[[Cluster], Sequence[str]],
    end: str,
) -> Iterator[str]:
    """Yield the line of each node and joint, between the lines that begin and end its cluster; a single model has none.

    Of the lines that begin a cluster, all but the first are indented like its content.
    """
    inside: dict[str | None, list[Cluster]] = defaultdict(list)
    for cluster in graph.clusters:
        inside[cluster.inside].append(cluster)
    parts: dict[str | None, list[str]] = defaultdict(list)
    for each in graph.nodes:
        parts[each.cluster].append(node(each))
    for each in graph.joints:
        parts[each.cluster].append(joint(each))
    top = inside[None]
    bare = top[0] if len(top) == 1 and top[0].kind == "model" else None
    yield from indent(parts[None])
    stack: list[tuple[Cluster | None, int]] = [(cluster, 1) for cluster in reversed(top)]
    while stack:
        one, depth = stack.pop()
        if one is None:
            yield from indent((end,), depth)
            continue
        if one is not bare:
            first, *more = begin(one)
            yield from indent((first,), depth)
            stack.append((None, depth))
            depth += 1
            yield from indent(more, depth)
        yield from indent(parts[one.id], depth)
        stack += [(each, depth) for each in reversed(inside[one.id])]


def indent(lines: Iterable[str], depth: int = 1) -> Iterator[str]:
    """Return the lines indented by this many steps."""
    return (_INDENT * depth + line for line in lines)


_WITH_LIMITS = frozenset({"revolute", "prismatic", "screw"}) | WITH_TWO_AXES


def build_graph(document: Document, *, frames: bool = False, mimics: bool = False) -> Graph:
    """Return the graph of a document; `frames` adds its named frames, and `mimics` which joints follow others."""
    document = _fold_extensions(document)
    work = _GraphBuilder(document.format, with_frames=frames, with_mimics=mimics)
    for world in document.worlds:
        work.add_holder(world)
    for model in document.models:
        work.add_holder(model)
    holders = [*document.worlds, *document.models]
    title = holders[0].name if len(holders) == 1 else f"{len(holders)} models"
    return Graph(
        title,
        tuple(work.clusters),
        tuple(work.nodes),
        tuple(work.joints),
        tuple(work.attachments),
        tuple(work.followers),
    )


def _fold_extensions(document: Document) -> Document:
    """Return the document with the joints of `<gazebo>` elements among the others, if these can be read."""
    if document.format is not Format.URDF:
        return document
    from twinform.passes.legalise.to_sdf.fold_gazebo import FoldGazebo  # noqa: PLC0415 - SDF does not need it

    try:
        return Pipeline((FoldGazebo.unchecked(carriers=False),)).run(document, DiagnosticSink())
    except PassError:
        return document


@dataclass(frozen=True, slots=True)
class _GraphPlace:
    """A model or world that is visited: the number of its frame graph, its prefix there, and its cluster."""

    graph: FrameGraph
    number: int
    prefix: str
    cluster: str


@dataclass(slots=True)
class _GraphBuilder:
    format: Format
    with_frames: bool
    with_mimics: bool
    clusters: list[Cluster] = field(default_factory=list[Cluster])
    nodes: list[GraphNode] = field(default_factory=list[GraphNode])
    joints: list[GraphJoint] = field(default_factory=list[GraphJoint])
    attachments: list[Attachment] = field(default_factory=list[Attachment])
    followers: list[Follower] = field(default_factory=list[Follower])
    _known: dict[tuple[int, str, str], str] = field(default_factory=dict[tuple[int, str, str], str])
    """Ids by the number of a graph, what sort of thing it is, and its name in the graph."""

    def add_holder(self, holder: World | Model) -> None:
        """Add a world, or a model outside of worlds, with everything nested in it."""
        top = _GraphPlace(FrameGraph(holder), len(self.clusters), "", f"c{len(self.clusters)}")
        kind = "world" if isinstance(holder, World) else "model"
        self.clusters.append(Cluster(top.cluster, kind, holder.name))
        places: list[tuple[World | Model, _GraphPlace]] = [(holder, top)]
        for one, place in places:  # grows while it is walked
            self._add_nodes(one, place)
            for inner in one.models:
                cluster = f"c{len(self.clusters)}"
                self.clusters.append(Cluster(cluster, "model", inner.name, place.cluster))
                places.append((inner, _GraphPlace(top.graph, top.number, f"{place.prefix}{inner.name}::", cluster)))
        for one, place in places:
            for joint in one.joints:
                self._add_joint(joint, place)
            if self.with_frames:
                self._add_attachments(one.frames, place)
        if self.with_mimics:
            for one, place in places:
                self._add_followers(one.joints, place)

    def _add_nodes(self, holder: World | Model, place: _GraphPlace) -> None:
        for link in holder.links if isinstance(holder, Model) else ():
            self._add("link", link.name, place, link.location)
        for include in holder.includes:
            name = include.name or (include.uri or "").rstrip("/").rpartition("/")[2] or "include"
            self._add("include", name, place, include.location)
        for frame in holder.frames if self.with_frames else ():
            self._add("frame", frame.name, place, frame.location)

    def _add(self, kind: NodeKind, label: str, place: _GraphPlace, where: Location = NOWHERE) -> str:
        """Add a node and return its id; of several nodes with one name, others refer to the first."""
        node = f"n{len(self.nodes)}"
        name = place.prefix + label
        # Ids are ours and names are only labels: keywords, `::` and blanks then need no rules in
        # any of the languages.
        self.nodes.append(GraphNode(node, kind, name, label, place.cluster, where))
        self._known.setdefault((place.number, kind, name), node)
        return node

    def _add_joint(self, joint: Joint, place: _GraphPlace) -> None:
        found = GraphJoint(
            f"j{len(self.joints)}",
            place.prefix + joint.name,
            joint.name,
            joint.type,
            self._find_end(joint.parent, place),
            self._find_end(joint.child, place),
            tuple(_describe_limits(joint, self.format)),
            place.cluster,
            joint.location,
        )
        self.joints.append(found)
        self._known.setdefault((place.number, "joint", found.name), found.id)

    def _find_end(self, name: str | None, place: _GraphPlace) -> str:
        """Return the node at an end of a joint: a frame if frames are shown, else the link that it moves with."""
        if not name:
            return self._add_once("missing", "(not written)", place, prefix="")
        scoped = place.prefix + name
        found = self._known.get((place.number, "link", scoped)) or self._known.get((place.number, "frame", scoped))
        if found:  # a link of URDF may be called `world`
            return found
        if name == WORLD:
            return self._add_once("world", name, place, prefix="")
        try:
            body = place.graph.body(scoped)
        except FrameError:
            # A broken tree is drawn as well: somebody whose joint names a link that is not there
            # needs just this picture.
            return self._find_include(scoped, place) or self._add_once("missing", name, place, prefix=place.prefix)
        if body in {WORLD, MODEL}:
            return self._add_once("world", WORLD, place, prefix="")
        return self._known.get((place.number, "link", body)) or self._add_once(
            "missing", name, place, prefix=place.prefix
        )

    def _find_include(self, scoped: str, place: _GraphPlace) -> str | None:
        """Return the include that a name leads into."""
        while "::" in scoped:
            scoped = scoped.rpartition("::")[0]
            # The file was not read, so the name may well be right.
            if found := self._known.get((place.number, "include", scoped)):
                return found
        return None

    def _add_once(self, kind: NodeKind, label: str, place: _GraphPlace, *, prefix: str) -> str:
        """Return the node of a name that something refers to; add it the first time."""
        found = self._known.get((place.number, kind, prefix + label))
        if found:
            return found
        top = f"c{place.number}"
        inside = place if prefix else _GraphPlace(place.graph, place.number, "", top)
        return self._add(kind, label, inside)

    def _add_attachments(self, frames: Iterable[Frame], place: _GraphPlace) -> None:
        for frame in frames:
            own = self._known[place.number, "frame", place.prefix + frame.name]
            holder = self._find_end(frame.attached_to or self._find_body(frame, place), place)
            if holder != own:
                self.attachments.append(Attachment(own, holder))

    def _find_body(self, frame: Frame, place: _GraphPlace) -> str | None:
        """Return the link that a frame without `attached_to` moves with, by its name in the model."""
        try:
            body = place.graph.body(place.prefix + frame.name, kind="frame")
        except FrameError:
            return None
        return WORLD if body in {WORLD, MODEL} else body.removeprefix(place.prefix)

    def _add_followers(self, joints: Iterable[Joint], place: _GraphPlace) -> None:
        for joint in joints:
            for axis in (joint.axis, joint.axis2):
                mimic = axis.mimic if axis else None
                if mimic is None or not mimic.joint:
                    continue
                own = self._known[place.number, "joint", place.prefix + joint.name]
                leader = self._known.get((place.number, "joint", place.prefix + mimic.joint))
                leader = leader or self._add_once("missing", mimic.joint, place, prefix=place.prefix)
                self.followers.append(Follower(own, leader, _describe_mimic(mimic)))


def _describe_limits(joint: Joint, format: Format) -> Iterator[str]:
    """Yield the range of each axis that has one."""
    unit = "m" if joint.type == "prismatic" else "rad"
    for axis in axes_of(joint) if joint.type in _WITH_LIMITS else ():
        lower, upper = range_of(joint, axis, format)
        if lower > -math.inf and upper < math.inf:
            yield f"{lower:.4g} to {upper:.4g} {unit}"
        elif lower > -math.inf:
            yield f"from {lower:.4g} {unit}"
        elif upper < math.inf:
            yield f"up to {upper:.4g} {unit}"


def _describe_mimic(mimic: Mimic) -> str:
    """Return how a joint follows another, where it is not one to one."""
    parts = ((multiplier(mimic), 1.0, "multiplier"), (mimic.offset, 0.0, "offset"), (mimic.reference, 0.0, "reference"))
    return ", ".join(f"{word} {value:.4g}" for value, usual, word in parts if value is not None and value != usual)
