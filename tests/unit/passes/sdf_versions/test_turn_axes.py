"""Axes in the syntax of versions that have other frames for them."""

from math import pi

import pytest

import twinform
from tests.unit.passes.reported import entries
from twinform.ir import Axis, Joint
from twinform.passes.carriers.carriers import NAMESPACE

JOINT = "/sdf/model[@name='m']/joint[@name='j']"
MODEL = """<sdf version="{version}"><model name="m"><link name="a"/>
<link name="b"><pose>0 0 0 0 0 {yaw}</pose></link>
<joint name="j" type="universal"><parent>a</parent><child>b</child>
{axis}
<axis2><xyz>0 0 1</xyz></axis2></joint></model></sdf>"""


def rewritten(axis: str, source: str, version: str, yaw: float = 0.0) -> twinform.Conversion:
    text = MODEL.format(version=source, axis=axis, yaw=yaw)
    return twinform.convert(text.encode(), to="sdf", sdf_version=version)


def joint(made: twinform.Conversion) -> Joint:
    return made.document.models[0].joints[0]


@pytest.mark.parametrize(
    ("frame", "xyz", "version", "expected"),
    [
        ("", "1 0 0", "1.6", Axis(xyz=(1, 0, 0))),
        ("__model__", "1 0 0", "1.6", Axis(xyz=(1, 0, 0), use_parent_model_frame=True)),
        ("__model__", "1 0 0", "1.4", Axis(xyz=(1, 0, 0))),
        ("b", "1 0 0", "1.6", Axis(xyz=(1, 0, 0))),
        ("a", "1 0 0", "1.6", Axis(xyz=(0, -1, 0))),
        ("a", "1 0 0", "1.4", Axis(xyz=(1, 0, 0))),
        ("b", "1 0 0", "1.4", Axis(xyz=(0, 1, 0))),
        ("", "1 0 0", "1.4", Axis(xyz=(0, 1, 0))),
        ("", "0 0 1", "1.4", Axis(xyz=(0, 0, 1))),
    ],
)
def test_an_axis_points_where_it_did_in_the_frame_that_the_version_has(
    frame: str, xyz: str, version: str, expected: Axis
) -> None:
    written = f' expressed_in="{frame}"' if frame else ""
    made = joint(rewritten(f"<axis><xyz{written}>{xyz}</xyz></axis>", "1.11", version, pi / 2))
    assert made.axis
    assert made.axis.xyz == pytest.approx(expected.xyz, abs=1e-15)
    assert made.axis.copy(xyz=expected.xyz) == expected


@pytest.mark.parametrize(
    ("pose", "xyz"),
    [
        ("0 0 0 0 0 0", None),
        ("1 2 3 0 0 0", None),
        ("0 0 0 0 0 0.5", None),
        (f"0 0 0 {pi / 2} 0 0", (0.0, -1.0, 0.0)),
    ],
)
def test_an_axis_that_is_not_written_is_written_only_where_it_points_elsewhere(
    pose: str, xyz: tuple[float, float, float] | None
) -> None:
    source = MODEL.replace("0 0 0 0 0 {yaw}", pose)
    source = source.format(version="1.11", axis="<axis><limit><lower>-1</lower></limit></axis>")
    made = twinform.convert(source.encode(), to="sdf", sdf_version="1.4")
    axis = joint(made).axis
    assert axis
    assert axis.xyz == (None if xyz is None else pytest.approx(xyz, abs=1e-15))
    assert (axis.expressed_in, axis.use_parent_model_frame) == (None, None)
    again = twinform.convert(made.text.encode(), to="sdf", sdf_version="1.11").document
    assert again.models[0].joints[0].axis == twinform.loads(source).models[0].joints[0].axis


@pytest.mark.parametrize("word", ["1", "0"])
def test_the_name_for_the_frame_of_the_model_goes_where_there_is_none(word: str) -> None:
    text = f"<axis><xyz>1 0 0</xyz><use_parent_model_frame>{word}</use_parent_model_frame></axis>"
    made = joint(rewritten(text, "1.6", "1.4", pi / 2))
    assert made.axis
    assert made.axis.use_parent_model_frame is None
    assert made.axis.xyz == pytest.approx((1, 0, 0) if word == "1" else (0, 1, 0))


@pytest.mark.parametrize(
    ("source", "axis"),
    [
        ("1.11", '<axis><xyz expressed_in="__model__">1 0 0</xyz></axis>'),
        ("1.6", "<axis><xyz>1 0 0</xyz><use_parent_model_frame>1</use_parent_model_frame></axis>"),
    ],
)
@pytest.mark.parametrize("carriers", [True, False])
def test_an_axis_in_the_frame_that_the_oldest_versions_mean_loses_nothing(
    source: str, axis: str, *, carriers: bool
) -> None:
    text = MODEL.format(version=source, axis=axis, yaw=1)
    text = text.replace("<axis2><xyz>0 0 1</xyz></axis2>", "").replace("universal", "revolute")
    made = twinform.convert(text.encode(), to="sdf", sdf_version="1.4", carriers=carriers)
    assert joint(made).axis == Axis(xyz=(1, 0, 0))
    assert made.diagnostics == ()
    assert entries(made) == []
    assert NAMESPACE not in made.text


def test_the_ledger_has_which_axis_was_in_which_frame() -> None:
    made = rewritten('<axis><xyz expressed_in="a">1 0 0</xyz></axis>', "1.11", "1.4")
    assert entries(made) == [
        ("other-words", 4, f"{JOINT}/axis", "the axis of joint 'j' is expressed in a", 2),
        ("other-words", 5, f"{JOINT}/axis2", "the axis of joint 'j' is expressed in its own frame", 1),
    ]
