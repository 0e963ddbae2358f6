"""Where things are: poses, frames, worlds and models in models."""

import pytest

import twinform

from .models import BOX, INNER, LINK, convert, joint, link, values_at, visual


@pytest.mark.parametrize(
    ("text", "path", "expected"),
    [
        # poses
        (link("<pose>1 2 3 0 0 0</pose>"), "//gazebo/pose/text()", ["1 2 3 0 0 0"]),
        (
            LINK + link("<pose>0.1 0.2 0.3 0 0 0.4</pose>", "b") + joint("fixed"),
            "//joint/origin/@*",
            ["0.1 0.2 0.3", "0 0 0.4"],
        ),
        (
            LINK
            + link("<pose>1 0 0 0 0 0</pose>" + visual("<pose>0 0 5 0 0 0</pose>" + BOX), "b")
            + joint("fixed", "<pose>0 0 1 0 0 0</pose>"),
            "//joint/origin/@xyz | //visual/origin/@xyz",
            ["0 0 4", "1 0 1"],
        ),
        (link(visual("<pose degrees='true'>0 0 0 180 0 0</pose>" + BOX)), "//origin/@rpy", ["3.141592653589793 0 0"]),
        # frames
        (LINK + "<frame name='f' attached_to='a'><pose>1 0 0 0 0 0</pose></frame>", "//joint/origin/@xyz", ["1 0 0"]),
        (LINK + "<frame name='f'/>", "//joint/@name | //link[@name='f']/*[not(self::tf:frame)]", ["f_joint"]),
        (
            LINK + "<frame name='f'/><joint name='f_joint' type='fixed'><parent>world</parent><child>a</child></joint>",
            "//joint/@name",
            ["f_joint", "f_joint_1"],
        ),
        # worlds and roots
        (LINK + joint("fixed", parent="world", child="a"), "//link/@name", ["world", "a"]),
        (
            LINK + "<link name='b'/>",
            "//joint/@type | //joint/parent/@link | //joint/child/@link",
            ["floating", "a", "b"],
        ),
        (
            "<static>1</static><link name='a'><pose>1 0 0 0 0 0</pose></link>",
            "//joint/@type | //parent/@link | //joint/origin/@xyz",
            ["fixed", "world", "1 0 0"],
        ),
    ],
)
def test_a_part_of_sdf_is_expressed_in_urdf(text: str, path: str, expected: list[str]) -> None:
    assert values_at(convert(text), path) == expected


def test_the_frame_of_an_older_pose_is_honored_and_carried_as_it_was() -> None:
    text = link("<pose>1 0 0 0 0 0</pose>") + link("<pose frame='a'>1 0 0 0 0 0</pose>", "b") + joint("fixed")
    root = convert(text, "1.6")
    assert values_at(root, "//joint/origin/@xyz | //link[@name='b']/tf:pose/@*") == ["a", "1 0 0"]


def test_nested_models_come_up_with_names_of_their_scope() -> None:
    root = convert(LINK + INNER + "<joint name='o' type='fixed'><parent>a</parent><child>inner::l</child></joint>")
    assert values_at(root, "/robot/link/@name") == ["a", "inner__l", "inner__k", "inner", "inner__f"]
    assert values_at(root, "/robot/joint[@name='inner__j']/*/@link") == ["inner__l", "inner__k"]
    assert values_at(root, "/robot/joint[@name='o']/origin/@xyz") == ["0 0 1"]
    assert values_at(root, "/robot/joint[child/@link='inner__f']/parent/@link") == ["inner__k"]
    assert values_at(root, "//link[@name='inner']/tf:nested/static/text()") == ["false"]
    annotations = values_at(root, "//tf:scoped-name/text()")
    assert annotations == ["inner::l", "inner::k", "inner::f", "inner::j"]
    assert values_at(root, "//tf:scoped-name/@instead_of") == [name.replace("::", "__") for name in annotations]


def test_joints_between_frames_connect_their_links() -> None:
    frames = "<frame name='f' attached_to='a'/><frame name='g' attached_to='b'><pose>0 0 1 0 0 0</pose></frame>"
    text = LINK + "<link name='b'/>" + frames + joint("fixed", parent="f", child="g")
    root = convert(text)
    assert values_at(root, "/robot/joint[@name='j']/*/@link") == ["a", "b"]
    assert values_at(root, "/robot/joint[@name='j']/origin/@xyz") == ["0 0 1"]
    assert values_at(root, "/robot/joint[@name='j']/tf:ends/@*") == ["f", "g"]


def test_a_link_that_is_posed_by_the_joint_that_is_cut_stays_where_it_is() -> None:
    text = (
        "<sdf version='1.11'><model name='m'><link name='a'/><link name='b'><pose relative_to='cut'/></link>"
        "<joint name='kept' type='revolute'><parent>a</parent><child>b</child></joint>"
        "<joint name='cut' type='fixed'><pose relative_to='a'>1 0 0 0 0 0</pose><parent>a</parent><child>b</child>"
        "</joint></model></sdf>"
    )
    joint = next(each for each in twinform.convert(text.encode(), to="urdf").document.models[0].joints)
    assert joint.name == "kept"
    assert joint.pose
    assert joint.pose.xyz == (1.0, 0.0, 0.0)


def test_a_carried_shape_is_where_the_link_has_moved_to() -> None:
    shape = visual("<geometry><plane/></geometry>")
    text = LINK + link(shape, "b") + joint("fixed", "<pose>0 0 0.5 0 0 0</pose>")
    assert values_at(convert(text), "//tf:sdf/visual/pose/text()") == ["0 0 -0.5 0 0 0"]
