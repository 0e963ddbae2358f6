"""Changes of the physics: what is listed is what was changed, whatever pass changed it."""

from typing import cast

from hypothesis import given
from hypothesis import strategies as st

from testbed.ledger_changes import applied
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Document, Joint, Link, walk
from twinform.passes import parse_pipeline
from twinform.profiles.remedies import of_ledger, physics_changes
from twinform.testing.strategies import robots, sdf_models

_PIPELINES = (
    "split-massless",
    "balance-inertia{thickness=0.01}",
    "fill-limits{effort=3 velocity=2 damping=0.5}",
    "tighten-limits{margin=0.01}",
    "fill-inertia{replace=all density=10}",
)


_NO_PHYSICS = {"visuals", "sensors", "lights", "opaque", "plugins"}


def _physics(document: Document) -> list[object]:
    """All that engines compute with; a node in which nothing is written is the same as none."""
    parts = (node for node in walk(document) if isinstance(node, (Link, Joint)))
    return [_pruned(part.model_dump(exclude_none=True, exclude=_NO_PHYSICS)) for part in parts]


def _pruned(value: object) -> object:
    if isinstance(value, dict):
        inner = {key: _pruned(each) for key, each in cast("dict[str, object]", value).items()}
        return {key: each for key, each in inner.items() if each not in ({}, ())}
    return tuple(map(_pruned, cast("tuple[object, ...]", value))) if isinstance(value, tuple) else value


@given(document=st.one_of(robots(), sdf_models()), pipeline=st.sampled_from(_PIPELINES))
def test_the_listed_changes_make_the_physics_of_the_result(document: Document, pipeline: str) -> None:
    result = parse_pipeline(pipeline).run(document, DiagnosticSink())
    changes = of_ledger(physics_changes(document, result, pipeline))
    assert _physics(applied(document, changes)) == _physics(result)


@given(document=st.one_of(robots(), sdf_models()))
def test_a_pass_that_changes_nothing_lists_nothing(document: Document) -> None:
    assert not list(physics_changes(document, document.copy(), "none"))
