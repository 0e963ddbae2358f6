"""Merges carriers of single links and joints into a document of MJCF: those of a file that was attached, for example.

Others are of what somebody has added to a file of SDF or URDF that was made of MJCF, or has renamed in it.
"""

from collections.abc import Collection, Iterable, Mapping
from typing import TypeVar

from twinform.compiler.input.mjcf.carried_texts import CarriedText, nodes_of, report_stale, report_unmerged
from twinform.compiler.input.mjcf.joined_joints import join_joints, sensors_left
from twinform.compiler.input.mjcf.nested_back import is_nested_in, nested_back
from twinform.compiler.input.mjcf.renamed_parts import name_in_file, with_hidden_names
from twinform.compiler.input.mjcf.restore_contacts import kept_apart
from twinform.compiler.input.mjcf.restore_loops import NamesByFile, is_loop, loops_back
from twinform.compiler.input.mjcf.restore_sensors import (
    restored_settings,
    sensors_back,
    without_parts_of_sensors,
    without_sensors,
)
from twinform.compiler.input.mjcf.spellings import Spellings
from twinform.compiler.input.mjcf.written_models import with_written_models, without_stand_ins
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Document, Frame, Joint, Link, Model, Node, Opaque, Visual, World, replace_fields, rewrite
from twinform.ir.frames import WORLD
from twinform.ir.scopes import nested_models
from twinform.passes.carriers.annotations import (
    MADE_NAME,
    SAME_GEOM,
    annotation,
    find_annotation,
    with_annotation,
    without_annotation,
)
from twinform.passes.carriers.lumped_names import Followed, followed
from twinform.passes.carriers.mjcf_texts import PART
from twinform.passes.carriers.partial_nodes import WRITTEN, Merging, is_rest, written_name, written_names
from twinform.passes.legalise.changed_names import fixed_joint_name
from twinform.passes.legalise.to_mjcf.bodies import is_of_world
from twinform.passes.legalise.to_sdf.joint_types import FLOATING
from twinform.schemas import XmlElement

AnyPart = TypeVar("AnyPart", Link, Joint, Frame, Model)


def merge_parts(document: Document, texts: tuple[CarriedText, ...], root: XmlElement, sink: DiagnosticSink) -> Document:
    """A document of MJCF with what carriers hold of its links and joints."""
    models = [each for each in nodes_of(texts, "model") if isinstance(each, Model)]
    document, models = with_written_models(document, models, sink)
    merging = _PartMerging(texts, models, root, _names_of_links(document), sink)
    document = merging.in_document(rewrite(document, Model, merging.in_model))
    merging.report_stale()
    return document


def _names_of_links(document: Document) -> frozenset[str]:
    """The names that the links of a document have in the file."""
    tops = (*document.models, *(each for world in document.worlds for each in world.models))
    inner = (model for top in tops for model in nested_models(top))
    return frozenset(name_in_file(link) for model in inner for link in model.links)


