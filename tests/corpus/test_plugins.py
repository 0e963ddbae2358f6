"""Every real model takes sensors and plugins, once, and is still a valid file of its own language."""

from collections.abc import Iterable, Iterator
from pathlib import Path

import pytest

import twinform
from tests.corpus.files import CorpusFile, chunks
from twinform.compiler.emitting import emit
from twinform.diagnostics import Notes
from twinform.ir import Document, Link, Model
from twinform.ir.frames import WORLD
from twinform.passes import Pass, Pipeline
from twinform.passes.plugins.add_plugin import AddPlugin
from twinform.passes.plugins.add_sensor import AddSensor
from twinform.passes.plugins.bridge import bridges
from twinform.passes.plugins.check_plugins import CheckPlugins
from twinform.passes.plugins.sites import plugins_of, sensors_of

CHUNKS = chunks()


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
        CheckPlugins().run(document, Notes())
        found = first_link(document)
        if found is not None:
            problem = added(document, *found)
            if problem:
                yield file.name, problem


def first_link(document: Document) -> tuple[Model, Link] | None:
    """A link to put sensors on, in a model whose name says which it is."""
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
    notes = Notes()
    made = pipeline.run(document, notes)
    bridges(made, "harmonic", notes, "w")
    if notes.has_errors:
        return "; ".join(each.message for each in notes.diagnostics if each.is_error)
    if len(sensors_of(made)) != len(sensors_of(document)) + len(steps):
        return "the sensors are not there"
    if not any("pose-publisher" in (plugin.filename or "") for plugin, _ in plugins_of(made)):
        return "the plugin is not there"
    if pipeline.run(made, Notes()) != made:
        return "adding twice is not adding once"
    found = Notes()
    emit(made, found, fit=True)
    return "; ".join(each.message for each in found.diagnostics if each.is_error)
