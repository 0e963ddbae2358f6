"""Merging models into what is around them."""

import pytest

from twinform.diagnostics import DiagnosticSink, Fate
from twinform.ir import Include, Model, Pose, World
from twinform.ir.transform import Transform
from twinform.passes.includes.merge import merge_into_model, merge_into_world

INNER = Include(uri="model://inner", pose=Pose(xyz=(0.0, 0.0, 1.0)))
OUTER = Include(uri="model://outer", merge=True, pose=Pose(xyz=(1.0, 0.0, 0.0)))


def merged(holder: Model | World, model: Model) -> Model | World:
    if isinstance(holder, Model):
        return merge_into_model(holder, OUTER, model, DiagnosticSink(), Transform())
    return merge_into_world(holder, OUTER, model, DiagnosticSink(), Transform())


@pytest.mark.parametrize("holder", [Model(name="around"), World(name="around")], ids=["into a model", "into a world"])
def test_an_include_that_was_not_read_stays_where_it_is(holder: Model | World) -> None:
    made = merged(holder, Model(name="outer", includes=(INNER,)))
    (frame,), (include,) = made.frames, made.includes
    assert frame.pose
    assert frame.pose.xyz == (1.0, 0.0, 0.0)
    assert include == INNER.copy(pose=Pose(xyz=(0.0, 0.0, 1.0), relative_to=frame.name))


def test_what_the_merged_model_has_as_a_whole_is_accounted_for() -> None:
    sink = DiagnosticSink()
    merge_into_model(Model(name="around"), OUTER, Model(name="outer", static=True), sink, Transform())
    words = "static of the merged model 'outer' is left out; that of the model around it is used"
    assert [(each.fate, each.rule.name, each.message) for each in sink.entries] == [
        (Fate.DROPPED, "merged-away", words)
    ]
