"""Folding `<gazebo>` elements into the links, joints and model that they refer to."""

from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator
from functools import partial
from typing import Any, ClassVar, TypeAlias, TypeVar, cast

from twinform.diagnostics import DiagnosticSink, Fate, Location, Rule, Severity, rules
from twinform.ir import Element, Format, Frame, GazeboExtension, Joint, Link, Model, Node, Opaque
from twinform.ir.record import field_value
from twinform.passes.carriers.annotations import EXTENSION, came_from, is_synthesized, with_annotation
from twinform.passes.carriers.carriers import DANGLING, OVERRULED, SECOND, Attributes, Keeper, pack, to_element
from twinform.passes.framework.pass_base import ModelPass
from twinform.passes.legalise.changed_names import with_look
from twinform.passes.legalise.folded_parts import FoldedPart, folded_part
from twinform.passes.legalise.free_links import are_at_one_place, placing_frames
from twinform.passes.legalise.to_sdf.gazebo_fields import (
    REPLACING,
    merge,
    old_values,
    read_content,
    set_collision,
    set_joint_fields,
    set_link_fields,
    set_model_fields,
    set_visual,
    with_axis,
    with_mass,
    written,
)
from twinform.passes.legalise.to_sdf.gazebo_sorting import (
    Blob,
    Sorter,
    TagValue,
    is_part_of_axis,
    lacks_shapes,
    place_of,
    places_of,
)
from twinform.passes.shared.gazebo_tags import JOINT_TAGS, LINK_FIELDS, LINK_TAGS, MODEL_TAGS
from twinform.passes.shared.loop_elements import behind_tree

AnyNode = TypeVar("AnyNode", bound=Node)
_FoldPart: TypeAlias = Callable[[Any, list[GazeboExtension]], Any]

_NOT_OF_LINKS = frozenset(MODEL_TAGS | JOINT_TAGS)
_NOT_OF_JOINTS = frozenset(MODEL_TAGS | LINK_TAGS)
_NOT_OF_MODELS = frozenset(LINK_TAGS | JOINT_TAGS)


class FoldGazebo(ModelPass):
    """Fold `<gazebo>` elements into the links, joints and the model that they refer to.

    Changes: 1. tags with a meaning of their own (`mu1`, `material`, `turnGravityOff`, ...) set the field that they
    mean, in every visual or collision of the link where they are about shapes; 2. `<visual>` and `<collision>` put
    their children into every visual or collision of the link, and so does a `<material>` with elements in it; a later
    tag, `<surface>` or `<material>` takes the place of what earlier ones set, and of all else the first counts; 3. what
    is left is read as SDF at the place of the reference: sensors, plugins, lights, joints, poses; an `<axis>` or
    `<physics>` adds to what is there; 4. what means nothing where it stands is carried, or dropped with `carriers`
    false.
    Never touches: what the link, joint or model has already; the other one stays, with `gazebo-conflict`.
    Diagnostics: `gazebo-conflict`, `gazebo-tag-without-target`, and those of reading SDF.
    """

    name: ClassVar[str] = "fold-gazebo"
    carriers: bool = True

    def run_model(self, model: Model, sink: DiagnosticSink) -> Model:
        """The model without extensions."""
        if not model.extensions:
            return model
        found = DiagnosticSink(file=sink.file, strict=sink.strict)
        changed = _Fold(model, found, carriers=self.carriers).run()
        sink.extend_new(found.diagnostics)  # `check` has folded before, to see what is wrong
        sink.entries.extend(found.entries)
        return changed


