"""What is said where the mass of a geom cannot be computed."""

from importlib.util import find_spec

import pytest

import twinform
from twinform.compiler.input.mjcf import geom_solids

_CORNERS = 'vertex="0 0 0 1 0 0 0 1 0 0 0 1"'
_FACES = 'face="0 2 1 0 1 3 0 3 2 1 2 3"'
_TEXT = """<mujoco>
  <asset><mesh name="m" {}/></asset>
  <worldbody>
    <body name="b"><freejoint/><geom type="mesh" mesh="m"/><geom type="box" mesh="m"/></body>
  </worldbody>
</mujoco>"""


@pytest.mark.parametrize(
    ("mesh", "expected"),
    [
        (_CORNERS, ["the mesh 'm' counts for no mass: scipy, which measures its vertices, is not installed"]),
        (f"{_CORNERS} {_FACES}", []),
        (
            f'{_CORNERS} {_FACES} inertia="convex"',
            ["the mesh 'm' counts for no mass: scipy, which measures its vertices, is not installed"],
        ),
    ],
)
def test_vertices_whose_hull_nothing_makes_are_reported(
    mesh: str, expected: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(geom_solids, "find_spec", lambda name: None if name == "scipy" else find_spec(name))  # pyright: ignore[reportUnknownLambdaType, reportUnknownArgumentType] - of a patched function
    result = twinform.check(_TEXT.format(mesh).encode())
    assert [each.message for each in result.diagnostics] == expected
    assert [each.location.line for each in result.diagnostics] == [2] * len(expected)
