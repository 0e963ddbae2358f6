"""Documents that are cheap to write and once were dear to read: each part of a format many times, in each bad shape.

A shape says how a part is repeated: under names of its own or all under one, each on its line or all on one. Some parts
are wrong, so that each of them is a finding.
"""

from collections.abc import Callable, Iterator, Mapping
from functools import partial
from itertools import product
from typing import NamedTuple

from tests.profile import DEEP

SIZE = 400_000 if DEEP else 100_000
"""Characters of each document: a hundred times what most robots have."""


class Costly(NamedTuple):
    """A document and the suffix of its file."""

    suffix: str
    make: Callable[[], str]


class _Format(NamedTuple):
    """What stands before and behind the parts of a document, and the parts, with `%` where their number goes."""

    suffix: str
    before: str
    behind: str
    parts: Mapping[str, str]


_ANYWHERE = {
    "comments": "<!-- % -->",
    "processing instructions": "<?p %?>",
    "unknown elements": "<x%/>",
    "unknown elements of another namespace": '<p:x xmlns:p="urn:x" a="%"/>',
    "texts": "<x>a % b</x>",
    "stray texts": "a%<x/>",
    "CDATA": "<x><![CDATA[%]]></x>",
    "carriers": '<tf:x xmlns:tf="urn:twinform:1" name="n%"/>',
}
_JOINT = '<joint name="j%" type="{kind}"><parent link="a"/><child link="{child}"/>{inside}</joint>'
_SHAPE = '<geometry><box size="1 1 1"/></geometry>'
_URDF = _Format(
    "urdf",
    '<robot name="r"><link name="a"/><link name="b"/><joint name="ab" type="fixed"><parent link="a"/><child link="b"/>'
    "</joint>",
    "</robot>",
    {
        **_ANYWHERE,
        "links": '<link name="l%"/>',
        "links without a name": "<link/>",
        "links with what is unknown": '<link name="l%" x="%"><y/></link>',
        "links with a wrong mass": '<link name="l%"><inertial><mass value="x%"/></inertial></link>',
        "tree": '<link name="l%"/>' + _JOINT.format(kind="fixed", child="l%", inside=""),
        "joints to nothing": _JOINT.format(kind="fixed", child="n%", inside=""),
        "joints to one link": _JOINT.format(kind="revolute", child="b", inside=""),
        "joints of a wrong type": _JOINT.format(kind="bad", child="b", inside=""),
        "joints that mimic": _JOINT.format(kind="revolute", child="b", inside='<mimic joint="j%"/>'),
        "joints without a child": '<joint name="j%" type="fixed"/>',
        "materials": '<material name="m%"><color rgba="1 0 0 1"/></material>',
        "materials of a wrong color": '<material name="m%"><color rgba="255 0 0 1"/></material>',
        "settings of a link": '<gazebo reference="a"><mu1>%</mu1></gazebo>',
        "settings of nothing": '<gazebo reference="n%"><mu1>1</mu1></gazebo>',
        "settings of the robot": "<gazebo><static>false</static></gazebo>",
        "plugins": '<gazebo><plugin name="p%" filename="libp%.so"><x/></plugin></gazebo>',
        "plugins of Gazebo Classic": '<gazebo><plugin name="p%" filename="libgazebo_ros_diff_drive.so"/></gazebo>',
        "sensors": '<gazebo reference="a"><sensor name="s%" type="camera"><camera/></sensor></gazebo>',
        "transmissions": (
            '<transmission name="t%"><type>transmission_interface/SimpleTransmission</type><joint name="ab"/>'
            '<actuator name="a%"/></transmission>'
        ),
        "transmissions without anything": "<transmission/>",
        "joints with transmissions": (
            '<link name="l%"/>'
            + _JOINT.format(kind="fixed", child="l%", inside="")
            + '<transmission name="t%"><joint name="j%"/></transmission>'
        ),
        "ros2_control": '<ros2_control name="c%" type="system"><joint name="ab"/></ros2_control>',
        "ros2_control without anything": "<ros2_control/>",
    },
)
_URDF_LINK = _Format(
    "urdf",
    '<robot name="r"><link name="a">',
    "</link></robot>",
    {
        "visuals": f'<visual name="v%">{_SHAPE}</visual>',
        "visuals with a material": f'<visual>{_SHAPE}<material name="m%"/></visual>',
        "visuals without anything": "<visual/>",
        "collisions": f'<collision name="v%">{_SHAPE}</collision>',
        "meshes": '<visual><geometry><mesh filename="package://p%/m%.stl"/></geometry></visual>',
        "meshes beside it": '<visual><geometry><mesh filename="m%.stl"/></geometry></visual>',
        "inertials": '<inertial><mass value="%"/></inertial>',
    },
)
_SDF = _Format(
    "sdf",
    '<sdf version="1.11"><model name="m"><link name="a"/>',
    "</model></sdf>",
    {
        **_ANYWHERE,
        "links": '<link name="l%"/>',
        "links without a name": "<link/>",
        "links with what is unknown": '<link name="l%" x="%"><y/></link>',
        "chain": '<link name="l%"/><joint name="j%" type="fixed"><parent>a</parent><child>l%</child></joint>',
        "joints to nothing": '<joint name="j%" type="fixed"><parent>a</parent><child>n%</child></joint>',
        "joints of a wrong type": '<joint name="j%" type="bad"><parent>a</parent><child>a</child></joint>',
        "frames": '<frame name="f%"/>',
        "frames attached to nothing": '<frame name="f%" attached_to="n%"/>',
        "frames with a pose": '<frame name="f%"><pose relative_to="a">0 0 0 0 0 %</pose></frame>',
        "frames in a circle": '<frame name="f%" attached_to="f%"/>',
        "models": '<model name="m%"><link name="l"/></model>',
        "models without a link": '<model name="m%"/>',
        "plugins": '<plugin name="p%" filename="libp%.so"><x/></plugin>',
        "includes": "<include><uri>model://n%</uri></include>",
        "self_collide": "<self_collide>%</self_collide>",
        "poses": "<pose>0 0 0 0 0 %</pose>",
    },
)
_SDF_LINK = _Format(
    "sdf",
    '<sdf version="1.11"><model name="m"><link name="a">',
    "</link></model></sdf>",
    {
        "visuals": '<visual name="v%"><geometry><box><size>1 1 1</size></box></geometry></visual>',
        "collisions": '<collision name="v%"><geometry><box><size>1 1 1</size></box></geometry></collision>',
        "sensors": '<sensor name="s%" type="camera"><camera/></sensor>',
        "lights": '<light name="s%" type="point"/>',
        "poses": "<pose>0 0 0 0 0 %</pose>",
    },
)
_WORLD = _Format(
    "sdf",
    '<sdf version="1.11"><world name="w">',
    "</world></sdf>",
    {
        "models": '<model name="m%"><link name="l"/></model>',
        "lights": '<light name="s%" type="point"/>',
        "joints": '<joint name="j%" type="fixed"><parent>world</parent><child>n%</child></joint>',
        "includes": "<include><uri>model://n%</uri></include>",
        "actors": '<actor name="a%"><pose>0 0 0 0 0 0</pose></actor>',
    },
)
_BROKEN = _Format(
    "urdf",
    '<robot name="r"><link name="a"/>',
    "</robot>",
    {
        "undeclared prefixes": "<p%:x/>",
        "two colons": "<x::y a='%'/>",
        "hyphens in comments": "<!-- % -- -->",
        "ampersands": "<x> % & </x>",
        "entities": "<x>&e%;</x>",
        "values without quotes": "<x a=%/>",
        "attributes without a blank": '<x a="%"b=""/>',
        "attributes twice": '<x a="%" a=""/>',
        "elements without an end": "<x%>",
        "ends without an element": "</x%>",
        "open brackets": "<",
        "open comments": "<!--",
        "open sections": "<![CDATA[",
        "open values": '<x a="',
        "late declarations": '<?xml version="1.0"?>',
        "control characters": "<x>\x01</x>",
        "declarations of types": "<!DOCTYPE r%>",
        "broken numbers": '<x a="1\t%"/>',
        "numbers that are over": '<x a="1&#9;%"/>',
    },
)
_XACRO_BEFORE = '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro"><link name="a"/>'
_XACRO = _Format(
    "urdf.xacro",
    _XACRO_BEFORE,
    "</robot>",
    {
        "links": '<link name="l%"/>',
        "variables of the environment": '<x a="$(optenv N% 0)"/>',
        "packages": '<x a="$(find p%)"/>',
        "packages in one text": "$(find p%)",
        "properties": '<xacro:property name="p%" value="${1 + %}"/>',
        "macros": '<xacro:macro name="m%"><x/></xacro:macro>',
        "arguments": '<xacro:arg name="a%" default="1"/>',
        "expressions": '<x a="${% * 2}"/>',
        "includes": '<xacro:include filename="f%.xacro"/>',
        "patterns": '<xacro:include filename="f%*.xacro"/>',
        "conditions": '<xacro:if value="${1 == %}"><x/></xacro:if>',
    },
)
_FORMATS = {
    "URDF": _URDF,
    "broken XML": _BROKEN,
    "a link of URDF": _URDF_LINK,
    "SDF": _SDF,
    "a link of SDF": _SDF_LINK,
    "a world": _WORLD,
    "xacro": _XACRO,
}