class _Fold:
    """One run over one model."""

    def __init__(self, model: Model, sink: DiagnosticSink, *, carriers: bool) -> None:
        self.robot = model
        self.sink = sink
        self.carriers = carriers
        self.is_back = came_from(model, Format.SDF)
        self.annotations = carriers and not self.is_back  # SDF does not need them back
        self.links = {link.name for link in model.links}
        self.joints = {joint.name for joint in model.joints}
        self.kept: list[Opaque] = []

    def run(self) -> Model:
        groups: dict[str, list[GazeboExtension]] = defaultdict(list)
        for extension in self.robot.extensions:
            groups[extension.reference or ""].append(extension)
            self._shell(extension)
        model = self.robot.copy(
            extensions=(),
            links=tuple(self._each(self.robot.links, groups, self._link)),
            joints=tuple(self._each(self.robot.joints, groups, self._joint)),
        )
        parts = self.links | self.joints
        for name, found in groups.items():
            if name and name not in parts:
                for extension in found:  # so that a corrected name finds it again
                    self._keep(
                        extension,
                        extension.content,
                        rules.URDF_ONLY,
                        f"<gazebo> refers to {name!r}, which is neither a link nor a joint",
                        DANGLING,
                    )
        model = self._model(model, groups[""]) if "" in groups else model
        return model.copy(opaque=(*model.opaque, *self.kept)) if self.carriers else model

    def _each(
        self, nodes: Iterable[AnyNode], groups: dict[str, list[GazeboExtension]], fold: _FoldPart
    ) -> Iterator[AnyNode]:
        context = (
            fold.__name__, self.robot.name, frozenset(self.links), frozenset(self.joints), self.is_back, self.carriers,
            self.sink.file, self.sink.strict,
        )  # fmt: skip
        for node in nodes:
            extensions = groups.get(str(getattr(node, "name", None)))
            yield self._folded(node, extensions, context, fold) if extensions else node

    def _folded(
        self, node: AnyNode, extensions: list[GazeboExtension], context: tuple[object, ...], fold: _FoldPart
    ) -> AnyNode:
        apart = partial(self._apart, fold, node, extensions)
        # behind an error less is read, so that nothing from there on is what it would be by itself
        found = None if self.sink.has_errors else folded_part(node, extensions, context, apart)
        if found is None:
            return fold(node, extensions)
        self.sink.extend(found.sink.diagnostics)
        self.sink.entries += found.sink.entries
        self.kept += found.kept
        return cast("AnyNode", found.part)

    def _apart(self, fold: _FoldPart, node: Node, extensions: list[GazeboExtension]) -> FoldedPart:
        """A part, with what is found and kept on the way by itself."""
        around = self.sink, self.kept
        self.sink, self.kept = DiagnosticSink(file=self.sink.file, strict=self.sink.strict), []
        try:
            return FoldedPart(fold(node, extensions), self.sink, self.kept, (node, extensions))
        finally:
            self.sink, self.kept = around

    def _shell(self, extension: GazeboExtension) -> None:
        """Attributes and text of the element itself, and an element without content, which nothing comes of."""
        for part in extension.opaque:
            rule = rules.UNKNOWN_ATTRIBUTE if part.attribute else rules.STRAY_TEXT
            if not (part.attribute and part.attribute[0].startswith("{")):
                self.sink.report(rule, f"no reader uses {part.name} of <gazebo>", part.location, found=part.name)
        if extension.opaque or not extension.content:
            self._keep(extension, (), rules.URDF_ONLY, "this <gazebo> sets nothing in the model")

    def _link(self, link: Link, extensions: list[GazeboExtension]) -> Link:
        elsewhere = _NOT_OF_LINKS if link.name not in self.joints else frozenset(MODEL_TAGS)
        sorter = self._sort(extensions, LINK_TAGS, elsewhere, shapes=True, idle=partial(lacks_shapes, link))
        if link.name in self.joints:
            # A reference to a name that a link and a joint share means the link; only tags that joints
            # alone have go to the joint.
            sorter.forget(JOINT_TAGS)
        own = link = set_link_fields(link, sorter.values)
        before: list[Blob | TagValue] = []
        # In the order of libsdformat: in each <gazebo> what goes into shapes comes first and the
        # tags count beside it, and a later <gazebo> overrules an earlier one.
        for blobs, tags in sorter.in_order():
            for blob in blobs:
                link = self._into_shapes(link, blob, own, before)
                before.append(blob)
            link = self._with_tags(link, tags, before)
            before += tags
        return self._merge(link, "link", sorter.rest)

    def _joint(self, joint: Joint, extensions: list[GazeboExtension]) -> Joint:
        if joint.name in self.links:  # the link of that name has taken everything but the tags for joints
            extensions = [_only(extension, JOINT_TAGS) for extension in extensions]
        if joint.type == "floating":  # it is no joint in SDF
            name = f"{joint.child}_floating_joint" if is_synthesized(joint) else joint.name  # as URDF gets it anew
            for extension in extensions:
                moved = extension.copy(reference=name)
                self._misplaced(moved, list(extension.content), f"the floating joint {joint.name!r}")
            return joint
        unfit = is_part_of_axis if joint.type == "fixed" else None
        sorter = self._sort(extensions, JOINT_TAGS, _NOT_OF_JOINTS, unfit=unfit)
        joint = set_joint_fields(joint, sorter.values)
        return self._merge(joint, "joint", sorter.rest)

    def _model(self, model: Model, extensions: list[GazeboExtension]) -> Model:
        sorter = self._sort(extensions, MODEL_TAGS, _NOT_OF_MODELS)
        links, own, frames = len(model.links), model.joints, len(model.frames)
        model = self._merge(set_model_fields(model, sorter.values), "model", sorter.rest)
        return model.copy(
            links=(*model.links[:links], *map(with_mass, model.links[links:])),
            joints=(*own, *map(self._extension, behind_tree(model.joints[len(own) :], own))),
            frames=(*model.frames[:frames], *self._own_frames(model.frames[frames:])),
        )

    def _own_frames(self, frames: tuple[Frame, ...]) -> tuple[Frame, ...]:
        """Drop the frames that only tell libsdformat where a floating joint leaves a link; report wrong ones."""
        placing = list(filter(self._is_placing, frames))
        if not placing:
            return frames
        floating = {joint.name: joint for joint in self.robot.joints if joint.type == "floating"}
        right = placing_frames(self.robot, (floating[frame.name] for frame in placing if frame.name in floating))
        for frame in placing:
            if frame.name not in floating:
                message = (
                    f"the frame {frame.name!r} in <gazebo> is for a floating joint, and {frame.name!r} is none now"
                )
                self.sink.report(rules.STALE_CARRIER, message, frame.location, found=frame.name)
            elif frame.name in right and not are_at_one_place(frame, right[frame.name]):
                message = (
                    f"Gazebo has link {floating[frame.name].child!r} where the frame {frame.name!r} in <gazebo> is, "
                    "and the floating joint of that name has it elsewhere"
                )
                self.sink.report(
                    rules.STALE_CARRIER, message, frame.location, expected=_written_pose(right[frame.name])
                )
        return tuple(frame for frame in frames if not self._is_placing(frame))

    def _is_placing(self, frame: Frame) -> bool:
        return is_synthesized(frame) and frame.name in self.joints

    def _extension(self, joint: Joint) -> Joint:
        return with_annotation(with_axis(joint), EXTENSION) if self.annotations else with_axis(joint)

    def _sort(
        self,
        extensions: list[GazeboExtension],
        tags: dict[str, Any],
        elsewhere: frozenset[str],
        *,
        shapes: bool = False,
        unfit: Callable[[Element], bool] | None = None,
        idle: Callable[[Element], bool] | None = None,
    ) -> Sorter:
        """The content of extensions by what it means; what means nothing here is reported and kept."""
        sorter = Sorter(tags, elsewhere, self.sink, shapes=shapes, unfit=unfit, idle=idle)
        for extension in extensions:
            sorter.sort(extension)
        of = "a link" if shapes else "a joint"
        for extension, elements in sorter.misplaced:
            target = repr(extension.reference) if extension.reference else "the model"
            self._misplaced(extension, elements, target, of if extension.reference else target)
        for extension, elements in sorter.ignored:
            if self.is_back:  # made so that libsdformat lets the links be
                continue
            message = ", ".join(f"<{element.name}>" for element in elements)
            self._keep(extension, elements, rules.URDF_ONLY, f"{message} has no effect: no link is lumped")
        for element, extension, message in sorter.overruled:
            self._keep(extension, [element], rules.GAZEBO_CONFLICT, message, OVERRULED)
        for extension, elements in sorter.without_use:
            names = ", ".join(f"<{element.name}>" for element in elements)
            message = f"{names} applies to shapes, and link {extension.reference!r} has none of that kind"
            where, rule = place_of(elements[0], extension), rules.GAZEBO_TAG_WITHOUT_TARGET
            self.sink.report(rule, message, where, found=elements[0].name, severity=Severity.INFO)
            self._keep(extension, elements, rule, message)
        return sorter

    def _misplaced(self, extension: GazeboExtension, elements: list[Element], target: str, of: str = "") -> None:
        for element in elements:
            # Without the name, so that a tag that was copied to many links is one finding.
            message = f"<{element.name}> has no effect in a <gazebo> for {of or target}"
            where = place_of(element, extension)
            self.sink.report(rules.GAZEBO_TAG_WITHOUT_TARGET, message, where, found=element.name)
        if elements:
            names = ", ".join(f"<{element.name}>" for element in elements)
            message = f"{names} {'have' if len(elements) > 1 else 'has'} no effect on {target}"
            self._keep(extension, elements, rules.GAZEBO_TAG_WITHOUT_TARGET, message)

    def _keep(
        self, extension: GazeboExtension, elements: Iterable[Element], rule: Rule, message: str, about: Attributes = ()
    ) -> None:
        """Carry a part of an extension in an element like its own."""
        content = tuple(elements)
        attributes = [part.attribute for part in extension.opaque if part.attribute] if not content else []
        text = " ".join(part.text for part in extension.opaque if part.text) if not content else ""
        if extension.reference is not None:
            attributes.insert(0, ("reference", extension.reference))
        element = Element.unchecked(name="gazebo", attributes=tuple(attributes), text=text or None, children=content)
        keeper = Keeper(self.sink, self.carriers)
        if content == extension.content:
            keeper.account(rule, message, extension.location, element.weight)
        else:
            for part in content or (element,):
                keeper.account(rule, message, place_of(part, extension), part.weight)
        self.kept += pack([Opaque.unchecked(element=element)], "urdf", about)

    def _with_tags(self, link: Link, tags: list[TagValue], before: list[Blob | TagValue]) -> Link:
        """The link whose shapes have the values of tags, whatever they have of the elements before these."""
        for each in tags:
            if any(old not in {None, each.value} for old in old_values(each.tag, link)):
                field = each.tag.field
                self._conflict(link, field, f"<{each.element.name}>", each.where, [*places_of(field, before)][:1])
        values = [(each.tag, each.value) for each in tags]
        visuals = tuple(set_visual(visual, values) for visual in link.visuals)
        collisions = tuple(set_collision(collision, values) for collision in link.collisions)
        return link.copy(visuals=visuals, collisions=collisions)

    def _into_shapes(self, link: Link, blob: Blob, own: Link, before: list[Blob | TagValue]) -> Link:
        """Each child of the blob goes into every shape of its kind; `own` is the link as it was before any did."""
        field = "visuals" if blob.kind == "visual" else "collisions"
        last = {each.name: each for each in blob.content if each.name in REPLACING}
        content = tuple(each for each in blob.content if last.get(each.name, each) is each)
        inside = blob.extension.copy(content=content)
        extra = read_content(blob.kind, link.name, self.robot.name, [inside], self.sink)
        for name in last.keys() & extra.keys():
            earlier = *places_of(name, before), *(blob.places_of(name)[:-1])
            if earlier:
                self._conflict(link, name, "the last one", place_of(last[name], blob.extension), earlier)
            bare = zip(getattr(link, field), getattr(own, field), strict=True)
            link = link.copy(**{field: tuple(shape.copy(**{name: getattr(mine, name)}) for shape, mine in bare)})
        if self.annotations and "material" in last and extra.get("material"):
            link = with_look(link, written(extra["material"]))
        # each shape has a pose before that of the blob, be it 0 (parser_urdf.cc, CreateVisual)
        repeated = ["pose"] if extra.pop("pose", None) else []
        shapes = tuple(merge(shape, extra, repeated) for shape in getattr(link, field))
        for name in dict.fromkeys(repeated):
            where = next(iter(blob.places_of(name)), blob.where)
            self._conflict(link, name, "the first one", where, [where])
        return link.copy(**{field: shapes})

    def _merge(self, node: AnyNode, kind: str, extensions: list[GazeboExtension]) -> AnyNode:
        """The node with the SDF in the extensions read into it."""
        content = [extension for extension in extensions if extension.content]
        if not content:
            return node
        name = str(getattr(node, "name", None)) if kind != "model" else self.robot.name
        conflicts: list[str] = []
        merged = merge(node, read_content(kind, name, self.robot.name, content, self.sink), conflicts)
        # A second <pose> would overrule an edit of the first one if it came back after that was
        # deleted.
        again = [part for part in merged.opaque if _is_second(part) and part not in node.opaque]
        if again:  # a reader takes the first
            merged = merged.copy(opaque=tuple(part for part in merged.opaque if part not in again))
            conflicts.append("pose")
        for field in dict.fromkeys(conflicts):
            self._report_repeated(node, field, content)
        return merged

    def _report_repeated(self, node: Node, field: str, extensions: list[GazeboExtension]) -> None:
        """Report what is repeated, and carry the elements that repeat it."""
        again = [(extension, each) for extension in extensions for each in extension.content if each.name == field]
        is_set = field_value(node, field) is not None
        if again and not is_set:  # the first one is used
            again = again[1:]
        if not again:
            # it is deeper inside, beside what was merged
            where = extensions[0].location
            self._conflict(node, field, "the first one", where, [where])
            return
        message = self._conflict(node, field, "the first one", again[0][1].location, [])
        about = () if is_set and field not in LINK_FIELDS else SECOND
        for extension, element in again:
            self._keep(extension, [element], rules.GAZEBO_CONFLICT, message, about)

    def _conflict(self, node: Node, field: str, winner: str, where: Location, dropped: Iterable[Location]) -> str:
        """Report that something is set again, and that what stands at some places is dropped; the message."""
        message = f"<gazebo> sets {field!r} of {getattr(node, 'name', None)!r} again; {winner} is used"
        self.sink.report(rules.GAZEBO_CONFLICT, message, where, found=field)
        for place in dropped:
            self.sink.account(Fate.DROPPED, rules.GAZEBO_CONFLICT, message, place)
        return message


def _written_pose(frame: Frame) -> str:
    return " ".join(each.text or "" for each in to_element(frame, "frame", "sdf").find_all("pose"))


def _is_second(part: Opaque) -> bool:
    """Whether it is a pose beside the one that the node has."""
    return part.element is not None and part.element.name == "pose" and not part.at


def _only(extension: GazeboExtension, names: Iterable[str]) -> GazeboExtension:
    return extension.copy(content=tuple(e for e in extension.content if e.name in names))
