"""Every real model takes sensors and plugins, once, and is still a valid file of its own language."""

from collections.abc import Iterable, Iterator
from pathlib import Path

import pytest

import twinform
from testbed.corpus.files import CorpusFile, Kind, models
from tests.corpus.portions import chunks
from twinform.compiler.output.emitting import emit
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Document, Format, Link, Model, Plugin
from twinform.ir.frames import WORLD
from twinform.passes import Pass, Pipeline
from twinform.passes.plugins.add_plugin import AddPlugin
from twinform.passes.plugins.add_sensor import AddSensor
from twinform.passes.plugins.bridge_config import bridges
from twinform.passes.plugins.catalog import systems_of_file
from twinform.passes.plugins.check_plugins import CheckPlugins
from twinform.passes.plugins.sites import plugins_of, sensors_of
from twinform.passes.plugins.wheels import MEASURES, Measured, NotMeasuredError

CHUNKS = chunks()


ANOTHER_MEASURE = {
    "gazebosim+gz-sim/examples/worlds/tunnel.sdf": "the wheels are 0.73 m apart, and the plugin was copied with 1.25 m",
    "gazebosim+gz-sim/test/worlds/drive_to_pose_controller.sdf": "the joints that the plugin names are not in the file",
}
"""Files whose plugins have other wheels than their models."""


def test_wheels_are_measured_as_their_authors_did(corpus: Path) -> None:
    found = {file.name: list(drives(file)) for file in models() if file.kind == Kind.SDF}
    measured = {name: pairs for name, pairs in found.items() if pairs}
    assert len(measured) > 15 or not corpus.is_dir()
    wrong = {
        name for name, pairs in measured.items() if any(theirs != pytest.approx(ours, 0.001) for theirs, ours in pairs)
    }
    assert wrong == set(ANOTHER_MEASURE) & set(measured)


def drives(file: CorpusFile) -> Iterator[tuple[float, float]]:
    """Wheel separation and radius of each differential drive: what the file has, and what is measured."""
    if b"diff-drive" not in file.path.read_bytes():
        return
    try:
        document = twinform.load(file.path)
    except twinform.CompileError:
        return
    for plugin, site in plugins_of(document):
        kinds = systems_of_file(plugin.filename or "")
        if kinds and kinds[0].name == "diff-drive" and site.model is not None:
            yield from compared(plugin, site.model)


def compared(plugin: Plugin, model: Model) -> Iterator[tuple[float, float]]:
    def names(option: str) -> tuple[str, ...]:
        return tuple(each.text or "" for each in plugin.content if each.name == option.replace("-", "_"))

    for parameter, measure in MEASURES["diff-drive"].items():
        for value in names(parameter):
            try:
                yield float(value), measure(Measured(model, Format.SDF, names))
            except NotMeasuredError:
                yield float(value), 0.0


@pytest.mark.parametrize("chunk", CHUNKS)
def test_real_models_take_sensors_and_plugins(corpus: Path, chunk: str) -> None:
    assert corpus.is_dir()
    assert dict(problems(CHUNKS[chunk])) == {}


def problems(files: Iterable[CorpusFile]) -> Iterator[tuple[str, str]]:
    for file in files:
        try:
            document = twinform.load(file.path)
        except twinform.CompileError:
            continue
        CheckPlugins().run(document, DiagnosticSink())
        found = first_link(document)
        if found is not None:
            problem = added(document, *found)
            if problem:
                yield file.name, problem


def first_link(document: Document) -> tuple[Model, Link] | None:
    """A link to put sensors on, in a model whose name shows which it is."""
    models = [*document.models, *(model for world in document.worlds for model in world.models)]
    names = [model.name for model in models]
    for model in models:
        for link in model.links:
            if link.name != WORLD and names.count(model.name) == 1:
                return model, link
    return None


def added(document: Document, model: Model, link: Link) -> str:
    """What goes wrong when sensors and a plugin are added; nothing, if all is well."""
    steps: list[Pass] = [
        AddSensor.model_validate({"type": type_, "link": link.name, "model": model.name})
        for type_ in ("imu", "camera", "gpu_lidar")
    ]
    pipeline = Pipeline((*steps, AddPlugin.model_validate({"system": "pose-publisher", "model": model.name})))
    sink = DiagnosticSink()
    equipped = pipeline.run(document, sink)
    bridges(equipped, "harmonic", sink, "w")
    if sink.has_errors:
        return "; ".join(each.message for each in sink.diagnostics if each.is_error)
    if len(sensors_of(equipped)) != len(sensors_of(document)) + len(steps):
        return "the sensors are not there"
    if not any("pose-publisher" in (plugin.filename or "") for plugin, _ in plugins_of(equipped)):
        return "the plugin is not there"
    if pipeline.run(equipped, DiagnosticSink()) != equipped:
        return "adding twice is not adding once"
    found = DiagnosticSink()
    emit(equipped, found, fit=True)
    return "; ".join(each.message for each in found.diagnostics if each.is_error)
