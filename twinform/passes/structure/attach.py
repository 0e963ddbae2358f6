"""Attach one model to a link of another: a gripper to an arm."""

from typing import ClassVar

from pydantic import Field

from twinform.diagnostics import DiagnosticSink, rules
from twinform.ir import Document, Format, Model, replace_node
from twinform.ir.element import joined
from twinform.ir.node import Vector3
from twinform.ir.scopes import outer_models
from twinform.passes.framework.pass_base import DocumentPass, DocumentReader
from twinform.passes.structure.join_models import Mount, join_sdf, join_urdf, root_of
from twinform.passes.structure.model_edit import in_new_words
from twinform.passes.structure.rename_parts import renamed_model
from twinform.passes.structure.scopes import Part, scope_of


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
        return in_new_words(document, sink, lambda modern: self._attached(modern, sink, read))

    def _attached(self, document: Document, sink: DiagnosticSink, read: DocumentReader) -> Document:
        target = self._target(document, sink)
        other = read(self.file, document, sink) if target is not None else None
        guest = self._guest(other, document, sink) if other is not None else None
        if target is None or other is None or guest is None:
            return document
        made = self._joined(target, guest, document.format, sink)
        if made is target:
            return document
        namespaces = joined(document.namespaces, [other.namespaces])
        return replace_node(document, target, made).copy(namespaces=namespaces)

    def _joined(self, target: Model, guest: Model, format_: Format, sink: DiagnosticSink) -> Model:
        scope = scope_of(guest, self._choose, deep=False)
        held = self.link or root_of(guest)
        if held is None or all(link.name != held for link in guest.links):
            message = f"{self.file!r} has no {'link ' + repr(held) if held else 'root link that could be held'}"
            sink.report(rules.UNKNOWN_NAME, message, guest.location, found=held)
            return target
        renamed = renamed_model(guest, scope, format_, sink)
        held = self.prefix + held
        mount = Mount(self.to, held, self.joint or f"{held}_mount", self.xyz, self.rpy, self.prefix or f"{guest.name}_")
        join = join_urdf if format_ is Format.URDF else join_sdf
        return join(target, renamed, mount, sink)

    def _choose(self, part: Part, name: str) -> str:
        del part
        return self.prefix + name

    def _target(self, document: Document, sink: DiagnosticSink) -> Model | None:
        """The one model that has the link."""
        models = [each for each in outer_models(document) if self.model in (None, each.name)]
        fit = [each for each in models if any(part.name == self.to for part in (*each.links, *each.frames))]
        if len(fit) == 1:
            return fit[0]
        names = ", ".join(repr(each.name) for each in fit)
        why = f"several models have a link {self.to!r}: {names}" if fit else f"no link is called {self.to!r}"
        help_ = "name one of them with the option model" if fit else None
        sink.report(rules.UNKNOWN_NAME, why, document.location, found=self.to, help=help_)
        return None

    def _guest(self, other: Document, document: Document, sink: DiagnosticSink) -> Model | None:
        models = list(outer_models(other))
        if len(models) == 1:
            return models[0]
        message = f"{self.file!r} has {len(models)} models, and one is attached"
        sink.report(rules.UNREAD_DOCUMENT, message, document.location, found=self.file)
        return None
