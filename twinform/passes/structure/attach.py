"""Attach one model to a link of another: a gripper to an arm."""

from collections.abc import Iterable
from typing import ClassVar, NamedTuple

from pydantic import Field

from twinform.diagnostics import DiagnosticSink, rules
from twinform.ir import (
    Document,
    Format,
    Include,
    Joint,
    Model,
    Node,
    Opaque,
    Pose,
    map_references,
    replace_node,
)
from twinform.ir.element import joined
from twinform.ir.frames import WORLD
from twinform.ir.node import Vector3
from twinform.ir.scopes import outer_models
from twinform.ir.transform import Transform
from twinform.passes.carriers.annotations import FROM, without_annotation
from twinform.passes.framework.pass_base import DocumentPass, DocumentReader
from twinform.passes.includes.merge import merge_into_model
from twinform.passes.shared.poses import OFFSET, POSE
from twinform.passes.structure.model_edit import edit_in_modern_sdf
from twinform.passes.structure.rename_parts import prefixed_scope, rename_model


class Attach(DocumentPass):
    """Put the model of another file, URDF or SDF, onto a link of this one, held by a fixed joint.

    Changes: 1. the parts of the other model become parts of this one, with `prefix` before the names of links, joints
    and frames and in all that names them; 2. a fixed joint holds its root, or the link that `link` names, at a pose in
    the frame of `to`; 3. relative paths of the other file lead to the same files; 4. materials of URDF, transmissions
    and ros2_control blocks that have a name which stands for something else here get the prefix too, or the other
    model's name; 5. a root link `world` of the other model goes, if only fixed joints hang from it and one link.
    Never touches: anything that this model has.
    Diagnostics: `unread-document`, `unknown-name`, `name-clash`.
    """

    name: ClassVar[str] = "attach"
    example: ClassVar[str] = 'attach{file="model://crate" to=base_link prefix=left_ xyz=[0,0,0.3]}'

    file: str = Field(
        min_length=1, description="The other model: a path from the working directory, or a `package://` or `model://`."
    )
    to: str = Field(min_length=1, description="The link that it is attached to; in SDF also a frame.")
    link: str | None = Field(default=None, description="The link of the other model that is held; otherwise its root.")
    prefix: str = Field(default="", description="What to put before the names of the other model's parts.")
    joint: str | None = Field(
        default=None, description="The name of the joint; otherwise the held link's and `_mount`."
    )
    xyz: Vector3 = Field(default=(0.0, 0.0, 0.0), description="Where the held link is in the frame of `to`, in m.")
    rpy: Vector3 = Field(default=(0.0, 0.0, 0.0), description="How it is turned: roll, pitch and yaw in rad.")
    model: str | None = Field(default=None, description="The model with the link `to`, where several have one.")

    def run_with(self, document: Document, sink: DiagnosticSink, read: DocumentReader) -> Document:
        """The document with the other model in one of its own."""
        return edit_in_modern_sdf(document, sink, lambda modern: self._attach(modern, sink, read))

    def _attach(self, document: Document, sink: DiagnosticSink, read: DocumentReader) -> Document:
        target = self._find_target(document, sink)
        other = read(self.file, document, sink) if target is not None else None
        guest = self._find_guest(other, document, sink) if other is not None else None
        if target is None or other is None or guest is None:
            return document
        made = self._join(target, guest, document.format, sink)
        if made is target:
            return document
        namespaces = joined(document.namespaces, [other.namespaces])
        return replace_node(document, target, made).copy(namespaces=namespaces)

    def _join(self, target: Model, guest: Model, format_: Format, sink: DiagnosticSink) -> Model:
        scope = prefixed_scope(guest, self.prefix)
        held = self.link or _root_of(guest)
        if held is None or all(link.name != held for link in guest.links):
            message = f"{self.file!r} has no {'link ' + repr(held) if held else 'root link that could be held'}"
            sink.report(rules.UNKNOWN_NAME, message, guest.location, found=held)
            return target
        renamed = rename_model(guest, scope, format_, sink)
        held = self.prefix + held
        mount = Mount(self.to, held, self.joint or f"{held}_mount", self.xyz, self.rpy, self.prefix or f"{guest.name}_")
        join = join_urdf if format_ is Format.URDF else join_sdf
        return join(target, renamed, mount, sink)

    def _find_target(self, document: Document, sink: DiagnosticSink) -> Model | None:
        """The one model that has the link `to`; None after an error is reported."""
        models = [each for each in outer_models(document) if self.model in (None, each.name)]
        fit = [each for each in models if any(part.name == self.to for part in (*each.links, *each.frames))]
        if len(fit) == 1:
            return fit[0]
        names = ", ".join(repr(each.name) for each in fit)
        why = f"several models have a link {self.to!r}: {names}" if fit else f"no link is called {self.to!r}"
        help_ = "name one of them with the option model" if fit else None
        sink.report(rules.UNKNOWN_NAME, why, document.location, found=self.to, help=help_)
        return None

    def _find_guest(self, other: Document, document: Document, sink: DiagnosticSink) -> Model | None:
        """The one model of the other file; None after an error is reported."""
        models = list(outer_models(other))
        if len(models) == 1:
            return models[0]
        message = f"{self.file!r} has {len(models)} models, and one is attached"
        sink.report(rules.UNREAD_DOCUMENT, message, document.location, found=self.file)
        return None


