"""Static models in a model, once the URDF was edited, and as older versions wrote it."""

from pathlib import Path

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


_POST = "<static>{}</static><link name='post'/>"
_INCLUDED = "<include><uri>model://in</uri>{}</include>"


@pytest.mark.parametrize("version", ["1.4", "1.5", "1.6", "1.11"])
@pytest.mark.parametrize(
    ("inside", "included"),
    [
        (f"<model name='in'>{_POST.format('true')}</model>", ""),
        (_INCLUDED.format("<static>true</static>"), "false"),
        (_INCLUDED.format(""), "true"),
    ],
)
def test_a_static_model_in_a_model_is_held_in_every_version(
    version: str, inside: str, included: str, tmp_path: Path
) -> None:
    (tmp_path / "in").mkdir()
    (tmp_path / "in/model.config").write_text("<model><name>in</name><sdf version='1.4'>model.sdf</sdf></model>")
    post = _POST.format(included or "false")
    (tmp_path / "in/model.sdf").write_text(f"<sdf version='1.4'><model name='in'>{post}</model></sdf>")
    model = tmp_path / "model.sdf"
    model.write_text(f"<sdf version='{version}'><model name='m'><link name='door'/>{inside}</model></sdf>")
    made = twinform.convert(model, to="urdf", expand_includes=True, paths=[tmp_path])
    ends = {joint.child: (joint.type, joint.parent) for joint in made.document.models[0].joints}
    assert (ends["in__post"], ends["door"]) == (("fixed", "world"), ("floating", "world"))
