"""The frame graph: resolves poses of a model or world through the frames that they are relative to."""

from collections.abc import Iterable, Iterator
from typing import Literal

from twinform.dataclass import dataclass
from twinform.diagnostics import NOWHERE, DiagnosticSink, Location, Rule, Source, rules
from twinform.ir.document import World
from twinform.ir.joint import Joint
from twinform.ir.link import Link
from twinform.ir.model import Include, Model
from twinform.ir.pose import Frame, Pose
from twinform.ir.transform import Transform

Kind = Literal["link", "joint", "frame", "model", "world"]
MODEL = "__model__"
WORLD = "world"
_OWN_FRAME = f"::{MODEL}"

_IDENTITY = Transform()
# Frames at most this many steps apart are resolved along the path between them, which keeps the
# numbers of the file. Others go through the root, where each frame is resolved once.
_NEAR = 64


class FrameError(Exception):
    """A frame that cannot be resolved."""

    def __init__(self, rule: Rule, message: str, location: Location, found: str) -> None:
        super().__init__(message)
        self.rule = rule
        self.message = message
        self.location = location
        self.found = found

    def report(self, sink: DiagnosticSink) -> None:
        """Report it as a diagnostic."""
        sink.report(self.rule, self.message, self.location, found=self.found)


@dataclass(slots=True, eq=False)
class _Vertex:
    """A frame. `base` names the frame that its pose is in and `moves_with` the one that it is attached to.

    Both are names in `scope`; the rest is filled in when it is first asked for.
    """

    kind: Kind
    name: str
    scope: str
    pose: Pose | None
    base: str
    base_kind: Kind
    moves_with: str
    source: Source | None
    inside: str = ""
    placement: str | None = None
    is_around: bool = False
    """Whether `pose` and `placement` are those of the root in this frame, and not the other way round."""
    parent: "_Vertex | None" = None
    depth: int = -1
    local: Transform | None = None
    in_root: Transform | None = None
    body: str | None = None
    """Its name: the vertex would close a circle of references, which only the garbage collector breaks."""
    visiting: bool = False


