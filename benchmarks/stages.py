"""Where the time of a conversion goes: each stage on its own, one after the other."""

import time
from collections.abc import Generator
from contextlib import contextmanager
from statistics import median

from twinform.compiler.driver import plan
from twinform.compiler.input import urdf as front_end
from twinform.compiler.input.loading import garbage_collection_paused
from twinform.compiler.input.parsing import parse
from twinform.compiler.output import sdf as back_end
from twinform.compiler.output.emitting import serialized, written_version
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Document
from twinform.ir.verify import verify
from twinform.schemas import Context, libxml2_errors


class Stages:
    """The seconds of each stage, over all runs, in the order in which they were first run."""

    def __init__(self) -> None:
        self.seconds: dict[str, list[float]] = {}

    @contextmanager
    def time(self, name: str) -> Generator[None]:
        """Count what happens inside to a stage."""
        start = time.perf_counter()
        yield
        self.seconds.setdefault(name, []).append(time.perf_counter() - start)

    def medians(self) -> dict[str, float]:
        """The seconds of each stage in a run."""
        return {name: median(seconds) for name, seconds in self.seconds.items()}


def profile_urdf_to_sdf(text: bytes, *, sdf_version: str, runs: int) -> dict[str, float]:
    """The seconds of each stage of a conversion."""
    stages = Stages()
    for _ in range(runs):
        with garbage_collection_paused():
            _convert(text, sdf_version, stages)
    return stages.medians()


def _convert(text: bytes, sdf_version: str, stages: Stages) -> None:
    sink = DiagnosticSink(file="robot.urdf")
    with stages.time("parse"):
        root = parse(text, sink)
    with stages.time("XSD of the input"):
        clean = not libxml2_errors(root, "urdf", (1, 0))
    with stages.time("schema reader: structure, values, lowering"):
        simple = clean and b"xmlns" not in text
        context = Context(sink, sink.file, "urdf", (1, 0), clean=clean, simple=simple)
        data = front_end.lower(root, context)
    with stages.time("pydantic"):
        document = Document.model_validate({**data})
    with stages.time("verify"):
        verify(document, sink)
    with stages.time("legalisation passes"):
        document = plan(document, to="sdf", sdf_version=sdf_version).run(document, sink)
    with stages.time("verify the result"):
        verify(document, sink)
    version = written_version(document)
    with stages.time("emit"):
        root = back_end.emit(document, version, {})
    with stages.time("XSD of the output"):
        libxml2_errors(root, "sdf", version)
    with stages.time("serialize"):
        serialized(root, document)
