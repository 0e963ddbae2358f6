"""Passes over generated models: what comes out is valid, and running a pass again changes nothing."""

import pytest
from hypothesis import given

import twinform
from tests.profile import examples
from twinform.compiler.output.emitting import emit
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Document
from twinform.ir.verify import verify
from twinform.passes import parse_pipeline
from twinform.testing import strategies

_SETTINGS = examples(0.7)
_PIPELINES = (
    "check-inertia",
    "fill-inertia{shapes=either}",
    "balance-inertia",
    "split-massless{ends=fix}",
    "check-limits",
    "fill-limits{effort=1 velocity=2 lower=-1 upper=1 damping=0.1 friction=0.2}",
    "tighten-limits",
    "set-surface{mu=0.5 slip1=0.1 restitution=0.5}",
    "materials{pbr=true}",
    "rewrite-uris{to=model}",
    'drop{visuals="*" sensors="*"}',
)


def _judge(pipeline: str, document: Document) -> None:
    once = parse_pipeline(pipeline).run(document, DiagnosticSink(), verify=verify)
    assert parse_pipeline(pipeline).run(once, DiagnosticSink()) == once
    if once is not document:
        sink = DiagnosticSink()
        text = emit(once, sink)
        assert sink.diagnostics == []
        assert twinform.loads(text) == once


@pytest.mark.parametrize("pipeline", _PIPELINES)
def test_robots_stay_valid(pipeline: str) -> None:
    @_SETTINGS
    @given(strategies.robots())
    def judge(robot: Document) -> None:
        _judge(pipeline, robot)

    judge()


@pytest.mark.parametrize("pipeline", _PIPELINES)
def test_models_of_sdf_stay_valid(pipeline: str) -> None:
    @_SETTINGS
    @given(strategies.sdf_models())
    def judge(model: Document) -> None:
        _judge(pipeline, model)

    judge()
