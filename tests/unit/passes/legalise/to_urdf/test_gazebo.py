"""What Gazebo reads in URDF: surfaces, plugins, sensors and the settings of links and joints."""

import pytest

from .models import BOX, COLLISION, LINK, arm, convert, joint, link, values_at, visual


@pytest.mark.parametrize(
    ("text", "path", "expected"),
    [
        # surfaces
        (
            link(COLLISION.format("c", "<surface><friction><ode><mu>2</mu></ode></friction></surface>")),
            "//gazebo[@reference='a']/mu1/text()",
            ["2"],
        ),
        (
            link(COLLISION.format("c", "<surface><friction><ode><slip1>2</slip1></ode></friction></surface>")),
            "//gazebo/collision/surface//slip1/text()",
            ["2"],
        ),
        (
            link(COLLISION.format("c", "<max_contacts>3</max_contacts>") + COLLISION.format("d", "")),
            "//gazebo | //collision[@name='c']/tf:sdf/max_contacts/text()",
            ["3"],
        ),
        # what Gazebo reads
        (link("<gravity>false</gravity>"), "//gazebo[@reference='a']/turnGravityOff/text()", ["true"]),
        (
            link(visual(BOX + "<transparency>0.5</transparency>")),
            "//gazebo[@reference='a']/visual/transparency/text() | //visual/tf:*[not(self::tf:name)]",
            ["0.5"],
        ),
        (
            link("<velocity_decay><linear>1</linear></velocity_decay>"),
            "//gazebo[@reference='a']/velocity_decay/linear/text()",
            ["1"],
        ),
        (
            LINK + "<plugin name='p' filename='f'><x>1</x></plugin>",
            "/robot/gazebo[not(@reference)]/plugin/x/text()",
            ["1"],
        ),
        ("<self_collide>true</self_collide>" + LINK, "/robot/gazebo/self_collide/text()", ["true"]),
        (
            arm("revolute", "<physics><ode><limit><cfm>1</cfm></limit><bounce>2</bounce></ode></physics>"),
            "//gazebo/stopCfm/text() | //joint/tf:sdf//bounce/text()",
            ["2", "1"],
        ),
        (
            arm("revolute", "<axis><dynamics><spring_stiffness>4</spring_stiffness></dynamics></axis>"),
            "//gazebo[@reference='j']/springStiffness/text()",
            ["4"],
        ),
        (arm("revolute", "<sensor name='s' type='force_torque'/>"), "//gazebo[@reference='j']/sensor/@name", ["s"]),
        (
            LINK
            + link(
                "<pose>1 0 0 0 0 0</pose><sensor name='s' type='imu'><pose relative_to='a'>0 0 1 0 0 0</pose></sensor>",
                "b",
            )
            + joint("fixed"),
            "//sensor/pose/text() | //sensor/tf:pose/@*",
            ["-1 0 1 0 0 0", "a"],
        ),
        (
            LINK
            + link(
                "<pose>1 0 0 0 0 0</pose><sensor name='s' type='camera'>"
                "<camera><pose relative_to='a'>0 0 1 0 0 0</pose></camera></sensor>",
                "b",
            )
            + joint("fixed"),
            "//sensor/camera/pose/text() | //sensor/camera/tf:pose/@*",
            ["-1 0 1 0 0 0", "a"],
        ),
        (
            LINK
            + link("<projector name='p'><texture>t</texture></projector>", "b")
            + joint("fixed", "<pose>0 0 1 0 0 0</pose>"),
            "//projector/pose/text()",
            ["0 0 -1 0 0 0"],
        ),
    ],
)
def test_a_part_of_sdf_is_expressed_in_urdf(text: str, path: str, expected: list[str]) -> None:
    assert values_at(convert(text), path) == expected