class _PartMerging:
    """Merges the carriers of one file."""

    def __init__(
        self,
        texts: tuple[CarriedText, ...],
        models: Iterable[Model],
        root: XmlElement,
        there: frozenset[str],
        sink: DiagnosticSink,
    ) -> None:
        self.root, self.sink = root, sink
        links = [each for each in nodes_of(texts, "link") if isinstance(each, Link)]
        joints = [each for each in nodes_of(texts, "joint") if isinstance(each, Joint)]
        world = next((each for each in nodes_of(texts, "world") if isinstance(each, World)), None)
        back = sensors_back(links, joints, world.lights if world else (), root, there, sink)
        self._world = world and replace_fields(world, lights=back.lights)
        frames = [each for each in nodes_of(texts, "frame") if isinstance(each, Frame)]
        self._nested = [each for each in frames if find_annotation(each, PART) is not None]
        self._whole = [each for each in frames if find_annotation(each, PART) is None and not is_rest(each)]
        self._merging = Merging(Spellings(root, sink))
        self._parts = back.parts
        self._loops = [each for each in back.joints if is_loop(each)]
        self._joints = [each for each in back.joints if not is_loop(each)]
        # A fixed joint and one of a static model have no name in the file, and are known by the body that they hold.
        self._of_bodies = {each.child: each for each in self._joints if each.type == "fixed" or not is_rest(each)}
        self._used = set[int]()
        others = (each for each in frames if is_rest(each))
        alone = (each for each in self._joints if len(written_names(each)) == 1)
        self._partials = {(type(each), written_name(each)): each for each in (*back.links, *alone, *models, *others)}

    def in_model(self, model: Model) -> Model:
        """A model with what carriers hold of it and its parts."""
        model = with_hidden_names(model, [each for each in self._joints if each.type != "fixed"])
        bodies = {name_in_file(each): each.name for each in model.links}
        held = {bodies[body]: each for body, each in self._of_bodies.items() if body is not None and body in bodies}
        fixed = {
            link: each.copy(parent=bodies.get(each.parent or "", each.parent), child=link)
            for link, each in held.items()
        }
        model = without_stand_ins(model, fixed.values())
        self._used.update(map(id, held.values()))
        names = {name_in_file(each): each.name for each in model.joints}
        several = [each for each in self._joints if len(written := written_names(each)) > 1 and names.keys() & written]
        self._used.update(map(id, several))
        chains = {each.name: _called(each, names) for each in several}
        model = self._joined(without_parts_of_sensors(model, self._parts), chains.values(), bodies)
        told = self._partials.get((Model, model.name))
        if isinstance(told, Model) and told.self_collide is False and model.self_collide:
            model = kept_apart(model, self.root)
            if model.self_collide:
                report_stale(self.sink, f"links of model {model.name!r} touch in the file", told.source)
        holds = tuple(_added_holds(model, fixed.values()))
        if isinstance(told, Model) and told.static is False and model.static:
            model = _held(model, {each.child for each in holds})
        nested = [each for each in self._nested if is_nested_in(each, bodies)]
        added = tuple(self._added_frames(model))
        self._used.update(map(id, (*nested, *added)))
        whole = replace_fields(
            self._merged(model),
            links=tuple(map(self._merged, model.links)),
            joints=(*(self._merged_joint(each, fixed, chains) for each in model.joints), *holds),
            frames=(*map(self._merged, model.frames), *added),
        )
        if model.static:
            whole = self._without_floating(whole)
        if find_annotation(model, MADE_NAME) is None and is_of_world(whole):  # a body has its name in the file
            whole = without_annotation(whole, MADE_NAME)
        return nested_back(whole, nested, bodies, self.sink) if nested else whole

    def _without_floating(self, model: Model) -> Model:
        """A model in which nothing moves, without the floating joints of URDF that left its links free."""

        def held(link: Link) -> Link:
            if (found := find_annotation(link, FLOATING)) is None:
                return link
            message = f"joint {found.get('joint')!r} left link {link.name!r} free, which is fixed in the file"
            report_stale(self.sink, message, link.source)
            return without_annotation(link, FLOATING)

        return model.copy(links=tuple(map(held, model.links)))

    def in_document(self, document: Document) -> Document:
        """The document whose world has what a carrier holds of it; it is called as the file is."""
        if not document.worlds:
            return document
        world, *others = document.worlds
        world = without_sensors(world, self._parts) if self._parts else world
        if self._world is not None:
            world, partial = restored_settings(world, self._world.copy(name=world.name), self.root)
            world = self._merging.merge(world, partial)
        return document.copy(worlds=(world, *others))

    def report_stale(self) -> None:
        """Report what belongs to nothing in the file."""
        report_unmerged(self.sink, self._merging.stale)
        for each in (*self._partials.values(), *self._loops, *self._of_bodies.values(), *self._nested, *self._whole):
            if isinstance(each, Link | Joint | Frame) and id(each) not in self._used:
                message = (
                    f"there is no {type(each).__name__.lower()} {each.name!r} any more, of which a carrier holds a part"
                )
                report_stale(self.sink, message, each.source)

    def _added_frames(self, model: Model) -> Iterable[Frame]:
        """Yield the frames that are carried as a whole, of links between the joints of one body."""
        links, known = {each.name for each in model.links}, {each.name for each in model.frames}
        return (each for each in self._whole if each.attached_to in links and each.name not in known)

    def _joined(self, model: Model, chains: Iterable[Joint], bodies: Mapping[str, str]) -> Model:
        """A model with one joint for several that stand for it: those of a chain, and constraints of a loop."""
        found = ((each, bodies.get(each.parent or ""), bodies.get(each.child or "")) for each in self._loops)
        closed = [(each, parent, child) for each, parent, child in found if parent is not None and child is not None]
        self._used.update(id(each) for each, _, _ in closed)
        names = {name_in_file(each): each.name for each in model.joints}
        joints = {each.name: each for each in model.joints}
        loops = [each.copy(parent=parent, child=child) for each, parent, child in closed]
        model, left = join_joints(model, chains)
        for each in left:
            report_stale(self.sink, f"joint {each.name!r} is no joint of type {each.type} any more", each.source)
        for each in sensors_left(model, left):
            self._partials.setdefault((Joint, name_in_file(joints[each.name])), each)
        back = loops_back(model, loops, NamesByFile(bodies, names), self.root, self.sink)
        kept = frozenset((tag, name) for tag in ("connect", "weld") for name in back.names)
        return without_parts_of_sensors(back.model, kept)

    def _merged(self, node: AnyPart) -> AnyPart:
        partial = self._partials.get((type(node), node.name if isinstance(node, Model) else name_in_file(node)))
        if not isinstance(partial, type(node)):
            return node
        self._used.add(id(partial))
        named = _with_sensed_names(node, partial) if isinstance(node, Link) and isinstance(partial, Link) else node
        merged = self._merging.merge(named, _bare(partial).copy(name=node.name))
        return _with_twins(merged, named) if isinstance(merged, Link) and isinstance(named, Link) else merged

    def _merged_joint(self, joint: Joint, fixed: Mapping[str, Joint], chains: Mapping[str, Joint]) -> Joint:
        """A joint with what a carrier holds of it, if it is fixed, or was several by the name that it has now."""
        partial = fixed.get(joint.child or "") if joint.type == "fixed" else chains.get(joint.name)
        if partial is None:
            return joint if joint.type == "fixed" else self._merged(joint)
        return self._merging.merge(joint, _bare(partial))