class Mount(NamedTuple):
    """Where a model is attached: its link `held` to the link `to`, at a pose in the frame of `to`.

    `prefix` goes before names that both models have.
    """

    to: str
    held: str
    joint: str
    xyz: Vector3
    rpy: Vector3
    prefix: str

    def pose(self, relative_to: str) -> Pose:
        """The pose, without a translation or rotation that is zero."""
        zero = (0.0, 0.0, 0.0)
        xyz, rpy = (None if each == zero else each for each in (self.xyz, self.rpy))
        return Pose(xyz=xyz, rpy=rpy, relative_to=relative_to)


def _root_of(model: Model) -> str | None:
    """The link that all others hang from, or that `world` holds; None where there are several."""
    children = {joint.child for joint in model.joints if joint.parent != WORLD}
    roots = [link.name for link in model.links if link.name not in children and link.name != WORLD]
    return roots[0] if len(roots) == 1 else None


def join_urdf(model: Model, guest: Model, mount: Mount, sink: DiagnosticSink) -> Model:
    """The robot with another one attached; the same robot after an error is reported."""
    guest = _remove_place(_remove_world(guest))
    # A link of URDF hangs from one joint, so only the root of a robot can be attached to another
    # one.
    if any(joint.child == mount.held for joint in guest.joints):
        message = f"link {mount.held!r} of the attached robot hangs from another one; `reroot` makes it the root"
        sink.report(rules.UNKNOWN_NAME, message, guest.location, found=mount.held)
        return model
    if _report_clashes(model, guest, mount, sink, (("link", "links"), ("joint", "joints"))):
        return model
    # Two robots may define a material of one name with different colors; readers take the first.
    guest = _rename_clashing_materials(model, guest, mount.prefix)
    joint = Joint(
        name=mount.joint,
        type="fixed",
        parent=mount.to,
        child=mount.held,
        pose=mount.pose(mount.to),
        source=guest.source,
    )
    held = Pose(relative_to=mount.joint)
    links = (link.copy(pose=held) if link.name == mount.held else link for link in guest.links)
    known = {material.name for material in model.materials}
    return model.copy(
        materials=(*model.materials, *(each for each in guest.materials if each.name not in known)),
        links=(*model.links, *links),
        joints=(*model.joints, joint, *guest.joints),
        extensions=(*model.extensions, *guest.extensions),
        opaque=(*model.opaque, *_rename_clashing_blocks(model.opaque, guest.opaque, mount.prefix)),
    )


