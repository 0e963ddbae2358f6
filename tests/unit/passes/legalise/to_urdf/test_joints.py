"""Joints and masses: their types, axes and limits, and the loops that are cut."""

import pytest

from .models import LINK, arm, convert, joint, link, lower, read, values_at


@pytest.mark.parametrize(
    ("text", "path", "expected"),
    [
        # inertials: SDF's defaults are written
        (LINK, "//mass/@value | //inertia/@*", ["1", "1", "0", "0", "1", "0", "1"]),
        (LINK, "//inertial/tf:*", []),
        (
            link("<inertial><mass>2</mass><inertia><ixx>3</ixx></inertia></inertial>"),
            "//mass/@value | //inertia/@*",
            ["2", "3", "0", "0", "1", "0", "1"],
        ),
        # joints
        (
            arm("revolute", "<axis><limit><lower>0</lower><upper>1</upper></limit></axis>"),
            "//joint/@type",
            ["revolute"],
        ),
        (arm("revolute", "<axis><limit><lower>0</lower><upper>1</upper></limit></axis>"), "//limit/@effort", ["1e+16"]),
        (arm("revolute", "<axis><limit><upper>1</upper></limit></axis>"), "//limit/@lower", ["-1e+16"]),
        (arm("revolute", "<axis><limit><stiffness>350</stiffness></limit></axis>"), "//joint/limit", []),
        (arm("revolute"), "//joint/@type", ["continuous"]),
        (arm("revolute"), "//joint/axis/@xyz", ["0 0 1"]),
        (arm("revolute"), "//limit", []),
        (
            arm("revolute", "<axis><limit><lower>-1e16</lower><upper>inf</upper></limit></axis>"),
            "//joint/@type",
            ["continuous"],
        ),
        (arm("revolute", "<axis><limit><effort>3</effort></limit></axis>"), "//limit/@*", ["3", "1e+16"]),
        (arm("prismatic"), "//limit/@*", ["-1e+16", "1e+16", "1e+16", "1e+16"]),
        (arm("fixed", "<axis><xyz>1 0 0</xyz></axis>"), "//joint/axis", []),
        (
            arm(
                "revolute",
                "<axis><mimic joint='j'><multiplier>2</multiplier><offset>1</offset><reference>3</reference>"
                "</mimic></axis>",
            ),
            "//mimic/@*",
            ["j", "2", "-5"],
        ),
        # axes in other frames; z of the model is x of a joint that is turned by 90 degrees about y
        (
            LINK
            + "<link name='b'><pose degrees='true'>0 0 0 0 90 0</pose></link>"
            + joint("revolute", "<axis><xyz expressed_in='a'>0 0 -2</xyz></axis>"),
            "//joint/axis/@xyz",
            ["2 0 -1.2246467991473532e-16"],
        ),
    ],
)
def test_a_part_of_sdf_is_expressed_in_urdf(text: str, path: str, expected: list[str]) -> None:
    assert values_at(convert(text), path) == expected


@pytest.mark.parametrize(
    ("version", "axis", "expected"),
    [
        ("1.4", "", "-1 0 0"),
        ("1.5", "", "0 0 1"),
        ("1.6", "<use_parent_model_frame>true</use_parent_model_frame>", "-1 0 0"),
        ("1.6", "<use_parent_model_frame>false</use_parent_model_frame>", "0 0 1"),
    ],
)
def test_an_axis_means_what_its_version_specifies(version: str, axis: str, expected: str) -> None:
    turned = "<link name='b'><pose>0 0 0 0 1.5707963267948966 0</pose></link>"
    root = convert(LINK + turned + joint("revolute", f"<axis><xyz>0 0 1</xyz>{axis}</axis>"), version)
    numbers = [round(float(number), 12) + 0.0 for number in values_at(root, "//joint/axis/@xyz")[0].split()]
    assert numbers == [float(number) + 0.0 for number in expected.split()]


def test_a_loop_is_cut_and_closed_again_for_gazebo() -> None:
    closing = joint("revolute", "<pose relative_to='a'>0 0 1 0 0 0</pose><axis><xyz>1 0 0</xyz></axis>", "k", "a", "c")
    text = (
        LINK + "<link name='b'/><link name='c'/>" + joint("revolute") + joint("revolute", "", "i", "b", "c") + closing
    )
    root, sink = lower(read(text))
    assert values_at(root, "/robot/joint/@name") == ["j", "i"]
    assert values_at(root, "/robot/gazebo/joint/*[self::parent or self::child or self::pose]/text()") == [
        "0 0 1 0 0 0",
        "a",
        "c",
    ]
    assert [each.rule.name for each in sink.diagnostics] == ["cut-loop"]