def _repeat(form: _Format, part: str, *, alike: bool, end: str, size: int = SIZE) -> str:
    each = part + end
    count = size // len(each.replace("%", "12345"))
    inside = each.replace("%", "1") * count if alike else "".join(each.replace("%", str(n)) for n in range(count))
    return form.before + end + inside + form.behind


def _nest(before: str, opened: str, closed: str, behind: str, levels: int) -> str:
    return before + opened * levels + closed * levels + behind


def _repeated() -> Iterator[tuple[str, Costly]]:
    shapes = (("of their own names", False, ""), ("of one name", True, ""), ("on lines", False, "\n"))
    for (where, form), (shape, alike, end) in product(_FORMATS.items(), shapes):
        for name, part in form.parts.items():
            if "%" in part or shape != "of one name":
                yield (
                    f"{where}: {name} {shape}",
                    Costly(form.suffix, partial(_repeat, form, part, alike=alike, end=end)),
                )


def link_with(inside: str) -> str:
    """A robot of URDF whose one link has this in it."""
    return f'<robot name="r"><link name="a">{inside}</link></robot>'


def model_with(inside: str) -> str:
    """A model of SDF with this in it, before its link."""
    return f'<sdf version="1.11"><model name="m">{inside}<link name="a"/></model></sdf>'