def join_sdf(model: Model, guest: Model, mount: Mount, sink: DiagnosticSink) -> Model:
    """The model with the parts of another one in it; the same model after an error is reported."""
    guest = _remove_world(guest)
    if _report_clashes(model, guest, mount, sink, (("", "links"), ("", "joints"), ("", "frames"), ("", "models"))):
        return model
    # The merge of an include does all of it: the pose of one frame of the guest, and the names of
    # its parts in the model.
    placed = Include(uri=guest.name, pose=mount.pose(mount.to), placement_frame=mount.held, source=guest.source)
    unnamed = guest.copy(name=mount.prefix.rstrip("_") or guest.name)
    merged = merge_into_model(model, placed, unnamed, sink, Transform())
    if merged is model:
        return model
    joint = Joint(name=mount.joint, type="fixed", parent=mount.to, child=mount.held, source=guest.source)
    return merged.copy(joints=(*merged.joints, joint))


def _report_clashes(
    model: Model, guest: Model, mount: Mount, sink: DiagnosticSink, kinds: Iterable[tuple[str, str]]
) -> bool:
    """Report names that both models have; a link and a joint of URDF may share one."""
    taken: dict[tuple[str, str], Node] = {}
    for kind, field in kinds:
        taken.update({(kind, node.name): node for node in getattr(model, field)})
    mounts = [Joint(name=mount.joint, type="fixed", source=guest.source)]
    clash = False
    for kind, field in kinds:
        own = mounts if field == "joints" else []
        for node in (*getattr(guest, field), *own):
            other = taken.get((kind, node.name))
            if other is not None:
                message = f"both models have something called {node.name!r}"
                sink.report(
                    rules.NAME_CLASH, message, other.location, found=node.name, related=(node.location,),
                    help="give the attached model a prefix",
                )  # fmt: skip
                clash = True
    return clash


def _remove_place(guest: Model) -> Model:
    """The robot without properties of a whole file: its pose, and what it was converted from."""
    extensions = (
        each if each.reference else each.copy(content=tuple(part for part in each.content if part.name != "pose"))
        for each in guest.extensions
    )
    kept = tuple(each for each in extensions if each.reference or each.content or each.opaque)
    return without_annotation(guest.copy(extensions=kept), FROM, OFFSET, POSE)


def _remove_world(model: Model) -> Model:
    """The model without the fixed joint to `world`, if it is the only one, and without the link `world` of URDF."""
    held = [joint for joint in model.joints if joint.parent == WORLD]
    if not held or any(joint.type != "fixed" for joint in held) or len(held) > 1:
        return model
    joints = tuple(joint for joint in model.joints if joint is not held[0])
    links = tuple(link for link in model.links if link.name != WORLD)
    return model.copy(joints=joints, links=links)


def _rename_clashing_materials(model: Model, guest: Model, prefix: str) -> Model:
    """The guest with a prefix before names of materials that mean something else in the model."""
    theirs, mine = _material_meanings(model), _material_meanings(guest)
    names = {name: prefix + name for name in mine.keys() & theirs.keys() if mine[name] != theirs[name]}
    if not names:
        return guest
    return map_references(guest, lambda kind, name: names.get(name, name) if kind == "material" else name)


def _material_meanings(model: Model) -> dict[str, tuple[object, ...]]:
    """Color and texture of each material by name: a material of the robot, or the first of a visual that has any."""
    inline = (visual.material for link in model.links for visual in link.visuals if visual.material)
    found: dict[str, tuple[object, ...]] = {}
    for material in (*model.materials, *inline):
        if material.name and (material.color or material.texture):
            found.setdefault(material.name, (material.color, material.texture))
    return found


def _rename_clashing_blocks(there: tuple[Opaque, ...], more: tuple[Opaque, ...], prefix: str) -> list[Opaque]:
    """Transmissions, ros2_control and the like of the guest, with a prefix before names that are taken."""
    taken = {(part.element.name, part.element.get("name")) for part in there if part.element}
    made: list[Opaque] = []
    for part in more:
        element = part.element
        if element is None:  # attributes of the other robot say something of its file
            continue
        if (element.name, element.get("name")) in taken and element.get("name"):
            attributes = tuple((key, prefix + text if key == "name" else text) for key, text in element.attributes)
            made.append(part.copy(element=element.copy(attributes=attributes)))
        else:
            made.append(part)
    return made
