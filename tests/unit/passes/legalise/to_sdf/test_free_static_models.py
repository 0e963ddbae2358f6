"""Static models in a model, once the URDF was edited, and as older versions wrote it."""

import pytest

import twinform
from twinform.ir import Model

_SDF = b"""<sdf version="1.9"><model name="m"><link name="door"/>
<model name="in"><static>true</static><pose>1 0 0 0 0 0</pose><link name="post"/><link name="top"/>
<joint name="nail" type="fixed"><parent>post</parent><child>top</child></joint></model></model></sdf>"""
_WELD = '<joint name="in__post_fixed_joint" type="fixed">'


def _inner(urdf: str) -> tuple[Model, set[str]]:
    made = twinform.convert(urdf.encode(), to="sdf", sdf_version="1.9")
    return made.document.models[0].models[0], {each.rule.name for each in made.diagnostics}


def test_what_the_urdf_holds_is_static_again() -> None:
    inner, said = _inner(twinform.convert(_SDF, to="urdf").text)
    assert (inner.static, [joint.name for joint in inner.joints], "stale-carrier" in said) == (True, ["nail"], False)


@pytest.mark.parametrize("type", ["floating", "continuous"])
def test_what_the_urdf_lets_move_is_not_static(type: str) -> None:
    urdf = twinform.convert(_SDF, to="urdf").text
    assert _WELD in urdf
    inner, said = _inner(urdf.replace(_WELD, _WELD.replace('fixed">', f'{type}">')))
    assert (inner.static, "stale-carrier" in said) == (None, True)


def test_diff_sees_that_it_falls() -> None:
    urdf = twinform.convert(_SDF, to="urdf").text
    falling = urdf.replace(_WELD, _WELD.replace('fixed">', 'floating">'))
    assert twinform.diff(_SDF, urdf.encode(), carriers=True).same
    assert not twinform.diff(_SDF, falling.encode(), carriers=True).same
