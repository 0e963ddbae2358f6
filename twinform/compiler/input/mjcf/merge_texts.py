"""Merges the carriers of a file of MJCF into what it was lowered to, which makes the document that it was written of.

What stands in the file always counts. A carrier fills what is open, and gives names, frames and notations back.
"""

from collections.abc import Collection, Iterable, Mapping
from typing import TypeVar

from twinform.compiler.input.mjcf.attached_frames import attach_frames
from twinform.compiler.input.mjcf.carried_texts import CarriedText, are_of_sdf, nodes_of, report_stale, report_unmerged
from twinform.compiler.input.mjcf.first_links import keep_first_link, with_first_links
from twinform.compiler.input.mjcf.joined_joints import join_joints, sensors_left
from twinform.compiler.input.mjcf.lower_inertials import with_zeros
from twinform.compiler.input.mjcf.merge_parts import merge_parts
from twinform.compiler.input.mjcf.models_of_world import (
    is_held,
    is_static_frame,
    with_joints_between,
    with_models,
    with_nested,
    without_holds,
    without_moved_statics,
)
from twinform.compiler.input.mjcf.names import safe_name
from twinform.compiler.input.mjcf.one_model import one_model
from twinform.compiler.input.mjcf.renamed_parts import name_in_file, renamed_parts
from twinform.compiler.input.mjcf.restore_contacts import settle_contacts
from twinform.compiler.input.mjcf.restore_loops import NamesByFile, is_loop, loops_back
from twinform.compiler.input.mjcf.restore_sensors import (
    restored_settings,
    sensors_back,
    without_lights,
    without_parts_of_sensors,
)
from twinform.compiler.input.mjcf.spellings import Spellings, floating_from_world
from twinform.compiler.input.mjcf.usual_remainders import without_assets, without_named
from twinform.compiler.input.mjcf.written_models import without_stand_ins
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Document, Format, Frame, Joint, Link, Model, Node, Opaque, World, replace_fields, rewrite
from twinform.ir.element import Namespaces
from twinform.ir.frames import WORLD, FrameError, FrameGraph
from twinform.ir.scopes import SCOPE
from twinform.passes.carriers.annotations import (
    FROM,
    came_from,
    find_annotation,
    is_synthesized,
    may_write_scopes,
    with_annotation,
    without_annotation,
    without_synthesized,
)
from twinform.passes.carriers.carriers import NAMESPACE, bits_of_ours
from twinform.passes.carriers.carriers import PREFIX as TF
from twinform.passes.carriers.mjcf_texts import DOCUMENT, PREFIXES, SEVERAL
from twinform.passes.carriers.old_names import source_name
from twinform.passes.carriers.partial_nodes import WRITTEN, Merging, is_rest, written_names
from twinform.passes.carriers.repeated_parts import AGAIN, unwrap_repeated
from twinform.passes.carriers.token_mass import UNSAID
from twinform.passes.legalise.changed_names import RestoreNames
from twinform.passes.legalise.gearboxes import without_their_mimics
from twinform.passes.legalise.nested_models import NameScopes, RestoreNested
from twinform.passes.legalise.to_mjcf.kept_mjcf import KEPT
from twinform.passes.legalise.to_mjcf.rotors import with_rotors
from twinform.passes.legalise.to_sdf.joint_types import FLOATING
from twinform.passes.legalise.to_sdf.restore_frames import RestoreFrames
from twinform.passes.sdf_versions import change_version, lower_meaning
from twinform.passes.sdf_versions.put_back import PutBack
from twinform.passes.sdf_versions.rename_states import RenameStates
from twinform.passes.sdf_versions.set_version import SetVersion
from twinform.passes.shared.poses import POSE
from twinform.schemas import DEFAULT_SDF_VERSION, XmlElement, parse_version, versions_of

_BEFORE_NAMED_FRAMES = frozenset(each for each in versions_of("sdf") if parse_version(each) < (1, 7))
"""The versions of SDF in which axes and poses name no frames."""
_WITH_AUTOMATIC = "1.11"
"""The first version of SDF in which inertias are computed; what they became in MJCF was compared by then."""
AnyNode = TypeVar("AnyNode", bound=Node)
AnyPart = TypeVar("AnyPart", Link, Joint, Frame, Model)


