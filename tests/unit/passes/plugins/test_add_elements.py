"""What is reported where there is nothing to add to: all of each finding."""

from collections.abc import Callable

import pytest

import twinform
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Document, Model, World
from twinform.passes.plugins.add_elements import find_model, find_world, world_of

ONE = (
    '<sdf version="1.11">\n<model name="arm"><link name="l"/><model name="hand"><link name="l"/></model></model></sdf>'
)
TWO = """<sdf version="1.11"><world name="day">
<model name="arm"><link name="l"/><model name="hand"><link name="l"/></model></model><model name="leg"><link name="l"/>
</model></world><world name="dusk"/></sdf>"""
WORLDS = '<sdf version="1.11"><world name="day"/></sdf>'

Finding = tuple[str, str | None, str | None]
"""The message, what was found, the help."""


def findings(sink: DiagnosticSink) -> list[Finding]:
    assert {(each.rule.name, each.location.line, each.location.path) for each in sink.diagnostics} <= {
        ("nothing-to-add-to", 1, "/sdf")
    }
    return [(each.message, each.found, each.help) for each in sink.diagnostics]


@pytest.mark.parametrize(
    ("find", "text", "name", "found", "expected"),
    [
        (find_model, ONE, None, "arm", None),
        (find_model, ONE, "arm", "arm", None),
        (find_model, ONE, "arm::hand", "hand", None),
        (find_model, TWO, "leg", "leg", None),
        (
            find_model,
            TWO,
            None,
            None,
            ("it is not clear which model to add to: there are several: arm, arm::hand, leg", None, None),
        ),
        (find_model, WORLDS, None, None, ("it is not clear which model to add to: there is none", None, None)),
        (find_model, WORLDS, "arm", None, ("there is no model 'arm' to add to", "arm", None)),
        (find_model, TWO, "lag", None, ("there is no model 'lag' to add to", "lag", "did you mean leg?")),
        (find_model, TWO, "xyz", None, ("there is no model 'xyz' to add to", "xyz", "there are arm, arm::hand, leg")),
        (find_world, WORLDS, None, "day", None),
        (find_world, WORLDS, "day", "day", None),
        (find_world, TWO, "dusk", "dusk", None),
        (
            find_world,
            TWO,
            None,
            None,
            ("it is not clear which world to add to: there are several: day, dusk", None, None),
        ),
        (find_world, ONE, None, None, ("it is not clear which world to add to: there is none", None, None)),
        (find_world, TWO, "dask", None, ("there is no world 'dask' to add to", "dask", "did you mean dusk?")),
        (find_world, TWO, "xyz", None, ("there is no world 'xyz' to add to", "xyz", "there are day, dusk")),
    ],
)
def test_a_model_or_world_is_found_or_why_not_is_reported(
    find: Callable[[Document, str | None, DiagnosticSink], Model | World | None],
    text: str,
    name: str | None,
    found: str | None,
    expected: Finding | None,
) -> None:
    sink = DiagnosticSink()
    part = find(twinform.loads(text), name, sink)
    assert (part.name if part else None) == found
    assert findings(sink) == ([expected] if expected else [])


def test_a_model_is_in_the_world_around_it_however_deep() -> None:
    made = twinform.loads(TWO)
    arm = made.worlds[0].models[0]
    assert world_of(made, arm.models[0]) is made.worlds[0]
    assert world_of(made, arm) is made.worlds[0]
    assert world_of(made, arm.model_copy()) is None
