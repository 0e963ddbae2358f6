"""Worlds whose parts name nothing inside of models, so that the models can go into other files."""

import pytest

import twinform
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Pose, World, rewrite
from twinform.passes.includes import detach

MODELS = """<model name="m"><pose>5 0 0 0 0 0</pose><link name="a"/><link name="b"><pose>0 1 0 0 0 0</pose></link>
<frame name="f" attached_to="b"><pose>0 0 2 0 0 0</pose></frame></model>
<model name="n">{}<link name="c"/></model>"""
WORLD = '<sdf version="1.11"><world name="w">{}{}</world></sdf>'


def world(inside: str, pose: str = "") -> str:
    return WORLD.format(MODELS.format(pose), inside)


def joint(parent: str, child: str, pose: str = "") -> str:
    return f'<joint name="j" type="fixed"><parent>{parent}</parent><child>{child}</child>{pose}</joint>'


def frame(attached: str, pose: str = "") -> str:
    return f'<frame name="g" attached_to="{attached}">{pose}</frame>'


def light(pose: str) -> str:
    return f'<light name="l" type="point">{pose}</light>'


def without_zeros(world: World) -> World:
    """The world as one writes it who leaves out what is zero."""

    def short(pose: Pose) -> Pose:
        return pose.copy(**{name: None for name in ("xyz", "rpy") if getattr(pose, name) == (0, 0, 0)})

    return rewrite(world, Pose, short)


def detached(world: World, sink: DiagnosticSink) -> World:
    """The world with models that keep their own frames."""
    return detach(world, {model.name: model.name for model in world.models}, sink)


@pytest.mark.parametrize(
    ("before", "after"),
    [
        (joint("world", "m"), joint("world", "m")),
        (joint("m", "n", "<pose>1 0 0 0 0 0</pose>"), joint("m", "n", "<pose>1 0 0 0 0 0</pose>")),
        (joint("m::f", "n"), joint("m::b", "n")),
        (joint("n", "m::f"), joint("n", "m::b", '<pose relative_to="m">0 1 2 0 0 0</pose>')),
        (joint("world", "m::a"), joint("world", "m::a", '<pose relative_to="m">0 0 0 0 0 0</pose>')),
        (
            joint("m::f", "n::c", "<pose>1 0 0 0 0 0</pose>"),
            joint("m::b", "n::c", '<pose relative_to="n">1 0 0 0 0 0</pose>'),
        ),
        (
            joint("world", "m::f", '<pose relative_to="n">1 0 0 0 0 0</pose>'),
            joint("world", "m::b", '<pose relative_to="n">1 0 0 0 0 0</pose>'),
        ),
        (
            joint("world", "n", '<pose relative_to="m::f">1 0 0 0 0 0</pose>'),
            joint("world", "n", '<pose relative_to="m">1 1 2 0 0 0</pose>'),
        ),
        (frame("m", "<pose>1 0 0 0 0 0</pose>"), frame("m", "<pose>1 0 0 0 0 0</pose>")),
        (frame("m::f"), frame("m::b", '<pose relative_to="m">0 1 2 0 0 0</pose>')),
        (
            frame("m::f", "<pose>1 0 0 0 0 0</pose>"),
            frame("m::b", '<pose relative_to="m">1 1 2 0 0 0</pose>'),
        ),
        (
            frame("n", '<pose relative_to="m::b">1 0 0 0 0 0</pose>'),
            frame("n", '<pose relative_to="m">1 1 0 0 0 0</pose>'),
        ),
        (light("<pose>1 0 0 0 0 0</pose>"), light("<pose>1 0 0 0 0 0</pose>")),
        (
            light('<pose relative_to="m::f">1 0 0 0 0 0</pose>'),
            light('<pose relative_to="m">1 1 2 0 0 0</pose>'),
        ),
    ],
)
def test_what_names_a_part_of_a_model_names_the_model(before: str, after: str) -> None:
    sink = DiagnosticSink()
    made = detached(twinform.loads(world(before)).worlds[0], sink)
    assert without_zeros(made) == without_zeros(twinform.loads(world(after)).worlds[0])
    assert sink.diagnostics == []


@pytest.mark.parametrize(
    ("pose", "expected"),
    [
        ('<pose relative_to="m::f">1 0 0 0 0 0</pose>', '<pose relative_to="m">1 1 2 0 0 0</pose>'),
        ('<pose relative_to="m">1 0 0 0 0 0</pose>', '<pose relative_to="m">1 0 0 0 0 0</pose>'),
        ("<pose>1 0 0 0 0 0</pose>", "<pose>1 0 0 0 0 0</pose>"),
    ],
)
def test_a_model_is_placed_by_whole_models(pose: str, expected: str) -> None:
    made = detached(twinform.loads(world("", pose)).worlds[0], DiagnosticSink())
    assert without_zeros(made) == without_zeros(twinform.loads(world("", expected)).worlds[0])


def test_a_world_whose_frames_are_not_known_stays_as_it_is() -> None:
    good = twinform.loads(world(light('<pose relative_to="m::f">1 0 0 0 0 0</pose>'))).worlds[0]
    models = (good.models[0].copy(frames=()), good.models[1])
    bad = good.copy(models=models)
    sink = DiagnosticSink()
    assert detached(bad, sink) is bad
    assert [(each.rule.name, each.message, each.found) for each in sink.diagnostics] == [
        ("dangling-frame", "there is no frame 'm::f'", "m::f")
    ]
