"""What is said where there is nothing to add to: all of each finding."""

import pytest

import twinform
from twinform.diagnostics import Notes
from twinform.passes.plugins.targets import find_model, find_world, world_of

ONE = (
    '<sdf version="1.11">\n<model name="arm"><link name="l"/><model name="hand"><link name="l"/></model></model></sdf>'
)
TWO = """<sdf version="1.11"><world name="day">
<model name="arm"><link name="l"/><model name="hand"><link name="l"/></model></model><model name="leg"><link name="l"/>
</model></world><world name="dusk"/></sdf>"""
WORLDS = '<sdf version="1.11"><world name="day"/></sdf>'

Said = tuple[str, str | None, str | None]
"""The message, what was found, the help."""


def said(notes: Notes) -> list[Said]:
    assert {(each.rule.name, each.location.line, each.location.path) for each in notes.diagnostics} <= {
        ("nothing-to-add-to", 1, "/sdf")
    }
    return [(each.message, each.found, each.help) for each in notes.diagnostics]


@pytest.mark.parametrize(
    ("text", "name", "found", "expected"),
    [
        (ONE, None, "arm", None),
        (ONE, "arm", "arm", None),
        (ONE, "arm::hand", "hand", None),
        (TWO, "leg", "leg", None),
        (TWO, None, None, ("which model to add to? there are several: arm, arm::hand, leg", None, None)),
        (WORLDS, None, None, ("which model to add to? there is none", None, None)),
        (WORLDS, "arm", None, ("there is no model 'arm' to add to", "arm", None)),
        (TWO, "lag", None, ("there is no model 'lag' to add to", "lag", "did you mean leg?")),
        (TWO, "xyz", None, ("there is no model 'xyz' to add to", "xyz", "there are arm, arm::hand, leg")),
    ],
)
def test_a_model_is_found_or_why_not_is_said(
    text: str, name: str | None, found: str | None, expected: Said | None
) -> None:
    notes = Notes()
    model = find_model(twinform.loads(text), name, notes)
    assert (model.name if model else None) == found
    assert said(notes) == ([expected] if expected else [])


@pytest.mark.parametrize(
    ("text", "name", "found", "expected"),
    [
        (WORLDS, None, "day", None),
        (WORLDS, "day", "day", None),
        (TWO, "dusk", "dusk", None),
        (TWO, None, None, ("which world to add to? there are several: day, dusk", None, None)),
        (ONE, None, None, ("which world to add to? there is none", None, None)),
        (TWO, "dask", None, ("there is no world 'dask' to add to", "dask", "did you mean dusk?")),
        (TWO, "xyz", None, ("there is no world 'xyz' to add to", "xyz", "there are day, dusk")),
    ],
)
def test_a_world_is_found_or_why_not_is_said(
    text: str, name: str | None, found: str | None, expected: Said | None
) -> None:
    notes = Notes()
    world = find_world(twinform.loads(text), name, notes)
    assert (world.name if world else None) == found
    assert said(notes) == ([expected] if expected else [])


def test_a_model_is_in_the_world_around_it_however_deep() -> None:
    made = twinform.loads(TWO)
    arm = made.worlds[0].models[0]
    assert world_of(made, arm.models[0]) is made.worlds[0]
    assert world_of(made, arm) is made.worlds[0]
    assert world_of(made, arm.model_copy()) is None
