"""What only spells a thing: two texts each that have one normal form."""

import pytest

from tests.unit.compiler.normal_form_snippets import compared, joint, link, robot, sdf, sdf_link

ALIKE = {
    # spellings
    "numbers": (joint('<axis xyz="0 1.0 0"/>'), joint('<axis xyz=" 0  1e0 -0"/>')),
    "numbers that rounding changed": (joint('<axis xyz="0 1 0"/>'), joint('<axis xyz="1e-17 1.0000000000000002 0"/>')),
    "rounding of a zero": (
        sdf_link("<velocity_decay><linear>0</linear></velocity_decay>"),
        sdf_link("<velocity_decay><linear>1e-17</linear></velocity_decay>"),
    ),
    "truths": (sdf("<static>true</static>"), sdf("<static> 1 </static>")),
    "numbers that are none": (
        sdf_link("<inertial><mass>nan</mass></inertial>"),
        sdf_link("<inertial><mass>NaN</mass></inertial>"),
    ),
    "a color without its alpha": (
        sdf_link("<visual name='v'><material><diffuse>1 0 0</diffuse></material></visual>"),
        sdf_link("<visual name='v'><material><diffuse>1 0 0 1</diffuse></material></visual>"),
    ),
    "white space and comments": (robot('<link name="l"/><!-- c -->'), robot('\n  <link name="l">\n</link>')),
    "prefixes": (robot('<p:x xmlns:p="urn:x" p:y="1"/>'), robot('<q:x xmlns:q="urn:x" q:y="1"/>')),
    "the root of SDF 1.2": (sdf("", "1.2"), sdf("", "1.2").replace("sdf", "gazebo")),
    "a default namespace": (robot(""), '<robot xmlns="urn:x" name="r"/>'),
    # poses
    "a turn that is another way to write it": (
        joint('<origin rpy="3.141592653589793 0 0"/>'),
        joint('<origin rpy="-3.141592653589793 0 0"/>'),
    ),
    "a turn at the gimbal lock": (
        sdf_link("<pose>0 0 0 1 1.5707963267948966 0</pose>"),
        sdf_link("<pose>0 0 0 0 1.5707963267948966 -1</pose>"),
    ),
    "the notation of no turn": (
        sdf_link('<pose degrees="true">1 0 0 0 0 0</pose>'),
        sdf_link("<pose>1 0 0 0 0 0</pose>"),
    ),
    "a quaternion of the other sign": (
        sdf_link('<pose rotation_format="quat_xyzw">0 0 0 1 0 0 0</pose>'),
        sdf_link('<pose rotation_format="quat_xyzw">0 0 0 -1 0 0 0</pose>'),
    ),
    # order
    "the order of unlike siblings": (
        robot('<link name="l"/><joint name="j" type="fixed"/>'),
        robot('<joint name="j" type="fixed"/><link name="l"/>'),
    ),
    "the order of what has a name": (
        robot('<link name="a"/><link name="b"/>'),
        robot('<link name="b"/><link name="a"/>'),
    ),
    # names of frames
    "the frame of the model, for a link": (
        sdf_link('<pose relative_to="__model__">1 0 0 0 0 0</pose>'),
        sdf_link("<pose>1 0 0 0 0 0</pose>"),
    ),
    "the frame of the model, for a model in it": (
        sdf('<model name="n"><pose relative_to="__model__">1 0 0 0 0 0</pose></model>'),
        sdf('<model name="n"><pose>1 0 0 0 0 0</pose></model>'),
    ),
    "the frame of a model by the model's name": (
        sdf('<joint name="j" type="fixed"><parent>n::__model__</parent><child>l</child></joint>'),
        sdf('<joint name="j" type="fixed"><parent>n</parent><child>l</child></joint>'),
    ),
    # defaults
    "the canonical link that is the first one": (
        sdf('<link name="a"/><link name="b"/><link name="c"/>'),
        sdf('<link name="a"/><link name="c"/><link name="b"/>').replace('"m"', '"m" canonical_link="a"'),
    ),
    "no limit": (
        sdf('<joint name="j" type="revolute"><axis><limit><upper>1e17</upper></limit></axis></joint>', "1.10"),
        sdf('<joint name="j" type="revolute"/>', "1.10"),
    ),
    "no origin": (joint(""), joint("<origin/>")),
    "an origin that is none": (joint(""), joint('<origin xyz="0 0 0" rpy="0 0 0"/>')),
    "an origin of rounding": (joint(""), joint('<origin xyz="0 0 1e-17" rpy="0 6.283185307179586 0"/>')),
    "no pose": (sdf_link(""), sdf_link("<pose>0 0 0 0 0 0</pose>")),
    "a pose without numbers": (sdf_link(""), sdf_link("<pose/>")),
    "the axis of URDF": (joint(""), joint('<axis xyz="1 0 0"/>')),
    "the axis of SDF": (
        sdf('<joint name="j" type="revolute"><axis/></joint>'),
        sdf('<joint name="j" type="revolute"><axis><xyz>0 0 1</xyz></axis></joint>'),
    ),
    "no damping": (joint(""), joint('<dynamics damping="0.0"/>')),
    "containers in containers": (
        sdf_link('<collision name="c"/>'),
        sdf_link('<collision name="c"><surface><friction><ode><mu>1</mu></ode></friction></surface></collision>'),
    ),
    "an inertial of SDF that nobody wrote": (sdf_link(""), sdf_link("<inertial><mass>1.0</mass></inertial>")),
    "the scale of a mesh": (
        link('<visual><geometry><mesh filename="a"/></geometry></visual>'),
        link('<visual><geometry><mesh filename="a" scale="1 1 1"/></geometry></visual>'),
    ),
    "the first version of URDF": (robot(""), robot("", ' version="1.0"')),
    "a frame without a name": (
        sdf_link('<pose frame="">1 0 0 0 0 0</pose>', "1.6"),
        sdf_link("<pose>1 0 0 0 0 0</pose>", "1.6"),
    ),
    "no texture": (
        link('<visual><material name="m"><texture filename=""/></material></visual>'),
        link('<visual><material name="m"/></visual>'),
    ),
    "the limit of an older version": (
        sdf('<joint name="j" type="revolute"><axis><limit><lower>-1e16</lower></limit></axis></joint>', "1.9"),
        sdf('<joint name="j" type="revolute"/>', "1.9"),
    ),
    # <gazebo>
    "extensions of one reference": (
        robot('<gazebo reference="l"><mu1>1</mu1><kp>2</kp></gazebo>'),
        robot(
            '<gazebo reference="l"><kp>2</kp></gazebo><gazebo reference="k"/>'
            '<gazebo reference="l"><mu1>1</mu1></gazebo>'
        ),
    ),
    "an extension without content": (robot('<gazebo reference="l"/>'), robot("<gazebo/>")),
    "a reference to nothing": (
        robot("<gazebo><static>true</static></gazebo>"),
        robot('<gazebo reference=""><static>1</static></gazebo>'),
    ),
    "a tag whose value is an attribute": (
        robot('<gazebo reference="l"><mu1 value="0.20"/></gazebo>'),
        robot('<gazebo reference="l"><mu1>0.2</mu1></gazebo>'),
    ),
    "truths of Gazebo's own": (
        robot('<gazebo reference="l"><turnGravityOff>yes</turnGravityOff></gazebo>'),
        robot('<gazebo reference="l"><turnGravityOff>true</turnGravityOff></gazebo>'),
    ),
    "a field that has a tag": (
        robot('<gazebo reference="l"><turnGravityOff>true</turnGravityOff><selfCollide>1</selfCollide></gazebo>'),
        robot('<gazebo reference="l"><gravity>false</gravity><self_collide>true</self_collide></gazebo>'),
    ),
    "tags and what they mean in SDF": (
        robot(
            '<gazebo reference="l"><mu1>0.5</mu1><minDepth>0.1</minDepth><maxContacts>3</maxContacts>'
            "<collision><surface><friction><ode><mu2>0.6</mu2></ode></friction></surface></collision></gazebo>"
        ),
        robot(
            '<gazebo reference="l"><collision><max_contacts>3</max_contacts><surface>'
            "<friction><ode><mu>0.5</mu><mu2>0.6</mu2></ode></friction>"
            "<contact><ode><min_depth>0.1</min_depth></ode></contact></surface></collision></gazebo>"
        ),
    ),
    "tags of joints and what they mean in SDF": (
        robot(
            '<gazebo reference="j"><stopCfm>0.1</stopCfm><provideFeedback>yes</provideFeedback>'
            "<springStiffness>2</springStiffness></gazebo>"
        ),
        robot(
            '<gazebo reference="j"><physics><provide_feedback>1</provide_feedback></physics>'
            "<axis><dynamics><spring_stiffness>2</spring_stiffness></dynamics></axis>"
            "<physics><ode><limit><cfm>0.1</cfm></limit></ode></physics></gazebo>"
        ),
    ),
    "a tag for two values": (
        robot('<gazebo reference="l"><dampingFactor>0.1</dampingFactor></gazebo>'),
        robot(
            '<gazebo reference="l"><velocity_decay><linear>0.1</linear><angular>0.1</angular></velocity_decay></gazebo>'
        ),
    ),
    "a tag of a default": (robot('<gazebo reference="l"><mu1>1</mu1></gazebo>'), robot("")),
    "one thing written twice": (
        robot('<gazebo reference="l"><mu1>0.5</mu1><mu1>0.50</mu1></gazebo>'),
        robot('<gazebo reference="l"><mu1>0.5</mu1></gazebo>'),
    ),
    "the model that a frame is attached to": (
        sdf('<link name="l"/><frame name="f" attached_to="__model__"/>'),
        sdf('<link name="l"/><frame name="f"/>'),
    ),
    "SDF in an extension": (
        robot('<gazebo><sensor name="s" type="imu"><pose>0 0 0 0 0 0</pose><always_on>1</always_on></sensor></gazebo>'),
        robot('<gazebo><sensor name="s" type="imu"><always_on>true</always_on></sensor></gazebo>'),
    ),
}


@pytest.mark.parametrize("case", ALIKE)
def test_spellings_of_one_thing_have_one_normal_form(case: str) -> None:
    one, other = ALIKE[case]
    assert compared(one, other) == []
    assert compared(other, one) == []
