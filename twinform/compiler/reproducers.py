"""Reproducers of failed passes: files with the pass, its options and its document, for `twinform reproduce`.

The document is the JSON of the IR, without the lines and spellings of the source. Where a fault needs these, `again`
says that it does not come again from the document alone.
"""

import os
import sys
import traceback
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import Literal

from pydantic import BaseModel, ConfigDict

from twinform import __version__
from twinform.diagnostics import DiagnosticSink
from twinform.file_access import Readable
from twinform.ir import Document
from twinform.ir.verify import verify
from twinform.lazy import lazy_pattern
from twinform.passes.framework.assets import NO_ASSETS, Assets
from twinform.passes.framework.pass_base import DocumentReader, Refusal
from twinform.passes.framework.pass_errors import BrokenPassError, PassError
from twinform.passes.framework.pipeline import Pipeline
from twinform.passes.framework.pipeline_text import parse_pipeline
from twinform.passes.legalise import legalisation_kinds
from twinform.storage.staging import temporary_folder
from twinform.storage.writing import write_new_file

Fault = Literal["exception", "invalid document"]


class Reproducer(BaseModel):
    """A failed pass and its document. `again` is true where the fault came again when the reproducer was made."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    twinform: str
    python: str
    source: str
    fault: Fault
    error: str
    traceback: str
    again: bool
    pipeline: str
    document: Document

    @classmethod
    def of(cls, error: PassError, source: str, version: str) -> "Reproducer":
        """Make a reproducer of a fault; `source` names the file that was compiled, and `version` is our own.

        Raises:
            TypeError: the pass has an option that the text of a pipeline cannot express.
            ValueError: what the pass was given is no document of the IR.
        """
        found = cls(
            twinform=version,
            python=".".join(map(str, sys.version_info[:3])),
            source=source,
            fault="invalid document" if isinstance(error, BrokenPassError) else "exception",
            error=str(error),
            traceback="".join(traceback.format_exception(error)),
            again=False,
            pipeline=str(Pipeline((error.step,))),
            document=Document.model_validate_json(error.document.model_dump_json(exclude_defaults=True)),
        )
        return found.model_copy(update={"again": found._run(Pipeline((error.step,))) is not None})

    def run(
        self,
        assets: Assets = NO_ASSETS,
        reader: DocumentReader | None = None,
        refusal: Refusal | None = None,
        sink: DiagnosticSink | None = None,
    ) -> PassError | None:
        """Run the pass again, and return its fault, or None where it does not fail any more.

        `assets` are the files that the document names, for passes that open them; `reader` reads other models, except
        those that `refusal` has a reason against. What the pass finds goes into the `sink`.

        Raises:
            PipelineError: the pass is not installed, or has other options now.
        """
        pipeline = parse_pipeline(self.pipeline, kinds=legalisation_kinds())
        pipeline = pipeline.with_files(assets, reader)
        return self._run(pipeline.with_refusal(refusal) if refusal else pipeline, sink)

    def _run(self, pipeline: Pipeline, sink: DiagnosticSink | None = None) -> PassError | None:
        try:
            pipeline.run(
                self.document, sink or DiagnosticSink(), verify=verify if self.fault == "invalid document" else None
            )
        except PassError as error:
            return error
        return None

    def to_json(self) -> str:
        """Return the text of the reproducer's file."""
        return self.model_dump_json(indent=2, exclude_defaults=True) + "\n"


_UNSAFE = lazy_pattern(r"[^A-Za-z0-9._-]+")
# Characters of a model's name in a file name: file systems take 255 bytes in all.
_LONGEST = 60
_MOST = 1000
"""Files of one name; more are somebody's mistake."""


def write_reproducer(error: PassError, source: str, folder: Path | None = None) -> Path:
    """Write a reproducer, and return its path.

    It goes into the folder, or the current one; where that cannot be written, into the one for temporary files. Nothing
    is overwritten.

    Raises:
        OSError: it cannot be written.
        TypeError: the pass has an option that the text of a pipeline cannot express.
        ValueError: what the pass was given is no document of the IR.
    """
    text = Reproducer.of(error, source, __version__).to_json()
    stem = f"twinform-{error.name}-{_stem_of(source)}"
    problem: OSError | None = None
    for each in _folders(folder):
        try:
            return _write_new(each, stem, text)
        except OSError as error_:
            problem = error_
    raise problem or FileNotFoundError(str(folder))


def _folders(folder: Path | None) -> Iterator[Path]:
    yield folder or Path()
    if folder is None:
        yield temporary_folder()


def _stem_of(source: str) -> str:
    """Return the name of the source without its endings, or `document` where it is not a file."""
    return _UNSAFE.sub("_", Path(source).name.partition(".")[0])[:_LONGEST].strip("_") or "document"


def _write_new(folder: Path, stem: str, text: str) -> Path:
    for path in _names(folder, stem):
        if os.path.lexists(path):
            continue
        with suppress(FileExistsError):  # another process was faster
            write_new_file(path, text)
            return path
    raise FileExistsError(f"there are {_MOST} files called {stem}")


def _names(folder: Path, stem: str) -> Iterator[Path]:
    yield folder / f"{stem}.json"
    yield from (folder / f"{stem}-{number}.json" for number in range(2, _MOST + 1))


def read_reproducer(path: Path) -> Reproducer:
    """Read the reproducer in a file.

    Raises:
        OSError: it cannot be read.
        ValueError: it is no reproducer.
    """
    return Reproducer.model_validate_json(Readable.of(path).read(path))
