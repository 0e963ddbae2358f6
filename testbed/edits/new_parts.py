"""The XML of parts that are added to a robot file, in URDF and in SDF, with numbers that are drawn at random."""

from collections.abc import Callable, Mapping
from random import Random

JOINTS = ("fixed", "revolute", "prismatic", "continuous")
_BOX_INERTIA = {"ixx": 0.02, "ixy": 0, "ixz": 0, "iyy": 0.03, "iyz": 0, "izz": 0.04}


def urdf_ends(parent: str, child: str) -> str:
    """The two ends of a joint of URDF."""
    return f'<parent link="{parent}"/><child link="{child}"/>'


def _numbers(random: Random, *among: float) -> str:
    return " ".join(f"{random.choice(among):g}" for _ in range(3))


def origin(random: Random) -> str:
    """A place in URDF."""
    return f'<origin xyz="{_numbers(random, 0, 0.1, -0.2, 0.35)}" rpy="{_numbers(random, 0, 0, 0.3, -1.2)}"/>'


def pose(random: Random, about: str = "") -> str:
    """A place in SDF."""
    return f"<pose{about}>{_numbers(random, 0, 0.1, -0.2, 0.35)} {_numbers(random, 0, 0, 0.3, -1.2)}</pose>"


def _urdf_shape(tag: str, name: str, random: Random) -> str:
    called = f' name="{name}"' if random.random() < 0.5 else ""
    shape = random.choice(
        ['<box size="0.1 0.2 0.3"/>', '<sphere radius="0.07"/>', '<cylinder radius="0.05" length="0.4"/>']
    )
    material = '<material name="added_red"><color rgba="0.8 0.1 0.1 1"/></material>' if tag == "visual" else ""
    return f"<{tag}{called}>{origin(random)}<geometry>{shape}</geometry>{material}</{tag}>"


def _sdf_shape(tag: str, name: str, random: Random) -> str:
    shapes = (
        "<box><size>0.1 0.2 0.3</size></box>",
        "<sphere><radius>0.07</radius></sphere>",
        "<cylinder><radius>0.05</radius><length>0.4</length></cylinder>",
    )
    look = "<material><ambient>0.8 0.1 0.1 1</ambient><diffuse>0.8 0.1 0.1 1</diffuse></material>"
    surface = "<surface><friction><ode><mu>0.4</mu><mu2>0.3</mu2></ode></friction></surface>"
    extra = look if tag == "visual" else random.choice(["", surface])
    return f'<{tag} name="{name}">{pose(random)}<geometry>{random.choice(shapes)}</geometry>{extra}</{tag}>'


def _sdf_sensor(name: str, random: Random) -> str:
    content = f"{pose(random)}<update_rate>50</update_rate><always_on>true</always_on>"
    return f'<sensor name="{name}" type="imu">{content}</sensor>'


def urdf_inertial(random: Random) -> str:
    """The mass of a box in URDF."""
    moments = " ".join(f'{key}="{value}"' for key, value in _BOX_INERTIA.items())
    return f'<inertial>{origin(random)}<mass value="1.25"/><inertia {moments}/></inertial>'


def sdf_inertial(random: Random) -> str:
    """The mass of a box in SDF."""
    moments = "".join(f"<{key}>{value}</{key}>" for key, value in _BOX_INERTIA.items())
    return f"<inertial>{pose(random)}<mass>1.25</mass><inertia>{moments}</inertia></inertial>"


def urdf_link(name: str, base: str, kind: str, random: Random) -> tuple[str, str]:
    """A link of URDF, and the joint that holds it."""
    link = f'<link name="{name}">{urdf_inertial(random)}{_urdf_shape("collision", f"{name}_shape", random)}</link>'
    limit = '<limit lower="-0.5" upper="0.75" effort="10" velocity="2"/>' if kind in {"revolute", "prismatic"} else ""
    axis = f'<axis xyz="{random.choice(["0 0 1", "0 1 0", "1 0 0"])}"/>{limit}' if kind != "fixed" else ""
    joint = f'<joint name="{name}_joint" type="{kind}">{urdf_ends(base, name)}{origin(random)}{axis}</joint>'
    return link, joint


def sdf_link(name: str, base: str, kind: str, random: Random) -> tuple[str, str]:
    """A link of SDF, posed in one of the ways that there are, and the joint that holds it."""
    about, joint_pose = random.choice(
        [
            ("", ""),
            (f' relative_to="{base}"', ""),
            ("", pose(random)),
            (f' relative_to="{name}_joint"', pose(random, f' relative_to="{base}"')),
        ]
    )
    shape = _sdf_shape("collision", f"{name}_shape", random)
    link = f'<link name="{name}">{pose(random, about)}{sdf_inertial(random)}{shape}</link>'
    limit = "<limit><lower>-0.5</lower><upper>0.75</upper></limit>" if kind in {"revolute", "prismatic"} else ""
    axis = f"<axis><xyz>{random.choice(['0 0 1', '0 1 0', '1 0 0'])}</xyz>{limit}</axis>" if kind != "fixed" else ""
    content = f"{joint_pose}<parent>{base}</parent><child>{name}</child>{axis}"
    joint = f'<joint name="{name}_joint" type="{kind}">{content}</joint>'
    return link, joint


def plugin(name: str) -> str:
    """A plugin that nobody knows."""
    return f'<plugin name="{name}" filename="lib{name}.so"><rate>30</rate><topic>edited/{name}</topic></plugin>'