def merge_texts(document: Document, texts: tuple[CarriedText, ...], root: XmlElement, sink: DiagnosticSink) -> Document:
    """The document of a canonical tree with what carriers hold, in the version of SDF that its source had."""
    if not texts:
        return document
    try:
        if not are_of_sdf(texts):
            return merge_parts(document, texts, root, sink)
        return _Merged(document, texts, root, sink).document()
    except FrameError as error:  # an edit has left frames without what they were in
        error.report(sink)
        return document


class _Merged:
    """Merges the carriers of one file."""

    def __init__(
        self, lowered: Document, texts: tuple[CarriedText, ...], root: XmlElement, sink: DiagnosticSink
    ) -> None:
        self.lowered = lowered
        self.root = root
        self.texts = texts
        self.sink = sink
        self.parts = frozenset[tuple[str, str]]()
        self.names: Mapping[str, str] = {}
        self.holds: tuple[Joint, ...] = ()
        self.spellings = Spellings(root, sink)
        self.merging = Merging(self.spellings)
        self.links: list[Link] = [each for each in nodes_of(texts, "link") if isinstance(each, Link)]
        self.joints: list[Joint] = [each for each in nodes_of(texts, "joint") if isinstance(each, Joint)]
        self.frames: list[Frame] = [each for each in nodes_of(texts, "frame") if isinstance(each, Frame)]
        self.world = next((each for each in nodes_of(texts, "world") if isinstance(each, World)), None)
        self.around = next((each for each in nodes_of(texts, DOCUMENT) if isinstance(each, Document)), None)

    def document(self) -> Document:
        """The document as it was before it was written, with all edits since."""
        model = self._named(one_model(self.lowered, safe_name(self.root.get("model") or "model")))
        there = {name_in_file(each) for each in model.links}
        holder = self.world or self.around
        lights = holder.lights if holder else ()
        back = sensors_back(self.links, self.joints, lights, self.root, there, self.sink)
        self.links, self.joints, lights, self.parts = back
        if self.world is not None:
            self.world = replace_fields(self.world, lights=lights)
        elif self.around is not None:
            self.around = replace_fields(self.around, lights=lights)
        model = without_parts_of_sensors(model, self.parts)
        model, left = join_joints(model, self.joints, self.names)
        for each in left:
            self._stale(f"joint {each.name!r} is no joint of type {each.type} any more", each)
        gone = set(map(id, left))
        self.joints = [each for each in self.joints if id(each) not in gone] + sensors_left(model, left)
        model = self._merged(self._with_loops(model))
        model = with_rotors(attach_frames(model, self.sink, is_world=self._is_of_world))
        model = without_assets(model, self.spellings.agreed)
        report_unmerged(self.sink, self.merging.stale)
        if self._is_of_world:
            model = with_models(model, in_models=self._has_scopes)
        elif self._has_scopes:
            model = with_nested(model)
        else:
            model = with_joints_between(model, in_models=False)
        document = self._as_document(self._restored(with_first_links(model)))
        if any(each.type == "gearbox" for each in self.joints):
            document = rewrite(document, Model, lambda each: without_their_mimics(each, self.sink))
        return self._in_version(rewrite(document, Node, self._with_repeated, having=bits_of_ours(AGAIN)))

    def _with_repeated(self, node: AnyNode) -> AnyNode:
        """The node with what repeats an element of it, as long as it has that."""
        node, gone = unwrap_repeated(node)
        for name in gone:
            self._stale(f"there is no <{name}> any more that a second one repeats", node)
        return node

    def _named(self, model: Model) -> Model:
        """The model whose parts have the names that they had before they were written."""
        scopes = {"has_scopes": self._has_scopes, "is_free": may_write_scopes(self._source_version or "")}
        named = renamed_parts(model, self.links, self.joints, self.frames, **scopes)
        self.names = {name_in_file(old): new.name for old, new in zip(model.joints, named.joints, strict=True)}
        return named

    def _with_loops(self, model: Model) -> Model:
        """The model with the joints that closed loops in place of the constraints that do, if these still do."""
        links = {written: each.name for each in self.links for written in written_names(each)}
        names = NamesByFile(links, self.names, frozenset(each.name for each in self.frames))
        back = loops_back(model, filter(is_loop, self.joints), names, self.root, self.sink)
        self.spellings.agreed.update((tag, each) for tag in ("connect", "weld") for each in back.names)
        self.joints = [each for each in self.joints if not is_loop(each)]
        return back.model

    def _merged(self, model: Model) -> Model:
        partial = next((each for each in nodes_of(self.texts, "model") if isinstance(each, Model)), None)
        made = frozenset(each.name for each in model.joints if is_synthesized(each))
        joints = tuple(without_synthesized(each) if each.name in made else each for each in model.joints)
        whole = {each.name: each for each in self.links if not is_rest(each)}
        told = {each.name for each in self.links if each.inertial and find_annotation(each.inertial, UNSAID)}
        between = tuple(
            whole[each.name].copy(pose=each.pose, source=each.source)
            if each.name in whole and is_synthesized(each)
            else with_zeros(each, is_told=each.name in told)
            for each in model.links
        )
        known = {each.name for each in between}
        self.links = [each for each in self.links if each.name not in whole or each.name not in known]
        holds = is_held(model)  # as the file has it; a joint that a carrier has of a static model cannot move
        links = self.merging.merge_all(between, tuple(without_annotation(each, WRITTEN) for each in self.links))
        ends = {WORLD, *(each.name for each in links), *(each.name for each in (*model.frames, *self.frames))}
        still = tuple(without_moved_statics(self._held_by(ends), model, self.sink))
        static = self._of_static_models(still, is_static=holds and bool(partial and partial.static))
        joints = without_stand_ins(model.copy(joints=joints), static).joints
        joints = self.merging.merge_all(joints, tuple(self._typed(joints, ends)))
        kept = tuple(without_annotation(each, WRITTEN) for each in still)
        frames = self.merging.merge_all(model.frames, kept)
        model = model.copy(links=links, joints=joints, frames=frames)
        if partial is None:
            return self._let_go(model, made)
        is_static = bool(partial.static) and holds
        if partial.static and not is_static:
            self._stale(f"model {model.name!r} is not static any more: something in it moves", partial)
            partial = partial.copy(static=None)
        partial = partial.copy(name=self._name(partial))
        return self._let_go(self.merging.merge(model, partial), made, is_static=is_static)

    def _of_static_models(self, frames: Iterable[Frame], *, is_static: bool) -> list[Joint]:
        """The kept joints of static models, which the file has as fixed ones; all of them, if the whole is static.

        `frames` stand for the models in the model.
        """
        if is_static:
            return self.joints
        static = tuple(each.name + SCOPE for each in frames if is_static_frame(each)) or "\0"
        return [each for each in self.joints if (each.child or "").startswith(static)]

    def _name(self, partial: Model | World) -> str:
        """The name of a model or world: that of the file, unless it has none or the one that was written."""
        written = self.root.get("model")
        is_same = written in {None, partial.name, source_name(partial)}
        return partial.name if is_same else safe_name(written or "")

    def _typed(self, joints: Iterable[Joint], ends: set[str]) -> Iterable[Joint]:
        """The partial joints whose links are there; one that could not move goes where the file has another now."""
        known, held = {each.name for each in joints}, {each.child for each in joints}
        for each in self.joints:
            is_held = not is_rest(each) and each.type != "gearbox" and each.child in held
            if each.name in known or (each.parent in ends and each.child in ends and not is_held):
                yield without_annotation(each, WRITTEN)
            elif is_held:
                self._stale(f"another joint holds what joint {each.name!r} held", each)
            else:
                self._stale(f"there is nothing any more that joint {each.name!r} holds", each)

    def _held_by(self, there: Collection[str]) -> Iterable[Frame]:
        """The partial frames, without those of no site that were attached to what is not there any more."""
        for each in self.frames:
            if is_rest(each) or each.attached_to is None or each.attached_to in there:
                yield each
            else:
                message = f"there is no {each.attached_to!r} any more, to which the frame {each.name!r} was attached"
                self._stale(message, each)

    def _let_go(self, model: Model, made: frozenset[str], *, is_static: bool = False) -> Model:
        """The model without joints that only say that it is fixed to the world, where something else says so."""
        carried = {each.name for each in self.joints if not is_synthesized(each)}
        roots = _roots(model)
        # The only root of a URDF goes without saying; of several each is held or floats.
        is_robot = came_from(model, Format.URDF) and len(roots) <= 1

        def is_needless(joint: Joint) -> bool:
            if joint.type != "fixed" or joint.parent != WORLD:
                return False
            return (is_static and joint.name in made - carried) or (is_robot and is_synthesized(joint))

        self.holds = tuple(each for each in model.joints if is_robot and is_needless(each))
        # A root was held by a joint of the file, or by one that was made; what came by way of SDF floats there too.
        holds = (each for each in self.joints if each.type == "fixed" and (is_synthesized(each) or each.child in roots))
        if is_robot and any(holds) and not any(each.parent == WORLD for each in model.joints):
            return _let_float(model, roots)
        return model.copy(joints=tuple(each for each in model.joints if not is_needless(each)))

    def _restored(self, model: Model) -> Model:
        """The model whose poses are written in their frames and notations, with models in it."""
        origin = find_annotation(model, FROM)
        version = versions_of("sdf")[-1]
        model = with_annotation(without_annotation(model, FROM), FROM, attributes={"format": "sdf", "version": version})
        is_old = self._is_mixed and self._source_version in _BEFORE_NAMED_FRAMES
        frames = RestoreFrames.unchecked(old_words=is_old, is_world=self._is_of_world)
        steps = (NameScopes.unchecked(), frames, RestoreNested.unchecked())
        for step in steps:
            model = step.run_model(model, self.sink)
        model = without_annotation(without_holds(model), FROM)
        return model if origin is None else model.copy(opaque=(Opaque.unchecked(element=origin), *model.opaque))

    def _as_document(self, model: Model) -> Document:
        newest = versions_of("sdf")[-1]
        # A document of MJCF keeps the defaults of MJCF, and this one was of SDF.
        source = self.lowered.source and self.lowered.source._replace(step="sdf")
        document = Document.unchecked(format=Format.SDF, version=newest, source=source)
        if self._are_several:
            alone = self._as_world(model, World.unchecked(name=model.name))
            holder = settle_contacts(alone)
            parts = {"models": holder.models, "lights": alone.lights}
        else:
            holder = self._settled(model) if self.world is None else settle_contacts(self._as_world(model, self.world))
            parts = {"models": (holder,)} if isinstance(holder, Model) else {"worlds": (holder,)}
        document = document.copy(**parts)
        if self.around is not None:
            document = self.merging.merge(document, without_annotation(self.around, FROM, PREFIXES, SEVERAL))
        return document.copy(namespaces=self._namespaces())

    def _settled(self, model: Model) -> Model | World:
        """The model with its contacts, which were computed while a robot was held by the world."""
        model = keep_first_link(model, can_be_named=self._source_version not in _BEFORE_NAMED_FRAMES)
        graph = FrameGraph(model)  # a link that was made for a model without any is gone
        holds = tuple(each for each in self.holds if graph.knows(each.child or ""))
        held = settle_contacts(model.copy(joints=(*holds, *model.joints)))
        return held.copy(joints=tuple(each for each in held.joints if each not in self.holds))

    def _namespaces(self) -> Namespaces:
        """The prefixes of the source, and ours."""
        name = f"{{{NAMESPACE}}}{PREFIXES}"
        parts = self.around.opaque if self.around else ()
        found = [part.element for part in parts if part.element and part.element.name == name]
        theirs = ((each.get("prefix") or "", each.get("uri") or "") for each in found)
        return (*((prefix, uri) for prefix, uri in theirs if uri and prefix != TF), (TF, NAMESPACE))

    @property
    def _is_of_world(self) -> bool:
        """Whether the model stands for a world, or for several models beside each other."""
        return self.world is not None or self._are_several

    @property
    def _has_scopes(self) -> bool:
        """Whether `::` in a name stands between a model and a part of it: in URDF and in older SDF it means nothing."""
        models = (each for each in nodes_of(self.texts, "model") if isinstance(each, Model))
        is_of_urdf = any(came_from(each, Format.URDF) for each in models)
        return not is_of_urdf and not may_write_scopes(self._source_version or "")

    @property
    def _are_several(self) -> bool:
        """Whether these were several models beside each other, in no world."""
        return self.around is not None and find_annotation(self.around, SEVERAL) is not None

    def _as_world(self, model: Model, partial: World) -> World:
        lowered = self.lowered.worlds[0] if self.lowered.worlds else World.unchecked(name=partial.name)
        # Without the mark of what was read of MJCF: this is the world of SDF that was written.
        lowered = lowered.copy(lights=without_lights(lowered.lights, self.parts))
        lowered = without_named(lowered, self.spellings.agreed)
        # What is about one model of the file is about parts of several in the world, or none.
        kept = tuple(part for part in model.opaque if part.element is not None and part.element.name == KEPT)
        lowered = lowered.copy(opaque=(*lowered.opaque, *kept))
        lowered, partial = restored_settings(lowered, partial, self.root)
        world = lowered.copy(models=model.models, joints=model.joints, frames=model.frames)
        world = self.merging.merge(world, partial.copy(name=self._name(partial)))
        return world.copy(lights=tuple(without_annotation(each, POSE) for each in world.lights))

    @property
    def _source_version(self) -> str | None:
        """The version of SDF that the source had."""
        found = find_annotation(self.around, FROM) if self.around else None
        return found.get("version") if found else None

    @property
    def _is_mixed(self) -> bool:
        """Whether the source had syntax of newer versions too."""
        found = find_annotation(self.around, FROM) if self.around else None
        return found is not None and found.get("mixed") == "true"

    def _in_version(self, document: Document) -> Document:
        """The document in the version of SDF that its source had."""
        newest = versions_of("sdf")[-1]
        is_robot = any(came_from(each, Format.URDF) for each in document.models)
        version = DEFAULT_SDF_VERSION if is_robot else self._source_version or DEFAULT_SDF_VERSION
        if version not in versions_of("sdf"):
            return document
        # Syntax of newer versions goes back, and only what means something else is rewritten.
        back = PutBack.unchecked(version=_WITH_AUTOMATIC, source=newest)
        states = RenameStates.unchecked(version=version, back=True)  # all older versions call them otherwise
        mixed = (back, states, *lower_meaning(version), SetVersion.unchecked(version=version))
        for step in mixed if self._is_mixed or version == newest else change_version(newest, version):
            document = step.run(document, self.sink)
        is_old = not self._is_mixed and version in _BEFORE_NAMED_FRAMES
        return rewrite(document, Model, self._with_old_names) if is_old else document

    def _with_old_names(self, model: Model) -> Model:
        """The model of a version in which a link, a joint and a frame may have one name, with these names."""
        origin = find_annotation(model, FROM)
        marked = model if origin is not None else with_annotation(model, FROM, attributes={"format": "sdf"})
        made = RestoreNames.unchecked(to=Format.SDF, apart=True).run_model(marked, self.sink)
        return made if origin is not None else without_annotation(made, FROM)

    def _stale(self, message: str, node: Node) -> None:
        report_stale(self.sink, message, node.source)


def _let_float(model: Model, roots: Collection[str]) -> Model:
    """The model with a floating joint for its root: a root of URDF is held, and somebody has set this one free."""
    names = {each.name for part in (model.links, model.joints, model.frames) for each in part}
    links = (floating_from_world(each, names) if each.name in roots else each for each in model.links)
    return model.copy(links=tuple(links))


def _roots(model: Model) -> set[str]:
    """The links that no other link holds, and that no joint of URDF leaves free, unless the world holds them now."""
    held = {each.child for each in model.joints if each.parent != WORLD}
    on_world = {each.child for each in model.joints} - held
    free = {each.name for each in model.links if find_annotation(each, FLOATING) is not None} - on_world
    return {each.name for each in model.links} - held - free
