"""The rules of SDF: models in models, whose links, joints and frames share one scope of names."""

from collections.abc import Mapping

from twinform.diagnostics import DiagnosticSink, Severity, rules
from twinform.ir import Format
from twinform.ir.defaults import MOMENT
from twinform.ir.document import Document, World
from twinform.ir.frames import MODEL, FrameError, FrameGraph, base_of
from twinform.ir.joint import Joint
from twinform.ir.link import Link
from twinform.ir.model import Include, Model
from twinform.ir.pose import Pose
from twinform.ir.scopes import SCOPE, outer_models, outside_worlds, scoped_models
from twinform.ir.verify.verify_bodies import verify_inertial, verify_rotation, verify_shapes
from twinform.ir.verify.verify_joints import report_loops, verify_joint, verify_mimics
from twinform.ir.verify.verify_names import Kinds, report_names, report_reserved, report_scope, report_scoped_elements
from twinform.ir.verify.verify_references import (
    NamedCollisions,
    References,
    verify_grippers,
    verify_joint_sensors,
    verify_sensors,
)

# In these versions links and joints are no frames yet, and two with one name are only bad style.
_BEFORE_FRAMES = frozenset({"1.2", "1.3", "1.4", "1.5", "1.6"})
_BEFORE_SCOPES = _BEFORE_FRAMES | {"1.7"}
"""Versions in which a name may have `::` in it."""
_ALONE = frozenset({"model", "light"})


def verify_sdf(document: Document, sink: DiagnosticSink) -> None:
    """Report what is wrong with the worlds and models of an SDF document."""
    verifier = _Verifier(document.version, sink)
    verifier.file(document)
    for world in document.worlds:
        verifier.world(world)
    for model in outer_models(document):
        verifier.model_with_frames(model)


class _Verifier:
    """One verification of one document."""

    def __init__(self, version: str | None, sink: DiagnosticSink) -> None:
        self.sink = sink
        self.shared = Severity.WARNING if version in _BEFORE_FRAMES else Severity.ERROR
        self.frames = version not in _BEFORE_FRAMES
        self.scoped = version not in _BEFORE_SCOPES

    def world(self, world: World) -> None:
        before = len(self.sink.diagnostics)
        names = (("model", world.models), ("light", world.lights), ("frame", world.frames), ("joint", world.joints))
        kinds = (*names, ("include", world.includes))
        report_scope(names, self.shared, self.sink)
        self._reserved((*kinds, ("world", (world,))))
        self._references(world)
        for joint in world.joints:
            self._joint(joint)
        if self.frames and _names_frames(world):
            self._resolve(world, before)

    def file(self, document: Document) -> None:
        """Verify what stands at the top of the file."""
        report_names("world", document.worlds, self.sink)
        report_names("model", document.models, self.sink)
        self._reserved((("model", document.models), ("light", document.lights)))
        alone = outside_worlds(document)
        # the reader reports a second model or light where the version has one of them
        if len(alone) > 1 and not any(part.element and part.element.name in _ALONE for part in document.opaque):
            message = f"the file has {len(alone)} models, lights and actors outside of a world; readers take the first"
            where, first = alone[1].location, alone[0].location
            self.sink.report(rules.SEVERAL_AT_TOP, message, where, related=(first,), refused=True)
        for model in document.models:
            self._at_top(model)
        if self.scoped:
            report_scoped_elements(document, self.sink)

    def _at_top(self, model: Model) -> None:
        """Verify a model outside of any world, which has nothing around it to be relative to."""
        verify_rotation(model.pose, self.sink)
        if model.pose is not None and model.pose.relative_to:
            frame, where = model.pose.relative_to, model.pose.location.at("@relative_to")
            message = f"relative_to={frame!r} has no meaning for model {model.name!r}, which is not in a world"
            self.sink.report(rules.DANGLING_FRAME, message, where, found=frame, help="delete it")

    def model_with_frames(self, model: Model) -> None:
        before = len(self.sink.diagnostics)
        self.model(model)
        if self.frames:
            self._resolve(model, before)

    def model(self, model: Model) -> None:
        sink = self.sink
        kinds = (("link", model.links), ("joint", model.joints), ("frame", model.frames), ("model", model.models))
        report_scope(kinds, self.shared, sink)
        self._reserved((*kinds, ("include", model.includes)))
        references = self._references(model)
        collisions = NamedCollisions(model)
        for link in model.links:
            self._link(link, collisions)
        for joint in model.joints:
            self._joint(joint)
        report_loops(model.joints, sink, Severity.INFO)
        if not model.includes:
            verify_mimics(model.joints, sink)
        verify_joint_sensors(model, sink)
        verify_grippers(model, references.is_link, sink)
        if not (model.links or model.models or model.includes or model.static):
            sink.report(
                rules.EMPTY_MODEL, f"model {model.name!r} has no link", model.location, expected="<link>", refused=True
            )
        for nested in model.models:
            self.model(nested)

    def _joint(self, joint: Joint) -> None:
        verify_joint(joint, self.sink, every_axis=True)  # libsdformat refuses any of length zero
        if joint.type == "continuous":
            message = f"joint {joint.name!r} is continuous, which no physics engine of Gazebo supports"
            where = joint.location.at("@type")
            self.sink.report(
                rules.CONTINUOUS_IN_SDF, message, where, found="continuous", expected="revolute without limits"
            )
        if joint.child == "world":
            message = f"joint {joint.name!r} has the child 'world'"
            self.sink.report(rules.WORLD_CHILD, message, joint.location.at("child"))

    def _link(self, link: Link, collisions: NamedCollisions) -> None:
        every = (
            ("visual", link.visuals),
            ("collision", link.collisions),
            ("sensor", link.sensors),
            ("light", link.lights),
        )
        kinds = [(kind, nodes) for kind, nodes in every if nodes]
        for kind, nodes in kinds:
            report_names(kind, [node for node in nodes if node.name is not None], self.sink)
        self._reserved(kinds)
        if link.visuals and link.collisions:
            self._siblings(link)
        verify_inertial(link, MOMENT[Format.SDF], self.sink)
        verify_shapes(link, self.sink, geometry_is_required=False)
        if link.sensors:
            verify_sensors(link, collisions, self.sink)

    def _siblings(self, link: Link) -> None:
        """Report a visual and a collision with one name, which only `gz sdf --check` minds."""
        visuals = {visual.name: visual for visual in link.visuals if visual.name}
        for collision in link.collisions:
            visual = visuals.get(collision.name or "")
            # a geom of MJCF is both
            if visual is not None and (visual.source is None or visual.source != collision.source):
                message = f"collision {collision.name!r} has the name of a visual"
                related = (visual.location,)
                self.sink.report(
                    rules.SHARED_NAME, message, collision.location, related=related, severity=Severity.INFO
                )

    def _reserved(self, kinds: Kinds) -> None:
        report_reserved(kinds, self.shared, self.sink, scoped=self.scoped)

    def _references(self, holder: Model | World) -> References:
        references = References(holder, self.sink, one_scope=self.frames)
        references.verify()
        return references

    def _resolve(self, holder: Model | World, before: int) -> None:
        """Report frames that go round in a circle, where all names lead somewhere, and what they resolve to."""
        # Unknown names are reported at the attribute that has them; resolving frames would only say
        # it again in other words.
        if any(each.is_error for each in self.sink.diagnostics[before:]):
            return
        if isinstance(holder, Model) and has_plain_frames(holder):
            return
        seen: set[str] = set()
        try:
            graph = FrameGraph(holder)
            problems = list(graph.problems())
        except FrameError as error:
            graph, problems = None, [error]
        for problem in problems:
            # a name that leads nowhere is in an include, or was reported where it stands
            if problem.rule is rules.FRAME_CYCLE and problem.found not in seen:
                problem.report(self.sink)
                seen.add(problem.found)
        if graph is not None and not problems:
            self._verify_ends(holder, graph)
            for model in holder.models if isinstance(holder, Model) else ():
                for scope, nested in scoped_models(model, model.name + SCOPE):
                    # libsdformat does not look there, so it is no error until a format cannot express it
                    self._verify_ends(nested, graph, scope, None if self.sink.strict else Severity.WARNING)

    def _verify_ends(
        self, holder: Model | World, graph: FrameGraph, scope: str = "", severity: Severity | None = None
    ) -> None:
        """Report joints that connect a link to itself by way of a frame."""
        links = {link.name for link in holder.links} if isinstance(holder, Model) else set[str]()
        for joint in holder.joints:
            parent, child = joint.parent, joint.child
            if not parent or not child or parent == child or (parent in links and child in links):
                continue
            if not (graph.knows(scope + parent) and graph.knows(scope + child)):  # it is in an include
                continue
            body = graph.body(scope + parent)
            if body == graph.body(scope + child) and (body.removeprefix(scope) in links or "::" in body):
                message = f"joint {joint.name!r} connects {body!r} to itself: {parent!r} and {child!r} are both on it"
                self.sink.report(rules.SELF_JOINT, message, joint.location, found=body, severity=severity)


