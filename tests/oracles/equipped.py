"""Models of the strategies with what Gazebo reads beside bodies and joints, as text."""

from collections.abc import Sequence

from hypothesis import strategies as st
from lxml import etree

from twinform.compiler.output.emitting import emit
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Document
from twinform.schemas import XmlElement
from twinform.testing import strategies

_PLUGIN = "<plugin filename='libp.so' name='p{}'><speed>{}</speed></plugin>"
_SURFACES = (
    "<surface><friction><ode><mu>0.5</mu><mu2>0.25</mu2></ode></friction></surface>",
    "<surface><friction><ode><mu>0.7</mu><fdir1>1 0 0</fdir1></ode></friction></surface>",
    "<surface><friction><ode><slip1>0.1</slip1></ode></friction></surface>",
    "<surface><contact><ode><kp>1e5</kp><kd>2</kd><min_depth>0.01</min_depth></ode></contact></surface>",
    "<surface><contact><collide_bitmask>3</collide_bitmask></contact><friction><ode><mu>0.2</mu></ode></friction></surface>",
    "<surface><bounce><restitution_coefficient>0.5</restitution_coefficient></bounce></surface>",
)
_MATERIALS = (
    "<material><ambient>0.1 0.2 0.3 1</ambient><diffuse>0.4 0.5 0.6 1</diffuse></material>",
    "<material><diffuse>1 0 0 0.5</diffuse><specular>0.1 0.1 0.1 1</specular></material>",
    "<material><script><uri>file://media/materials/scripts/gazebo.material</uri><name>Gazebo/Blue</name></script></material>",
    "<material><emissive>0 1 0 1</emissive></material>",
)
_SENSORS = (
    "<sensor name='imu' type='imu'><update_rate>10</update_rate><topic>t</topic></sensor>",
    "<sensor name='alt' type='altimeter'><pose>0.1 0 0.2 0 0.3 0</pose><always_on>true</always_on></sensor>",
    "<sensor name='cam' type='camera'><camera><horizontal_fov>1.1</horizontal_fov></camera></sensor>",
    f"<sensor name='own' type='magnetometer'>{_PLUGIN.format(9, 9)}</sensor>",
)
_CHOICES: dict[str, tuple[Sequence[str], ...]] = {
    "model": (
        ("<self_collide>true</self_collide>", "<self_collide>false</self_collide>"),
        ("<allow_auto_disable>false</allow_auto_disable>",),
        ("<enable_wind>true</enable_wind>",),
        (_PLUGIN.format(1, 1),),
        ("<plugin filename='libq.so' name='q'><link>link_0</link><joint_name>joint_1</joint_name></plugin>",),
    ),
    "link": (
        ("<self_collide>true</self_collide>", "<self_collide>false</self_collide>"),
        ("<kinematic>true</kinematic>",),
        ("<enable_wind>true</enable_wind>",),
        ("<velocity_decay><linear>0.1</linear><angular>0.2</angular></velocity_decay>",),
        *((sensor,) for sensor in _SENSORS),
    ),
    "collision": (
        _SURFACES,
        ("<laser_retro>7</laser_retro>", "<laser_retro>0</laser_retro>"),
        ("<max_contacts>3</max_contacts>",),
    ),
    "visual": (
        _MATERIALS,
        ("<transparency>0.5</transparency>",),
        ("<cast_shadows>false</cast_shadows>",),
        ("<laser_retro>3</laser_retro>",),
        ("<meta><layer>1</layer></meta>",),
        (_PLUGIN.format(2, 2),),
    ),
}
_TAGS: tuple[Sequence[str], ...] = (
    ("<mu1>0.5</mu1>",),
    ("<mu2>0.3</mu2>",),
    ("<kp>1e5</kp><kd>3</kd>",),
    ("<maxVel>0.2</maxVel>", "<minDepth>0.01</minDepth>"),
    ("<maxContacts>4</maxContacts>",),
    ("<laserRetro>6</laserRetro>",),
    ("<material>Gazebo/Green</material>",),
    ("<selfCollide>true</selfCollide>", "<self_collide>true</self_collide>"),
    ("<turnGravityOff>true</turnGravityOff>", "<gravity>false</gravity>"),
    ("<dampingFactor>0.1</dampingFactor>", "<dampingFactor>0.2</dampingFactor>"),
    ("<velocity_decay><linear>0.3</linear></velocity_decay>",),
    ("<kinematic>true</kinematic>",),
    tuple(f"<collision>{each}</collision>" for each in _SURFACES),
    tuple(f"<collision>{each}</collision>" for each in _SURFACES),
    ("<collision><laser_retro>8</laser_retro></collision>", "<collision><max_contacts>5</max_contacts></collision>"),
    tuple(f"<visual>{each}</visual>" for each in (*_MATERIALS, "<transparency>0.5</transparency>")),
    tuple(f"<visual>{each}</visual>" for each in ("<transparency>0.7</transparency>", "<pose>1 0 0 0 0 0</pose>")),
    _MATERIALS,
)


