"""Passes that produce an additional file. They write nothing: the caller gets the text from the diagnostics.

So the file appears together with the result, only where there is no error, and only in the folder that was named for
the result: a pipeline may come from a configuration or a reproducer, which have no say in where files are written.
"""

import re
from abc import abstractmethod
from typing import Annotated, Self

from pydantic import AfterValidator, Field

from twinform.diagnostics import DiagnosticSink, SideFile
from twinform.ir import Document
from twinform.passes.framework.pass_base import Pass

# The name of a file or folder that is not hidden and means the same to every system and shell.
_PART = re.compile(r"[^./~\\:\x00-\x1f\x7f][^/\\:\x00-\x1f\x7f]*")


def _below(path: str) -> str:
    if not all(_PART.fullmatch(part) for part in path.split("/")):
        advice = "such as config/bridge.yaml; it is not absolute, and no part of it begins with . or ~"
        raise ValueError(f"takes a path below the folder of the result, {advice}")
    return path


CompanionPath = Annotated[str, AfterValidator(_below)]
"""A path that cannot leave the folder that it is relative to, as long as there are no symbolic links."""


class FilesPass(Pass):
    """A pass that makes files beside the result, so that the result needs a folder and the pass somebody's trust."""

    @property
    def place(self) -> str:
        """The file, or the folder of the files, below the folder of the result."""
        raise NotImplementedError

    def below(self, folder: str) -> Self:
        """Return the pass with its files in a folder of this name; a pass with a fixed place returns itself."""
        del folder
        return self


class SideFilePass(FilesPass):
    """A pass whose purpose is a file beside the result; the document stays as it is."""

    @property
    def place(self) -> str:
        """The file."""
        return self.file

    file: CompanionPath = Field(description="Where to write it, below the folder of the result.")

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The same document."""
        # `bridge-config` once wrote to the path in its option, whatever became of the conversion. A
        # pipeline may stand in a configuration or a reproducer, so a model downloaded with a
        # twinform.toml could write any file of its reader.
        sink.side_files.append(SideFile(self.file, self.text(document, sink)))
        return document

    @abstractmethod
    def text(self, document: Document, sink: DiagnosticSink) -> str:
        """The text of the file. A file is only written over one that begins with the same line."""
