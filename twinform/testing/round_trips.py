"""Round trips through the other format: conversion, reverse conversion, and what is not restored."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple, Self

from twinform.compiler import URDF_VERSIONS, UrdfVersion, convert
from twinform.compiler.compare import diff
from twinform.compiler.includes.expanding import expand
from twinform.compiler.input.loading import LoadOptions, read
from twinform.compiler.normal_form import normal_form
from twinform.compiler.output.emitting import emit
from twinform.compiler.search.resolve_uris import SearchPath
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Document, Format
from twinform.passes.analyses.candidates import name_once_expanded, wanted_includes
from twinform.passes.includes import has_includes
from twinform.passes.legalise.to_urdf.select_model import SelectModel
from twinform.schemas import versions_of

ANOTHER_ROBOT = "another robot"


class Mismatch(NamedTuple):
    """One thing that is not as it was. `kind` is that of a discrepancy of normal forms, or of a robot that differs.

    `path` is its XPath in the source, or where that has nothing of the kind in what came back.
    """

    kind: str
    path: str
    message: str


@dataclass(frozen=True, slots=True)
class RoundTrip:
    """A robot for a round trip through the other format: `text` is what has to be restored."""

    text: bytes
    format: Format
    version: str | None

    @classmethod
    def of(
        cls, source: Path | bytes, document: Document, *, model: str | None = None, paths: Iterable[str | Path] = ()
    ) -> Self:
        """Take a file or text with the content `document` for a round trip; of several models the one named.

        What has to come back is all of it. Where there is more than one model in it, that is the model alone, and the
        model has what it includes in it, since URDF has neither worlds nor includes.
        """
        if _is_robot(document):
            text = source.read_bytes() if isinstance(source, Path) else source
            return cls(text, document.format, document.version)
        alone = _alone(source, document, model, paths)
        return cls(emit(alone, DiagnosticSink()).encode(), alone.format, alone.version)

    def back(self, there: str) -> str:
        """The reverse conversion of a text in the other format, in the version that the robot went in.

        Raises:
            CompileError: it is refused.
        """
        if self.format is Format.URDF:
            return convert(there.encode(), to="urdf", urdf_version=_urdf_version(self.version)).text
        known = self.version if self.version in versions_of("sdf") else None
        return convert(there.encode(), to="sdf", sdf_version=known).text

    def mismatches(self, back: str) -> Iterator[Mismatch]:
        """What is not as it was: the robot, its first difference, or texts of the file."""
        found = diff(self.text, back.encode(), carriers=True).differences
        if found:
            yield Mismatch(ANOTHER_ROBOT, found[0].a.location.path or found[0].b.location.path, found[0].message)
        source, again = normal_form(self.text, name="source"), normal_form(back.encode(), name="back")
        for one in source.compare(again):
            yield Mismatch(one.kind, one.location.path, one.message)


def _is_robot(document: Document) -> bool:
    """Whether there is nothing in it but one model."""
    if document.format is Format.URDF:
        return True
    around = (*document.worlds, *document.lights, *document.includes, *document.opaque)
    return len(document.models) == 1 and not around and not has_includes(document)


def _alone(source: Path | bytes, document: Document, model: str | None, paths: Iterable[str | Path]) -> Document:
    sink = DiagnosticSink()
    alone = SelectModel(model=model).run(document, sink)
    if not sink.has_errors and not has_includes(alone):
        return alone
    load_options = LoadOptions(search=SearchPath.of(paths))
    checked = read(source, load_options)
    whole = expand(checked, load_options, wanted=wanted_includes(checked.document, model)).document or document
    return SelectModel(model=name_once_expanded(checked.document, whole, model)).run(whole, DiagnosticSink())


def _urdf_version(version: str | None) -> UrdfVersion | None:
    return next((known for known in URDF_VERSIONS if known == version), None)