@st.composite
def equipped_models(draw: st.DrawFn) -> str:
    """Text of SDF models of which each part may have values that Gazebo reads."""
    root = _tree(draw(strategies.sdf_models(version="1.9", max_links=4)))
    for element in list(root.iter(*_CHOICES)):
        _fill(element, draw(_some(_CHOICES[str(element.tag)])))
    for link in root.iter("link"):
        names = [str(each.get("name")) for each in link.iter("collision")]
        if names and draw(st.booleans()):
            sensed = "".join(f"<collision>{name}</collision>" for name in names)
            _fill(link, [f"<sensor name='touch' type='contact'><contact>{sensed}<topic>c</topic></contact></sensor>"])
    return etree.tostring(root, encoding="unicode")


@st.composite
def equipped_robots(draw: st.DrawFn) -> str:
    """Text of URDF robots with shapes that have names or none, and `<gazebo>` elements, also several about one link."""
    robots = strategies.robots(max_links=4, joint_types=("fixed", "revolute", "continuous", "prismatic"))
    root = _tree(draw(robots.filter(lambda robot: robot.models[0].links[0].inertial is not None)))
    names = [str(link.get("name")) for link in root.iter("link")]
    for link in root.iter("link"):
        for shape in link.iter("visual", "collision"):
            if name := draw(
                st.sampled_from(["", "", "shape", str(link.get("name")), f"{link.get('name')}_{shape.tag}"])
            ):
                shape.set("name", name)
    for name in draw(st.lists(st.sampled_from(names), max_size=5)):
        _fill(etree.SubElement(root, "gazebo", {"reference": name}), draw(_some(_TAGS)))
    for name in draw(st.lists(st.sampled_from(names), max_size=3, unique=True)):
        _fill(etree.SubElement(root, "gazebo", {"reference": name}), draw(_some([(each,) for each in _SENSORS])))
    statics = ("<static>true</static>", "<static>false</static>")
    has_mass = all(link.find("inertial") is not None for link in root.iter("link"))
    for choices in draw(
        st.lists(st.sampled_from([_CHOICES["model"], (statics,)] if has_mass else [_CHOICES["model"]]), max_size=3)
    ):
        _fill(etree.SubElement(root, "gazebo"), draw(_some(choices)))
    return etree.tostring(root, encoding="unicode")


def _tree(document: Document) -> XmlElement:
    return etree.fromstring(emit(document, DiagnosticSink()).encode())


def _some(choices: Sequence[Sequence[str]]) -> st.SearchStrategy[list[str]]:
    """Some of the choices, and of each one of its texts."""
    each = [st.none() | st.sampled_from(texts) for texts in choices]
    return st.tuples(*each).map(lambda texts: [text for text in texts if text is not None])


def _fill(element: XmlElement, texts: Sequence[str]) -> None:
    for text in texts:
        element.extend([*etree.fromstring(f"<some>{text}</some>")])