_Make = Callable[[str, Random], str]
URDF_PARTS: Mapping[str, _Make] = {
    "visual": lambda name, random: _urdf_shape("visual", name, random),
    "collision": lambda name, random: _urdf_shape("collision", name, random),
}
SDF_PARTS: Mapping[str, _Make] = {
    "visual": lambda name, random: _sdf_shape("visual", name, random),
    "collision": lambda name, random: _sdf_shape("collision", name, random),
    "sensor": _sdf_sensor,
}
_CAMERA = (
    "<horizontal_fov>1.1</horizontal_fov><image><width>320</width><height>240</height></image>"
    "<clip><near>0.1</near><far>50</far></clip>"
)
GAZEBO_LINK_TAGS = (
    "<mu1>0.3</mu1><mu2>0.2</mu2>",
    "<kp>100000</kp><kd>10</kd>",
    "<selfCollide>true</selfCollide>",
    "<turnGravityOff>true</turnGravityOff>",
    "<material>Gazebo/Orange</material>",
    '<sensor name="added_imu" type="imu"><update_rate>50</update_rate></sensor>',
    f'<sensor name="added_camera" type="camera"><pose>0.1 0 0.2 0 0.3 0</pose><camera>{_CAMERA}</camera></sensor>',
)
GAZEBO_JOINT_TAGS = (
    "<provideFeedback>true</provideFeedback>",
    "<implicitSpringDamper>true</implicitSpringDamper>",
    "<springStiffness>3</springStiffness><springReference>0.1</springReference>",
    "<stopErp>0.4</stopErp><stopCfm>0.01</stopCfm>",
)
URDF_JOINT_PARTS = {
    "axis": '<axis xyz="0 0.6 0.8"/>',
    "limit": '<limit lower="-0.3" upper="0.4" effort="7" velocity="3"/>',
    "dynamics": '<dynamics damping="0.2" friction="0.1"/>',
    "mimic": '<mimic joint="{other}" multiplier="{by}" offset="0.1"/>',
    "safety_controller": '<safety_controller k_velocity="10" soft_lower_limit="-0.2" soft_upper_limit="0.2"/>',
    "calibration": '<calibration rising="0.1"/>',
    "origin": '<origin xyz="0.1 0.2 0.3" rpy="0 0 0.5"/>',
}
SDF_JOINT_PARTS = {
    "axis": "<axis><xyz>0 0.6 0.8</xyz></axis>",
    "axis/limit": "<limit><lower>-0.3</lower><upper>0.4</upper></limit>",
    "axis/dynamics": "<dynamics><damping>0.2</damping></dynamics>",
    "axis/mimic": '<mimic joint="{other}"><multiplier>{by}</multiplier><offset>0.1</offset></mimic>',
    "pose": "<pose>0.1 0 0.2 0 0 0.4</pose>",
    "physics": "<physics><ode><cfm_damping>true</cfm_damping></ode></physics>",
    "sensor": '<sensor name="added_ft" type="force_torque"><update_rate>20</update_rate></sensor>',
}


def _mjcf_geom(name: str, random: Random, more: str) -> str:
    shape = random.choice(
        ['type="box" size="0.05 0.1 0.15"', 'type="sphere" size="0.07"', 'type="cylinder" size="0.05 0.2"']
    )
    return f'<geom name="{name}" {shape} {_mjcf_place(random)} density="0" {more}/>'


def _mjcf_place(random: Random) -> str:
    return f'pos="{_numbers(random, 0, 0.1, -0.2, 0.35)}" quat="{random.choice(["1 0 0 0", "0.8 0 0.6 0"])}"'


def mjcf_body(name: str, random: Random) -> str:
    """A body with a mass and a shape, and a joint or none."""
    axis = random.choice(["0 0 1", "0 1 0", "1 0 0"])
    limit = random.choice(["", ' limited="true" range="-0.5 0.75"'])
    kind = random.choice(["hinge", "slide", "ball", ""])
    limit = "" if kind == "ball" else limit
    joint = f'<joint name="{name}_joint" type="{kind}" axis="{axis}"{limit}/>' if kind else ""
    inertial = '<inertial pos="0 0 0.1" mass="1.25" diaginertia="0.02 0.03 0.04"/>'
    shape = _mjcf_geom(f"{name}_shape", random, "")
    return f'<body name="{name}" {_mjcf_place(random)}>{inertial}{joint}{shape}</body>'


MJCF_PARTS: Mapping[str, _Make] = {
    "visual": lambda name, random: _mjcf_geom(name, random, 'contype="0" conaffinity="0" rgba="0.8 0.1 0.1 1"'),
    "collision": lambda name, random: _mjcf_geom(name, random, 'friction="0.4 0.005 0.0001"'),
    "site": lambda name, random: f'<site name="{name}" {_mjcf_place(random)}/>',
}
MJCF_JOINT_PARTS: tuple[Mapping[str, str], ...] = (
    {"damping": "0.75"},
    {"frictionloss": "0.25"},
    {"armature": "0.125"},
    {"stiffness": "3", "springref": "0.1"},
    {"limited": "true", "range": "-0.5 0.75"},
    {"actuatorfrclimited": "true", "actuatorfrcrange": "-7 7"},
    {"pos": "0.1 0 0.2"},
)
MJCF_SECTIONS = (
    ("actuator", '<motor name="{name}" joint="{one}" gear="2"/>'),
    ("actuator", '<position name="{name}" joint="{one}" kp="20"/>'),
    ("sensor", '<jointpos name="{name}" joint="{one}"/>'),
    ("equality", '<joint name="{name}" joint1="{one}" joint2="{other}" polycoef="0.1 0.5 0 0 0"/>'),
    ("equality", '<connect name="{name}" body1="{one}" body2="{other}" anchor="0 0 0.1"/>'),
    ("contact", '<exclude name="{name}" body1="{one}" body2="{other}"/>'),
)
"""What stands in a section of MJCF and names joints or bodies."""
