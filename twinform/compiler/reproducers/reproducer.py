"""A reproducer of a failed pass as data: the pass, its options and the document that it was given.

The document is the JSON of the IR, which has no lines and spellings of the source; where the fault needs those, `again`
reports that it does not come again from the document alone.
"""

import sys
import traceback
from typing import Literal

from pydantic import BaseModel, ConfigDict

from twinform.diagnostics import DiagnosticSink
from twinform.ir import Document
from twinform.ir.verify import verify
from twinform.passes.framework.assets import NO_ASSETS, Assets
from twinform.passes.framework.pass_base import BrokenPassError, DocumentReader, PassError, Refusal
from twinform.passes.framework.pipeline import Pipeline
from twinform.passes.framework.pipeline_text import parse_pipeline
from twinform.passes.legalise import legalisation_kinds

Fault = Literal["exception", "invalid document"]


class Reproducer(BaseModel):
    """What has to be known. `again` is true where the fault came again from it when this was made."""

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
        """From a fault that has come up; `source` names the file that was compiled, `version` is our own.

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
        """Run the pass again: what it does wrong, or None where it does nothing wrong any more.

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
        """The text of its file."""
        return self.model_dump_json(indent=2, exclude_defaults=True) + "\n"