class FrameGraph:
    """The frames of one model or world, by the names that stand in its own scope (`inner::link` for nested ones).

    Poses mean what they mean in SDF 1.12: a link's is relative to `__model__`, a joint's to its child, a frame's to
    what it is attached to, unless they name another frame. In URDF a link and a joint may share a name: the frame that
    a link's pose names is then the joint, and the other way round. Every question is answered in time linear in the
    frames that it is the first to touch; nothing recurses over them.
    """

    def __init__(self, holder: Model | World) -> None:
        self._named: dict[str, list[_Vertex]] = {}
        if isinstance(holder, World):
            self.root = self._add(_vertex("world", "", WORLD, holder.source))
            self._add_members(holder.frames, holder.joints, "", WORLD)
            self._add_inner(holder.models, holder.includes, "", WORLD)
        else:
            self.root = self._add(_vertex("model", "", MODEL, holder.source, moves_with=_canonical(holder)))
            self._add_links(holder.links, "")
            self._add_members(holder.frames, holder.joints, "", MODEL)
            self._add_inner(holder.models, holder.includes, "", MODEL)
            self._add_world_around(holder)

    def pose(self, name: str, relative_to: str, *, kind: Kind = "link", base: Kind = "link") -> Transform:
        """Where a frame is in another one. The kinds decide between frames that share a name.

        Raises:
            FrameError: a name is not known, or the frames go round in a circle.
        """
        return self._between(self._find(name, kind), self._find(relative_to, base))

    def place(self, name: str, *, kind: Kind = "link") -> Transform:
        """Where a frame is in the model or world itself, by way of all above it: of many frames, each is asked once.

        Raises:
            FrameError: a name is not known, or the frames go round in a circle.
        """
        vertex = self._find(name, kind)
        self._settle(vertex)
        return self._in_root(vertex)

    def resolve(
        self, pose: Pose | None, holder: str, relative_to: str, *, kind: Kind = "link", base: Kind = "link"
    ) -> Transform:
        """Where a pose is, which is in the frame of `holder` (of this kind) unless it names another.

        Raises:
            FrameError: a name is not known, or the frames go round in a circle.
        """
        if pose is not None and pose.relative_to:
            start = self._find(pose.relative_to, "joint", pose.source)
        else:
            start = self._find(holder, kind)
        return self._between(start, self._find(relative_to, base)).compose(Transform.from_pose(pose))

    def body(self, name: str, *, kind: Kind = "link", source: Source | None = None) -> str:
        """The link that a frame moves with; `world`, or `__model__` of a model without links, where there is none.

        Raises:
            FrameError: a name is not known, or the frames go round in a circle.
        """
        return self._body(self._find(name, kind, source))

    def problems(self) -> Iterator[FrameError]:
        """Every frame that cannot be resolved, or that moves with nothing."""
        for vertices in list(self._named.values()):
            for vertex in vertices:
                try:
                    self._settle(vertex)
                    self._body(vertex)
                except FrameError as error:
                    yield error

    def knows(self, name: str) -> bool:
        """Whether a name stands for a frame."""
        return bool(self._vertices(name))

    def _add_links(self, links: Iterable[Link], scope: str) -> None:
        for link in links:
            base = base_of(link.pose, MODEL)
            self._add(_Vertex("link", scope + link.name, scope, link.pose, base, "joint", "", link.source))

    def _add_members(self, frames: Iterable[Frame], joints: Iterable[Joint], scope: str, around: str) -> None:
        for joint in joints:
            child = joint.child or around
            base = base_of(joint.pose, child)
            self._add(_Vertex("joint", scope + joint.name, scope, joint.pose, base, "link", child, joint.source))
        for frame in frames:
            holder = frame.attached_to or around
            base = base_of(frame.pose, holder)
            self._add(_Vertex("frame", scope + frame.name, scope, frame.pose, base, "link", holder, frame.source))

    def _add_inner(self, models: Iterable[Model], includes: Iterable[Include], scope: str, around: str) -> None:
        """Nested models, from the outside in; an include that was not expanded has at least a place."""
        for include in includes:
            if include.name is not None and include.placement_frame is None:
                base = base_of(include.pose, around)
                name = scope + include.name
                self._add(_Vertex("model", name, scope, include.pose, base, "link", around, include.source))
        stack = [(model, scope, around) for model in models]
        while stack:
            model, scope, around = stack.pop()
            inside = f"{scope}{model.name}::"
            base, link = base_of(model.pose, around), _canonical(model)
            body = f"{model.name}::{link}" if link else ""
            vertex = _Vertex("model", scope + model.name, scope, model.pose, base, "link", body, model.source, inside)
            vertex.placement = model.placement_frame
            self._add(vertex)
            self._add_links(model.links, inside)
            self._add_members(model.frames, model.joints, inside, MODEL)
            self._add_inner((), model.includes, inside, MODEL)
            stack.extend((nested, inside, MODEL) for nested in model.models)

    def _add_world_around(self, model: Model) -> None:
        """The world of a model that is looked at alone is one more frame in it: nothing else depends on its pose."""
        world = self._add(_Vertex("world", WORLD, "", model.pose, "", "model", "", model.source))
        world.parent, world.depth = self.root, 1
        world.placement, world.is_around = model.placement_frame, True

    def _add(self, vertex: _Vertex) -> _Vertex:
        self._named.setdefault(vertex.name, []).append(vertex)
        return vertex

    def _find(self, name: str, kind: Kind, source: Source | None = None, scope: str = "") -> _Vertex:
        found = self._vertices(name if name == WORLD else scope + name)
        if not found:
            named_in = source or self.root.source
            where = named_in.location if named_in else NOWHERE
            raise FrameError(rules.DANGLING_FRAME, f"there is no frame {scope + name!r}", where, name)
        return found[0] if len(found) == 1 else next((vertex for vertex in found if vertex.kind == kind), found[0])

    def _vertices(self, name: str) -> list[_Vertex]:
        """What has a name; where models were flattened, `inner` stands for `inner::__model__` too."""
        return self._named.get(name) or self._named.get(name.removesuffix(_OWN_FRAME), [])

    def _parent(self, vertex: _Vertex) -> _Vertex:
        if vertex.parent is None:
            vertex.parent = self._find(vertex.base, vertex.base_kind, vertex.source, vertex.scope)
        return vertex.parent

    def _settle(self, vertex: _Vertex) -> None:
        """Give the vertex and all above it their depth."""
        path: list[_Vertex] = []
        self.root.depth = 0
        try:
            while vertex.depth < 0:
                if vertex.visiting:
                    raise _circle(path[path.index(vertex) :], _RELATIVE)
                vertex.visiting = True
                path.append(vertex)
                vertex = self._parent(vertex)
        finally:
            for each in path:
                each.visiting = False
        for each in reversed(path):
            each.depth = vertex.depth + 1
            vertex = each

    def _local(self, vertex: _Vertex) -> Transform:
        """The vertex in its parent."""
        if vertex.local is None:
            pose = Transform.from_pose(vertex.pose)
            # `placement_frame`: the pose is that of this frame and not of the model frame.
            pose = pose.compose(self._placement(vertex).inverse()) if vertex.placement else pose
            vertex.local = pose.inverse() if vertex.is_around else pose
        return vertex.local

    def _placement(self, vertex: _Vertex) -> Transform:
        """The frame that a model's pose is about, in that model."""
        if vertex.visiting:
            raise _circle([vertex], "is placed by")
        vertex.visiting = True
        try:
            placed = self._find(vertex.placement or MODEL, "frame", vertex.source, vertex.inside)
            return self._between(placed, self.root if vertex.is_around else vertex)
        finally:
            vertex.visiting = False

    def _between(self, start: _Vertex, base: _Vertex) -> Transform:
        if start is base:
            return _IDENTITY
        self._settle(start)
        # The frame's own pose is given back as it was written, with its notation.
        if start.parent is base:
            return self._local(start).compose(_IDENTITY)
        self._settle(base)
        if base.parent is start:  # as a link whose joint is posed in its parent
            return self._local(base).inverse().compose(_IDENTITY)
        in_common, base_in_common = _IDENTITY, _IDENTITY
        first, second = start, base
        for _ in range(_NEAR):
            if first is second:
                return base_in_common.inverse().compose(in_common)
            if first.depth >= second.depth:
                in_common, first = self._local(first).compose(in_common), self._parent(first)
            else:
                base_in_common, second = self._local(second).compose(base_in_common), self._parent(second)
        return self._in_root(base).inverse().compose(self._in_root(start))

    def _in_root(self, vertex: _Vertex) -> Transform:
        path: list[_Vertex] = []
        self.root.in_root = _IDENTITY
        while vertex.in_root is None:
            path.append(vertex)
            vertex = self._parent(vertex)
        transform = vertex.in_root
        for each in reversed(path):
            transform = each.in_root = transform.compose(self._local(each))
        return transform

    def _body(self, vertex: _Vertex) -> str:
        path: list[_Vertex] = []
        try:
            while vertex.body is None and vertex.moves_with:
                if vertex.visiting:
                    raise _circle(path[path.index(vertex) :], "is attached to")
                vertex.visiting = True
                path.append(vertex)
                vertex = self._find(vertex.moves_with, "link", vertex.source, vertex.scope)
        finally:
            for each in path:
                each.visiting = False
        body = vertex.name if vertex.body is None else vertex.body
        for each in path:
            each.body = body
        return body