def _names_frames(world: World) -> bool:
    """Tell whether anything directly in the world is relative to something else."""
    placed: tuple[Model | Include, ...] = (*world.models, *world.includes)
    return bool(world.frames or world.joints) or any(_is_relative(each.pose) for each in placed)


def _is_relative(pose: Pose | None) -> bool:
    return pose is not None and bool(pose.relative_to)


_NOTHING = ""


def has_plain_frames(model: Model) -> bool:
    """Tell whether every pose and body leads to the model or a link of it, and every joint connects two links.

    False says nothing: names may be there twice or be those of other models, which only a `FrameGraph` can tell.
    """
    # A graph of all frames was built only to find circles, and nearly every model is a tree at
    # first sight.
    if model.models or model.includes or model.placement_frame:
        return False
    bases: dict[str, str] = {MODEL: _NOTHING}
    bodies: dict[str, str] = {MODEL: _NOTHING}
    for link in model.links:
        bases[link.name], bodies[link.name] = base_of(link.pose, MODEL), _NOTHING
    for joint in model.joints:
        child = joint.child or MODEL
        if bodies.get(child) is not _NOTHING or bodies.get(joint.parent or "") is not _NOTHING:
            return False
        bases[joint.name] = base_of(joint.pose, child)
    for frame in model.frames:
        holder = frame.attached_to or MODEL
        bases[frame.name], bodies[frame.name] = base_of(frame.pose, holder), holder
    count = 1 + len(model.links) + len(model.joints) + len(model.frames)
    return len(bases) == count and _lead_somewhere(bases) and _lead_somewhere(bodies)


def _lead_somewhere(edges: Mapping[str, str]) -> bool:
    """Tell whether no way ends at an unknown name or in a circle."""
    visited: dict[str, int] = {_NOTHING: -1}
    for number, start in enumerate(edges):
        name, steps = start, 0
        while name not in visited:
            visited[name], steps = number, steps + 1
            if name not in edges:
                return False
            name = edges[name]
        if steps and visited[name] == number:
            return False
    return True