_LONG: dict[str, tuple[str, Callable[[str], str]]] = {
    "a mass": ("urdf", lambda text: link_with(f'<inertial><mass value="{text}"/></inertial>')),
    "an origin": ("urdf", lambda text: link_with(f'<visual><origin xyz="{text}"/>{_SHAPE}</visual>')),
    "a color": (
        "urdf",
        lambda text: f'<robot name="r"><link name="a"/><material name="m"><color rgba="{text}"/></material></robot>',
    ),
    "an unknown attribute": ("urdf", lambda text: link_with(f'<x y="{text}"/>')),
    "a setting": ("urdf", lambda text: f'<robot name="r"><link name="a"/><gazebo><x>{text}</x></gazebo></robot>'),
    "a file name": (
        "urdf",
        lambda text: link_with(f'<visual><geometry><mesh filename="package://{text}"/></geometry></visual>'),
    ),
    "a version": ("urdf", lambda text: f'<robot name="r" version="{text}"><link name="a"/></robot>'),
    "a type": ("urdf", lambda text: f'<robot name="r"><link name="a"/><joint name="j" type="{text}"/></robot>'),
    "a name": ("urdf", lambda text: f'<robot name="r"><link name="{text}"/></robot>'),
    "a reference": ("urdf", lambda text: f'<robot name="r"><link name="a"/><gazebo reference="{text}"/></robot>'),
    "a comment": ("urdf", lambda text: f'<robot name="r"><!-- {text} --><link name="a"/></robot>'),
    "a suppression": ("urdf", lambda text: f'<robot name="r"><!-- twinform: allow {text} --><link name="a"/></robot>'),
    "an instruction": ("urdf", lambda text: f'<robot name="r"><?p {text}?><link name="a"/></robot>'),
    "a pose": ("sdf", lambda text: model_with(f"<pose>{text}</pose>")),
    "a static": ("sdf", lambda text: model_with(f"<static>{text}</static>")),
    "a URI": ("sdf", lambda text: model_with(f"<include><uri>{text}</uri></include>")),
    "a plugin's file": ("sdf", lambda text: model_with(f'<plugin name="p" filename="{text}"/>')),
    "a relative_to": ("sdf", lambda text: model_with(f'<frame name="f"><pose relative_to="{text}"/></frame>')),
    "an unknown element of SDF": ("sdf", lambda text: model_with(f"<x>{text}</x>")),
    "a version of SDF": ("sdf", lambda text: f'<sdf version="{text}"><model name="m"><link name="a"/></model></sdf>'),
    "an expression": ("urdf.xacro", lambda text: f'{_XACRO_BEFORE}<x a="${{{text}}}"/></robot>'),
    "a package": ("urdf.xacro", lambda text: f'{_XACRO_BEFORE}<x a="$(find {text})"/></robot>'),
    "an include": ("urdf.xacro", lambda text: f'{_XACRO_BEFORE}<xacro:include filename="{text}"/></robot>'),
    "a variable": ("urdf.xacro", lambda text: f'{_XACRO_BEFORE}<x a="$(optenv {text} 0)"/></robot>'),
    "parameters": ("urdf.xacro", lambda text: f'{_XACRO_BEFORE}<xacro:macro name="m" params="{text}"/></robot>'),
}
_TEXTS = {
    "digits": "9",
    "numbers": "1 ",
    "commas": "1,",
    "points": "1.",
    "minus signs": "-",
    "blanks": " ",
    "line ends": "\n",
    "tabs": "1\t",
    "letters": "a",
    "slashes": "a/",
    "colons": "a::",
    "units": "1m ",
    "exponents": "1e",
    "zeros": "0",
    "wildcards": "*a",
    "brackets": "[",
    "references": "&#48;",
    "dots up": "../",
    "percent signs": "%41",
    "braces": "{",
    "quotes": "'",
}


