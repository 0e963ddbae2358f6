"""What all writers of MJCF share in one conversion: frames, the tree of links, names in use, assets, and side lists.

`MjcfContext` is made once for a model or world. Writers of parts take it and a node, and return elements; what belongs
into another section of the file, such as an equality or a sensor, they append to the lists of the context.
"""

from collections import defaultdict
from collections.abc import Collection, Mapping
from dataclasses import field
from functools import cached_property
from typing import NamedTuple

from twinform.dataclass import dataclass
from twinform.diagnostics import DiagnosticSink, Fate, Location, Rule, rules
from twinform.ir import Document, Element, Frame, Joint, Link, Model, Node, Pose, World, replace_fields
from twinform.ir.frames import WORLD, Kind
from twinform.ir.kinematic_tree import JointBetween, KinematicTree
from twinform.ir.record import Sourced
from twinform.ir.scopes import SCOPE, scope_in, scoped_models
from twinform.ir.transform import Transform
from twinform.passes.carriers.annotations import MADE_NAME, find_annotation
from twinform.passes.carriers.carriers import ROOT, Keeper
from twinform.passes.carriers.old_names import source_name
from twinform.passes.framework.assets import NO_ASSETS, Assets
from twinform.passes.legalise.to_mjcf.contact_plan import ContactPlan
from twinform.passes.legalise.to_mjcf.friction import Friction, friction_priorities
from twinform.passes.legalise.to_mjcf.kept_mjcf import asset_name, kept_elements
from twinform.passes.legalise.to_mjcf.mesh_colors import Rgba, Several
from twinform.passes.legalise.to_mjcf.rotors import Rotor, rotors_of
from twinform.passes.legalise.to_sdf.joint_types import FLOATING
from twinform.passes.shared.replaced_shapes import ShapeReplacer

_RESERVED = {"body": frozenset({"world"})}
"""Names that MuJoCo gives itself, by kind."""
_CONTENTS = ("file", "vertex", "elevation", "builtin", "plugin")
"""The attributes of assets of which one says what it is."""
_OF_SHAPES = frozenset({"mesh", "hfield"})


class Body(NamedTuple):
    """A link that is about to be written: its name with the models around it, and the prefix of its scope.

    `written` is the name that the body has in MJCF, and `moves` whether anything can move it.
    """

    name: str
    scope: str
    link: Link
    written: str
    moves: bool


class KeptSensor(NamedTuple):
    """How a sensor with kept readings is read: its name, and whether it tells of the same contacts."""

    name: str
    has_same_contacts: bool


class ScopedFrame(NamedTuple):
    """A named frame, and its name in the outermost scope."""

    name: str
    frame: Frame