def _vertex(kind: Kind, scope: str, name: str, source: Source | None, moves_with: str = "") -> _Vertex:
    return _Vertex(kind, name, scope, None, "", "model", moves_with, source)


def base_of(pose: Pose | None, default: str) -> str:
    """The frame that a pose is in; `default` where it names none."""
    return pose.relative_to if pose is not None and pose.relative_to else default


def _canonical(model: Model) -> str:
    """The link that a model's own frame moves with, as a name in the model; empty where it has none."""
    if model.canonical_link:
        return model.canonical_link
    prefix = ""
    while not model.links and model.models:
        model = model.models[0]
        prefix += f"{model.name}::"
        if model.canonical_link:
            return prefix + model.canonical_link
    return prefix + model.links[0].name if model.links else ""


_RELATIVE = "is given relative to"


def _circle(path: list[_Vertex], relation: str) -> FrameError:
    """The error for a circle of frames, at the first attribute in the file that makes it one."""
    places = [_place(vertex, relation) for vertex in path]
    order = [
        (not place.path.rpartition("/")[2].startswith("@"), not place.line, place.line, place.path) for place in places
    ]
    first = order.index(min(order))
    turned = path[first:] + path[:first]
    names = [f"{vertex.kind} {vertex.name!r}" for vertex in turned[:6]]
    names += ["..."] if len(path) > len(names) else [names[0]]
    message = f"the poses go round: {' -> '.join(names)}" if relation == _RELATIVE else f" {relation} ".join(names)
    return FrameError(rules.FRAME_CYCLE, message, places[first], turned[0].name)


def _place(vertex: _Vertex, relation: str) -> Location:
    """Where the vertex that something is relative or attached to is named; its own place, if none is."""
    if relation == _RELATIVE and vertex.pose and vertex.pose.source:
        return vertex.pose.location.at("@relative_to") if vertex.pose.relative_to else vertex.pose.location
    where = vertex.source.location if vertex.source else NOWHERE
    return where.at("@attached_to") if vertex.kind == "frame" and relation == "is attached to" else where
