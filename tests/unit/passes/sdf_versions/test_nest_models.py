"""Nested models out of names like `arm::hand`."""

from math import pi

import pytest

import twinform
from tests.unit.passes.reported import entries
from twinform.ir import Joint, Model, Pose

BASE = f'<link name="base"><pose>0 0 0 0 0 {pi / 2}</pose></link>\n'
LINKS = '<link name="arm::up"/>\n<link name="arm::fore"><pose>1 0 0 0 0 0</pose></link>\n'
OWN = '<frame name="arm::__model__" attached_to="arm::up"><pose relative_to="base">0 2 0 0 0 0</pose></frame>\n'


def joint(axes: str = "", parent: str = "arm::up", pose: str = "") -> str:
    ends = f"<parent>{parent}</parent><child>arm::fore</child>"
    return f'<joint name="arm::j" type="universal">{pose}{ends}{axes}</joint>\n'


def nested(inside: str) -> twinform.Conversion:
    text = f'<sdf version="1.7"><model name="m">\n{inside}</model></sdf>'
    return twinform.convert(text.encode(), to="sdf", sdf_version="1.8")


def only(models: tuple[Model, ...]) -> Model:
    assert len(models) == 1
    return models[0]


def inner(made: twinform.Conversion) -> Model:
    return only(only(made.document.models).models)


@pytest.mark.parametrize(
    ("frame", "own", "expected", "kept"),
    [
        ("base", "", (0, 1, 0), None),
        ("base", OWN, (0, 1, 0), None),
        ("arm::up", "", (1, 0, 0), "up"),
        ("__model__", "", (1, 0, 0), "__model__"),
        ("__model__", OWN, (1, 0, 0), None),
    ],
)
@pytest.mark.parametrize("field", ["axis", "axis2"])
def test_an_axis_keeps_its_direction(
    field: str, frame: str, own: str, expected: tuple[float, float, float], kept: str | None
) -> None:
    axes = f'<{field}><xyz expressed_in="{frame}">1 0 0</xyz></{field}>'
    found: Joint = inner(nested(BASE + LINKS + own + joint(axes))).joints[0]
    axis = getattr(found, field)
    assert axis.expressed_in == kept
    assert axis.xyz == pytest.approx(expected, abs=1e-15)
    assert (found.name, found.parent, found.child) == ("j", "up", "fore")


def test_an_axis_that_is_not_written_is_turned_as_the_default_is() -> None:
    found = inner(nested(BASE + LINKS + joint('<axis><xyz expressed_in="base">0 0 1</xyz></axis>'))).joints[0]
    assert found.axis
    assert found.axis.xyz == (0, 0, 1)
    assert found.axis2 is None


def test_what_is_inside_names_what_is_inside() -> None:
    made = nested(BASE + LINKS + joint(pose='<pose relative_to="arm::up">0 0 1 0 0 0</pose>'))
    model = inner(made)
    assert [link.name for link in model.links] == ["up", "fore"]
    assert model.joints[0].pose == Pose(xyz=(0, 0, 1), rpy=(0, 0, 0), relative_to="up")
    message = "2 links, 1 joints and 0 frames of model 'm' are in its nested model 'arm'"
    assert entries(made) == [("other-words", 3, "/sdf/model[@name='m']/link[@name='arm::up']", message, 0)]


def test_a_pose_in_a_frame_outside_becomes_one_inside() -> None:
    found = inner(nested(BASE + LINKS + joint(pose='<pose relative_to="base">0 0 1 0 0 0</pose>'))).joints[0]
    assert found.pose
    assert found.pose.relative_to is None
    assert found.pose.xyz == pytest.approx((-1, 0, 1))


def test_a_joint_to_a_link_outside_stays_there_by_another_name() -> None:
    made = nested(BASE + LINKS + joint(parent="base"))
    outer = only(made.document.models)
    assert [(each.name, each.parent, each.child) for each in outer.joints] == [("arm_j", "base", "arm::fore")]
    assert inner(made).joints == ()
    assert [link.name for link in outer.links] == ["base"]


def test_the_frame_of_the_model_places_it() -> None:
    model = inner(nested(BASE + LINKS + OWN))
    assert model.canonical_link == "up"
    assert model.pose == Pose(xyz=(0, 2, 0), rpy=(0, 0, 0), relative_to="base")
    assert [link.pose.xyz if link.pose else None for link in model.links] == [
        pytest.approx((0, -2, 0)),
        pytest.approx((0, -3, 0)),
    ]


KNUCKLE = '<link name="k"/></model>\n'


@pytest.mark.parametrize("own", ["", OWN])
@pytest.mark.parametrize(
    ("pose", "expected", "in_own"),
    [
        ("", None, Pose(xyz=(0, -2, 0), rpy=(0, 0, -pi / 2))),
        ("<pose>1 0 0 0 0 0</pose>", Pose(xyz=(1, 0, 0), rpy=(0, 0, 0)), Pose(xyz=(0, -3, 0), rpy=(0, 0, -pi / 2))),
        ('<pose relative_to="base">1 0 0 0 0 0</pose>', Pose(xyz=(0, 1, 0), rpy=(0, 0, pi / 2)), Pose(xyz=(1, -2, 0))),
        (
            '<pose relative_to="arm::fore">1 0 0 0 0 0</pose>',
            Pose(xyz=(1, 0, 0), rpy=(0, 0, 0), relative_to="fore"),
            Pose(xyz=(1, 0, 0), rpy=(0, 0, 0), relative_to="fore"),
        ),
    ],
)
def test_a_nested_model_stays_where_it_is(own: str, pose: str, expected: Pose | None, in_own: Pose) -> None:
    model = only(inner(nested(BASE + LINKS + own + f'<model name="arm::hand">{pose}{KNUCKLE}')).models)
    wanted = in_own if own else expected
    assert (model.name, [link.name for link in model.links]) == ("hand", ["k"])
    assert (model.pose is None) == (wanted is None)
    if model.pose and wanted:
        assert model.pose.xyz == pytest.approx(wanted.xyz)
        assert (model.pose.rpy or (0, 0, 0)) == pytest.approx(wanted.rpy or (0, 0, 0))
        assert model.pose.relative_to == wanted.relative_to