def _filled(make: Callable[[str], str], text: str) -> str:
    return make(text * (SIZE // len(text)) + "x")


def _long() -> Iterator[tuple[str, Costly]]:
    for (where, (suffix, make)), (what, text) in product(_LONG.items(), _TEXTS.items()):
        yield (
            f"{where} of {what}",
            Costly(suffix, partial(_filled, make, text)),
        )


def _deep() -> Iterator[tuple[str, Costly]]:
    """Elements in each other, as deep as they may be."""
    levels = 200
    yield "elements in each other", Costly("urdf", lambda: _nest('<robot name="r">', "<x>", "</x>", "</robot>", levels))
    yield (
        "links in each other",
        Costly("urdf", lambda: _nest("<robot>", '<link name="a">', "</link>", "</robot>", levels)),
    )
    yield (
        "models in each other",
        Costly("sdf", lambda: _nest('<sdf version="1.11">', '<model name="m">', "</model>", "</sdf>", 60)),
    )
    many = '<link name="a"/>' * 100
    yield (
        "models with many links in each other",
        Costly("sdf", lambda: _nest('<sdf version="1.11">', f'<model name="m">{many}', "</model>", "</sdf>", 60)),
    )


DOCUMENTS: Mapping[str, Costly] = {**dict(_repeated()), **dict(_long()), **dict(_deep())}