AnyNode = TypeVar("AnyNode", bound=Node)


def _with_twins(link: Link, read: Link) -> Link:
    """A merged link whose visuals of geoms that touch too have the shape and place of these collisions, as read."""
    read_as = {each.name: (each.geometry, each.pose) for each in read.collisions}
    now = {each.name: (each.geometry, each.pose) for each in link.collisions}

    def twin(visual: Visual) -> Visual:
        as_read = (visual.geometry, visual.pose)
        if find_annotation(visual, SAME_GEOM) is None or read_as.get(visual.name) != as_read or visual.name not in now:
            return visual
        geometry, pose = now[visual.name]
        return visual.copy(geometry=geometry, pose=pose)

    return link.copy(visuals=tuple(map(twin, link.visuals)))


def _bare(partial: AnyNode) -> AnyNode:
    return without_annotation(partial, WRITTEN)


def _with_sensed_names(link: Link, partial: Link) -> Link:
    """A link whose contact sensors call its collisions as a carrier does, and no longer as the file calls its geoms."""
    found = ((written_name(each), each.name) for each in partial.collisions)
    names = {written: Followed(name, link.name) for written, name in found if written and name and written != name}
    if not names:
        return link

    def told(part: Opaque) -> Opaque:
        if part.element is None or part.element.name != "contact":
            return part
        return part.copy(element=followed(part.element, names, carriers=False))

    sensors = (each.copy(opaque=tuple(map(told, each.opaque))) for each in link.sensors)
    return link.copy(sensors=tuple(sensors))


def _called(partial: Joint, names: Mapping[str, str]) -> Joint:
    """A partial joint that is several in the file, by the names that these have in SDF."""
    notes = (annotation(WRITTEN, attributes={"as": names.get(each, each)}) for each in written_names(partial))
    bare = without_annotation(partial, WRITTEN)
    return bare.copy(opaque=(*notes, *bare.opaque))


def _added_holds(model: Model, fixed: Iterable[Joint]) -> Iterable[Joint]:
    """Yield the joints that somebody has given to links of a static model, which need none in MJCF."""
    held = {each.child for each in model.joints}
    loose = {each.name for each in model.links if each.name not in held} if model.static else set[str]()
    return (each for each in fixed if not is_rest(each) and each.child in loose)


def _held(model: Model, held: Collection[str | None]) -> Model:
    """A model that only stands still because fixed joints hold it, of which some are carried."""
    children = {*held, *(each.child for each in model.joints)}
    loose = (each for each in model.links if each.name not in children)
    holds = (
        Joint.unchecked(
            name=fixed_joint_name(each.name), type="fixed", parent=WORLD, child=each.name, source=each.source
        )
        for each in loose
    )
    made = tuple(with_annotation(each, MADE_NAME, each.name) for each in holds)
    return model.copy(static=None, joints=(*model.joints, *made))
