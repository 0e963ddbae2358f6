"""The normal form of a file."""

from dataclasses import dataclass
from pathlib import Path

from twinform.compiler.conversion_error import CompileError
from twinform.compiler.input.loading import LoadOptions, declared_version, read, read_tree
from twinform.compiler.input.parsing import UnreadableError
from twinform.compiler.normal_form.build_normal_form import builder
from twinform.compiler.normal_form.comparing import Comparing, Discrepancy
from twinform.compiler.normal_form.part import NormalPart
from twinform.diagnostics import DiagnosticSink
from twinform.schemas import XmlElement

_FORMATS = {"robot": "urdf", "sdf": "sdf"}


@dataclass(frozen=True, slots=True)
class NormalForm:
    """The content of a file as a tree of parts; `file` is its name."""

    root: NormalPart
    file: str = ""

    @classmethod
    def of(cls, tree: XmlElement, file: str = "") -> "NormalForm":
        """Make the normal form of a tree which `check` or `convert` has read."""
        # It looks at the two files as their author would, with types and defaults from the facts
        # tables, and at nothing of the compiler. A judge that compared the IR did not see what has
        # no field. About 30 us an element.
        format = _FORMATS[str(tree.tag)]
        return cls(builder(format, declared_version(tree, format, DiagnosticSink())).root(tree), file)

    def compare(self, back: "NormalForm") -> tuple[Discrepancy, ...]:
        """In what a file that came back differs from this one, in the order of this one."""
        return tuple(Comparing(self.file, back.file).files(self.root, back.root))


def normal_form(source: str | Path | bytes, *, name: str = "") -> NormalForm:
    """The normal form of a file, or of the bytes of one; a xacro file is expanded.

    The file need not be without errors, but has to be XML of one of the formats.

    Raises:
        CompileError: it is not.
    """
    if not isinstance(source, bytes):
        checked = read(source, LoadOptions(), name=name)
        if checked.tree is None:
            raise CompileError(checked.diagnostics, unreadable=True)
        return NormalForm.of(checked.tree, checked.path)
    sink = DiagnosticSink(file=name or "<bytes>")
    try:
        tree, _ = read_tree(source, sink)
    except UnreadableError as error:
        raise CompileError(tuple(sink.diagnostics), unreadable=True) from error
    return NormalForm.of(tree, sink.file)
