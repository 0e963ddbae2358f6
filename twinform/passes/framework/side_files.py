"""Passes that produce files beside the result.

They write nothing: the caller finds the texts in `DiagnosticSink.side_files` and writes them together with the result,
only without errors, and only below the folder of the result. A pipeline may come from a configuration or a reproducer,
and these must not decide where files are written.
"""

from abc import abstractmethod
from typing import Annotated

from pydantic import AfterValidator, Field

from twinform.diagnostics import DiagnosticSink, SideFile
from twinform.ir import Document
from twinform.lazy import lazy_pattern
from twinform.passes.framework.pass_base import FilesPass

# A file name that is not hidden and means the same to every system and shell.
_PART = lazy_pattern(r"[^./~\\:\x00-\x1f\x7f][^/\\:\x00-\x1f\x7f]*")


def _below(path: str) -> str:
    if not all(_PART.fullmatch(part) for part in path.split("/")):
        advice = "such as config/bridge.yaml; it is not absolute, and no part of it begins with . or ~"
        raise ValueError(f"takes a path below the folder of the result, {advice}")
    return path


CompanionPath = Annotated[str, AfterValidator(_below)]
"""A relative path that stays below its folder, as long as there are no symbolic links."""


class SideFilePass(FilesPass):
    """A pass that makes one file beside the result and leaves the document alone."""

    @property
    def place(self) -> str:
        """The path of the file."""
        return self.file

    @property
    def only_file(self) -> str:
        """The path of the file."""
        return self.file

    file: CompanionPath = Field(description="Where to write it, below the folder of the result.")

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The same document, with the file among the diagnostics."""
        # Were it written here, a model downloaded with a twinform.toml could write any file of its
        # reader.
        sink.side_files.append(SideFile(self.file, self.text(document, sink)))
        return document

    @abstractmethod
    def text(self, document: Document, sink: DiagnosticSink) -> str:
        """The text of the file. An existing file is only replaced if it begins with the same line."""