@dataclass(slots=False)
class MjcfContext:
    """The state of one conversion to MJCF.

    Attributes:
        document: what is converted, in the terms of SDF 1.12.
        holder: the model or world of it that is written.
        sink: for findings and the ledger.
        keeper: for what MJCF cannot say: carried, or dropped where no carriers are asked for.
        source_version: the version of SDF that the source had; None for URDF.
        mixed: whether the source has syntax of newer versions of SDF.
        version_before: the version of SDF that a URDF was in before, which is back in terms of the newest one.
        assets: leads to the files that the document names.
        replacer: makes meshes that stand for shapes which MJCF lacks.
        names: the names in use, by kind (`body`, `joint`, `geom`, `site`, `mesh`, ...): each kind has its own.
        numbers: how far the numbers behind a name have come, by kind and name.
        written_joints: for each joint, by its scoped name, the names of the MJCF joints that stand for it: none for one
            that is fixed.
        written_slides: the names of the other MJCF joints that stand for screws.
        efforts: how hard joints of MJCF that limit no forces may be pushed by all their actuators, by their names.
        written_sites: the names of the sites of frames, by the scoped names of these.
        written_geoms: for each visual or collision, by its identity, the name of its geom.
        unnamed: kinds and names that parts have here alone, since they have none in MJCF.
        wishes: what these names were made of, and the names in SDF, by their kinds and names.
        former_names: the names that parts have in SDF, by their kinds and the scoped names that they had before.
        left: nodes whose untyped elements MJCF says in part, by identity, each with what MJCF leaves of it.
        kept_readings: the readings that sensors keep, each with the prefix of the names in it.
        kept_sensors: what is read of sensors with such readings, by the identities of their sources.
        mocap: the scoped names of the links whose bodies only a program moves.
        files: `asset` elements by what they are made of, so that equal ones are shared.
        colors_of_files: the colors that mesh files give themselves, by their URIs.
        sections: what stands outside of `worldbody`, by the name of the section, in the order in which it was added.
    """

    document: Document
    holder: Model | World
    sink: DiagnosticSink
    keeper: Keeper
    replacer: ShapeReplacer
    assets: Assets = NO_ASSETS
    source_version: str | None = None
    mixed: bool = False
    version_before: str | None = None
    numbers: dict[tuple[str, str], int] = field(default_factory=dict[tuple[str, str], int])
    names: dict[str, set[str]] = field(default_factory=dict[str, set[str]])
    written_bodies: dict[str, str] = field(default_factory=dict[str, str])
    written_joints: dict[str, tuple[str, ...]] = field(default_factory=dict[str, tuple[str, ...]])
    written_slides: dict[str, str] = field(default_factory=dict[str, str])
    efforts: dict[str, float] = field(default_factory=dict[str, float])
    written_sites: dict[str, str] = field(default_factory=dict[str, str])
    written_geoms: dict[int, str] = field(default_factory=dict[int, str])
    unnamed: set[tuple[str, str]] = field(default_factory=set[tuple[str, str]])
    wishes: dict[tuple[str, str], tuple[str, str]] = field(default_factory=dict[tuple[str, str], tuple[str, str]])
    former_names: dict[tuple[str, str], str] = field(default_factory=dict[tuple[str, str], str])
    left: dict[int, tuple[Node, Node]] = field(default_factory=dict[int, tuple[Node, Node]])
    kept_readings: list[tuple[str, Element]] = field(default_factory=list[tuple[str, Element]])
    kept_sensors: dict[int, KeptSensor] = field(default_factory=dict[int, KeptSensor])
    mocap: set[str] = field(default_factory=set[str])
    files: dict[object, str | None] = field(default_factory=dict[object, str | None])
    colors_of_files: dict[str, Rgba | Several | None] = field(default_factory=dict[str, Rgba | Several | None])
    sections: dict[str, list[Element]] = field(default_factory=lambda: defaultdict(list))

    @property
    def version_read(self) -> str | None:
        """The version of SDF that was read."""
        return self.source_version or self.version_before or self.document.version

    @cached_property
    def tree(self) -> KinematicTree:
        """The links and joints, with scoped names.

        Raises:
            FrameError: a frame is not known, or frames go round in a circle.
        """
        return KinematicTree(without_gearboxes(self.holder))

    @cached_property
    def static_links(self) -> frozenset[str]:
        """The scoped names of the links of static models, and of those nested in them.

        A URDF of MJCF has a static model because nothing in it moves: a joint that was added since counts. In SDF
        nothing of a static model moves, whatever its joints are.
        """
        static = tuple(scope for scope, each in self.models if each.static)
        if not static:
            return frozenset()
        found = (name for name in self.tree.links if name.startswith(static))
        is_urdf = self.source_version is None
        return frozenset(name for name in found if not (is_urdf and self.is_of_mjcf and self._is_moved(name)))

    def _is_moved(self, link: str) -> bool:
        """Whether a joint that moves is anywhere between a link and the root of its tree, or the root was set free."""
        above = self.tree.joint_above(link)
        while above is not None and above.joint.type == "fixed" and above.parent in self.tree.links:
            link = above.parent
            above = self.tree.joint_above(link)
        if above is None:  # SDF has no joint there
            return find_annotation(self.tree.links[link], FLOATING) is not None
        return above.joint.type != "fixed"

    @cached_property
    def closing(self) -> tuple[JointBetween, ...]:
        """The joints that are constraints: those of loops, and those that hang a static link from one that moves."""
        static = self.static_links
        above = [self.tree.joint_above(name) for name in self.tree.links if name in static]
        hanging = [each for each in above if each and each.parent in self.tree.links and each.parent not in static]
        return (*self.tree.closing, *hanging)

    @cached_property
    def models(self) -> tuple[tuple[str, Model], ...]:
        """All models, from the outside in, with the prefix of the names of their parts."""
        holder = self.holder
        tops = [("", holder)] if isinstance(holder, Model) else [(each.name + SCOPE, each) for each in holder.models]
        return tuple(found for scope, model in tops for found in scoped_models(model, scope))

    def scope_of(self, name: str) -> str:
        """The prefix of a scoped name: `arm::` of `arm::hand`."""
        return scope_in(name, self._scopes)

    @cached_property
    def _scopes(self) -> frozenset[str]:
        return frozenset(scope for scope, _ in self.models)

    @cached_property
    def has_visuals(self) -> bool:
        """Whether any link has a visual."""
        return any(link.visuals for link in self.tree.links.values())

    @cached_property
    def is_of_mjcf(self) -> bool:
        """Whether the document was read of MJCF, so that what SDF leaves to its defaults stays as MJCF has it."""
        holders = (self.holder, *(each for _, each in self.models))
        return any(each.name == ROOT for holder in holders for each in kept_elements(holder))

    @cached_property
    def _kept_assets(self) -> Mapping[tuple[str, str], Element]:
        holders = (self.holder, *(each for _, each in self.models))
        sections = (each for holder in holders for each in kept_elements(holder) if each.name == "asset")
        return {(each.name, asset_name(each)): each for section in sections for each in section.children}

    def kept_asset(self, kind: str, name: str) -> Element | None:
        """What is kept of an asset that was read of MJCF."""
        return self._kept_assets.get((kind, name))

    def kept_names(self, kind: str) -> frozenset[str]:
        """The names of assets that are kept beside those which are written for shapes.

        What is kept of the asset of a shape has its name where the shape says that name, or else that of its file.
        """
        has_own_name = self.is_of_mjcf and kind in _OF_SHAPES
        assets = ((name, each) for (of, name), each in self._kept_assets.items() if of == kind)
        return frozenset(name for name, each in assets if has_own_name or any(map(each.get, _CONTENTS)))

    @cached_property
    def colors(self) -> Mapping[str, str]:
        """The colors of the materials that were read of MJCF and are kept, by their names."""
        return {name: each.get("rgba") or "" for (kind, name), each in self._kept_assets.items() if kind == "material"}

    @cached_property
    def materials(self) -> frozenset[str]:
        """The names of the materials that are kept, or that visuals were read with, whose looks make them again."""
        geoms = (each for link in self.tree.links.values() for shape in link.visuals for each in kept_elements(shape))
        twins = (
            each
            for link in self.tree.links.values()
            for shape in link.collisions
            if self.is_of_mjcf and any(visual.name == shape.name for visual in link.visuals)
            for each in kept_elements(shape)
        )
        return frozenset({*self.colors, *(each.get("material") or "" for each in (*geoms, *twins))})

    @cached_property
    def contacts(self) -> ContactPlan:
        """Which links touch.

        Raises:
            FrameError: an end of a joint is not known, or frames go round in a circle.
        """
        return ContactPlan(self.holder, self.tree, self.static_links, is_of_mjcf=self.is_of_mjcf)

    @cached_property
    def rotors(self) -> Mapping[str, Rotor]:
        """The rotors of motors, by the scoped names of their joints."""
        return {scope + name: each for scope, model in self.models for name, each in rotors_of(model).items()}

    @cached_property
    def friction_priorities(self) -> Mapping[Friction, int]:
        """The priority of geoms by their friction."""
        return friction_priorities(each for link in self.tree.links.values() for each in link.collisions)

    @cached_property
    def frames_by_link(self) -> Mapping[str, list[ScopedFrame]]:
        """The named frames by the links that they move with, or `world`.

        Raises:
            FrameError: a frame is not known, or frames go round in a circle.
        """
        found: dict[str, list[ScopedFrame]] = defaultdict(list)
        frames = [("", each) for each in self.holder.frames] if isinstance(self.holder, World) else []
        for scope, frame in (*frames, *((scope, each) for scope, model in self.models for each in model.frames)):
            name = scope + frame.name
            body = self.tree.frames.body(name, kind="frame")
            # A frame of a model without links stands still.
            found[body if body in self.tree.links else WORLD].append(ScopedFrame(name, frame))
            # before sensors are given theirs, because others refer to a frame by its name
            self.name("site", name, frame.location)
        return found

    def add(self, section: str, element: Element) -> None:
        """Add an element to a section beside `worldbody`, such as `equality` or `sensor`."""
        self.sections[section].append(element)

    def leave(self, node: Node, left: Node) -> None:
        """Note what MJCF leaves of a node, whose fields and untyped elements it says in part."""
        self.left[id(node)] = (node, left)  # the node too, which keeps its identity from being used again

    def wish(self, kind: str, scope: str, own: str) -> str:
        """The name that a part in a scope should have in MJCF: its own, with the names of the models around it.

        What was read of one file of MJCF has its own names again, but for what is in nested models, which MJCF lacks;
        and so has what was put into a model of a made name.
        """
        if scope in self._made_scopes and own not in self.names.get(kind, ()):
            return own
        in_model = scope.partition(SCOPE)[2] if isinstance(self.holder, World) else scope
        wanted = in_model + own
        return wanted if self.is_of_mjcf and wanted not in self.names.get(kind, ()) else scope + own

    def old_name(self, kind: str, scope: str, part: Link | Joint | Frame) -> str:
        """The name that a part of a scope had where SDF could not have it; its own where it would not come back so.

        What was read of MJCF was called otherwise because another part has its name, or because SDF refuses that.
        """
        old = source_name(part)
        if old == part.name or not self.is_of_mjcf:
            return old
        if isinstance(part, Link) and scope + old in self.tree.links:  # a site that is a link by now had this name too
            return part.name
        is_told_apart = old in self._names_by_scope.get(scope, ()) and part.name.startswith(old)
        if _is_plain(old) and not is_told_apart:
            self.former_names[kind, scope + old] = part.name
            return part.name
        return old

    @cached_property
    def _made_scopes(self) -> frozenset[str]:
        """The scopes of models in a world of SDF that were made for bodies, which have no such names in MJCF."""
        if self.is_of_mjcf or not isinstance(self.holder, World):
            return frozenset()
        return frozenset(scope for scope, model in self.models if is_made_name(model))

    @cached_property
    def _names_by_scope(self) -> Mapping[str, frozenset[str]]:
        """The names of links, joints and frames that each model has, by its scope."""
        found = {
            scope: frozenset(each.name for part in (model.links, model.joints, model.frames) for each in part)
            for scope, model in self.models
        }
        if isinstance(self.holder, World):
            parts = (self.holder.models, self.holder.frames, self.holder.lights)
            found[""] = frozenset(each.name or "" for part in parts for each in part)
        return found

    def note_made_name(self, kind: str, part: Node, written: str | None, wish: str) -> None:
        """Note that a part is called so here alone, if it has no name in MJCF and gets it again where that is read.

        Its name was made of `wish`, which begins with the name of the part around it: neither was renamed since.
        """
        if written is not None and self.is_of_mjcf and is_made_name(part, wish):
            self.unnamed.add((kind, written))
            self.wishes[kind, written] = wish, getattr(part, "name", written)

    def name(
        self, kind: str, wanted: str | None, where: Location | Sourced, beside: Collection[str] = ()
    ) -> str | None:
        """A name that no other part of this kind has: the one that is wanted, or with a number behind it.

        Names of MJCF are unique per kind in the whole file. A change of name is in the ledger. Parts that will stand
        `beside` it have these names.
        """
        if not wanted:
            return None
        used = self.names.get(kind)
        if used is None:
            used = self.names[kind] = set(_RESERVED.get(kind, ()))
        made = wanted
        while made in used or made in beside:
            # Where all links have a "visual", to count from one each time would take quadratic time.
            number = self.numbers[kind, wanted] = self.numbers.get((kind, wanted), 0) + 1
            made = f"{wanted}_{number}"
        used.add(made)
        if made != wanted:
            message = f"{kind} {wanted!r} is called {made!r}: names are unique in all of MJCF"
            self._account_name(message, where)
        return made

    def name_in(self, body: Body, kind: str, wanted: str | None, where: Location | Sourced) -> str | None:
        """A name for a part of a body: where another body has one of this name, the body's name stands before it."""
        if not wanted:
            return None
        if wanted not in self.names.get(kind, ()):
            return self.name(kind, wanted, where)
        made = self.name(kind, f"{body.written}_{wanted}", where)
        message = f"{kind} {wanted!r} of link {body.name!r} is called {made!r}: names are unique in all of MJCF"
        self._account_name(message, where)
        return made

    def _account_name(self, message: str, where: Location | Sourced) -> None:
        # Few names change, and to find a place takes longer than to compare a name.
        place = where if isinstance(where, Location) else where.location
        self.sink.account(Fate.APPROXIMATED, rules.RENAMED, message, place, 0)

    def resolve(self, pose: Pose | None, body: Body) -> Transform:
        """Where a pose is in the frame of a body; it is in that frame unless it names another.

        Raises:
            FrameError: a frame is not known, or frames go round in a circle.
        """
        if pose is None:
            return _IDENTITY
        if not pose.relative_to:
            return Transform.from_pose(pose)
        return self.tree.frames.resolve(self.in_scope(pose, body.scope), body.name, body.name)

    def in_scope(self, pose: Pose, scope: str) -> Pose:
        """Return a pose of a part in a nested model, with the name of its frame as it is in the outermost scope."""
        if not scope or not pose.relative_to or (pose.relative_to == WORLD and isinstance(self.holder, World)):
            return pose
        return pose.copy(relative_to=scope + pose.relative_to)

    def place(self, name: str, parent: str | None, *, kind: Kind = "link") -> Transform:
        """Where a frame is in that of a link, or in the world where `parent` is None.

        Raises:
            FrameError: a frame is not known, or frames go round in a circle.
        """
        if parent is None:
            return self.tree.frames.pose(name, WORLD, kind=kind, base="world")
        return self.tree.frames.pose(name, parent, kind=kind)

    def account(self, rule: Rule, message: str, where: Location, weight: int = 1) -> None:
        """Enter what MJCF cannot say into the ledger: carried, or dropped without carriers."""
        self.keeper.account(rule, message, where, weight)

    def approximate(self, rule: Rule, message: str, where: Location, weight: int = 1) -> None:
        """Enter what MJCF says in another way into the ledger."""
        self.sink.account(Fate.APPROXIMATED, rule, message, where, weight)

    def drop_stale(self, message: str, where: Location, found: str, weight: int = 1) -> None:
        """Report what is kept of MJCF and fits nothing any more, and enter it into the ledger as dropped."""
        self.sink.account(Fate.DROPPED, rules.STALE_CARRIER, message, where, weight)
        self.sink.report(rules.STALE_CARRIER, message, where, found=found)


_IDENTITY = Transform()


def _is_plain(name: str) -> bool:
    """Whether SDF may have a name."""
    return SCOPE not in name and name == name.strip() and name != WORLD and not name.startswith("__")


def is_made_name(node: Node, wish: str = "") -> bool:
    """Whether a part has no name in the MJCF that it was read of, and was not renamed since.

    With `wish` its name has to begin with that.
    """
    found, name = find_annotation(node, MADE_NAME), getattr(node, "name", None)
    return found is not None and name is not None and found.text == name and name.startswith(wish)


def safe_name(name: str) -> str:
    """Return a name that SDF can hold: without `::`, and not one of those that it keeps for itself."""
    safe = name.replace("::", "__").strip() or "unnamed"
    return f"{safe.strip('_')}_" if safe.startswith("__") and safe.endswith("__") else safe


def without_gearboxes(holder: Model | World) -> Model | World:
    """Return a model or world without the gearboxes in it: they couple joints, and hold no link."""
    joints = tuple(joint for joint in holder.joints if joint.type != "gearbox")
    models = tuple(without_gearboxes(model) for model in holder.models)
    return replace_fields(holder, joints=joints, models=models)
