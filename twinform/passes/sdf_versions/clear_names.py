"""Unique names for links, joints and frames, which share one scope since SDF 1.7."""

from collections.abc import Iterable
from typing import ClassVar, TypeVar

from twinform.dataclass import dataclass
from twinform.diagnostics import DiagnosticSink, Fate, rules
from twinform.ir import Document, Frame, Joint, Link, Model, ReferenceKind, World, map_references, rewrite
from twinform.passes.carriers.old_names import with_old_name
from twinform.passes.carriers.sdf_versions import VersionKeeper
from twinform.passes.sdf_versions.version_pass import VersionPass
from twinform.passes.shared.nodes import reserve_name

Named = TypeVar("Named", Link, Joint, Frame)
_RESERVED = "world"


class ClearNames(VersionPass):
    """Give links, joints and frames names that nothing else in the model has.

    Changes: 1. a link with the name of a nested model, a joint with that of a link, a frame with that of any of them
    gets `_link`, `_joint` or `_frame` behind it, as libsdformat has it; 2. so does one with a name that SDF keeps for
    itself. References follow; the name of a frame means a link that got another name, or else a frame.
    Never touches: names inside plugins and sensors, which only they understand.
    Diagnostics: `renamed`; in the ledger `renamed` as approximated.
    """

    name: ClassVar[str] = "clear-names"
    marks: bool = False
    """Whether each new name in a model is marked with the old one, for a target that gives it back."""

    def change(self, document: Document, keeper: VersionKeeper) -> Document:
        """The document with one name for each thing."""
        document = rewrite(document, Model, lambda model: _clear(model, keeper.sink, marks=self.marks))
        return rewrite(document, World, lambda world: _clear_world(world, keeper.sink))


@dataclass(frozen=True, slots=True)
class _NewNames:
    """One model's new names."""

    links: dict[str, str]
    joints: dict[str, str]
    frames: dict[str, str]
    sink: DiagnosticSink
    marks: bool = False

    def follow(self, kind: ReferenceKind, name: str) -> str:
        """The new name; a frame is a link that is called otherwise now, or else a frame."""
        if kind == "any":
            return self.links.get(name) or (name not in self.joints and self.frames.get(name)) or name
        names = {"link": self.links, "joint": self.joints}.get(kind, {})
        return name if name == _RESERVED else names.get(name, name)

    def rename(self, node: Named, names: dict[str, str]) -> Named:
        """The node with its new name."""
        if node.name not in names:
            return node
        if self.marks and not _is_reserved(node.name):
            return with_old_name(node, names[node.name]).copy(name=names[node.name])
        kind = type(node).__name__.lower()
        message = f"{kind} {node.name!r} is called {names[node.name]!r} where names are shared"
        self.sink.report(rules.RENAMED, message, node.location, found=node.name)
        self.sink.account(Fate.APPROXIMATED, rules.RENAMED, message, node.location)
        node = with_old_name(node, names[node.name]) if self.marks else node
        return node.copy(name=names[node.name])


def _clear(model: Model, sink: DiagnosticSink, *, marks: bool) -> Model:
    taken = {node.name for node in (*model.models, *model.links, *model.joints, *model.frames)}
    # The order (models, links, joints, frames) and the suffixes are those of libsdformat (Model.cc,
    # Load), so the names are the ones that Gazebo shows for the older file.
    owned = {nested.name for nested in model.models}
    links = _clashes(model.links, "link", owned, taken)
    owned |= {link.name for link in model.links}
    joints = _clashes(model.joints, "joint", owned, taken)
    owned |= {joint.name for joint in model.joints}
    frames = _clashes(model.frames, "frame", owned, taken)
    if not links and not joints and not frames:
        return model
    scope = _NewNames(links, joints, frames, sink, marks)
    followed = map_references(model, scope.follow)
    update = {
        "links": tuple(scope.rename(link, links) for link in followed.links),
        "joints": tuple(scope.rename(joint, joints) for joint in followed.joints),
        "frames": tuple(scope.rename(frame, frames) for frame in followed.frames),
    }
    return followed.copy(**update)


def _clear_world(world: World, sink: DiagnosticSink) -> World:
    taken = {node.name for node in (*world.models, *world.joints)}
    joints = _clashes(world.joints, "joint", {model.name for model in world.models}, taken)
    if not joints:
        return world
    scope = _NewNames({}, joints, {}, sink)
    return world.copy(joints=tuple(scope.rename(joint, joints) for joint in world.joints))


def _clashes(nodes: Iterable[Named], suffix: str, owned: set[str], taken: set[str]) -> dict[str, str]:
    """New names for the nodes that have the name of another kind, or a reserved one."""
    renamed: dict[str, str] = {}
    for node in nodes:
        if node.name in owned or _is_reserved(node.name):
            renamed[node.name] = reserve_name(f"{node.name.strip('_')}_{suffix}", taken)
    return renamed


def _is_reserved(name: str) -> bool:
    # `world` and names between double underscores, such as `__model__` (SDF 1.7, reserved names).
    return name == _RESERVED or (name.startswith("__") and name.endswith("__"))
