"""Classes of defaults in written MJCF: what may stand in them, and that they say the same as before."""

from lxml import etree

import twinform
from twinform.compiler.input.load_options import LoadOptions
from twinform.compiler.input.mjcf.normalize import normalize
from twinform.diagnostics import DiagnosticSink
from twinform.schemas import Context, XmlElement, known_version, versions_of

_URDF = """<robot name="r">
  <link name="a">
    <visual><geometry><box size="1 1 1"/></geometry></visual>
    <visual><geometry><sphere radius="1"/></geometry></visual>
    <collision><geometry><box size="1 1 1"/></geometry></collision>
    <collision><geometry><box size="1 1 2"/></geometry></collision>
  </link>
</robot>"""


def _texts(source: str) -> tuple[str, str]:
    """The MJCF of a source without classes and with them."""
    plain, factored = (
        twinform.convert(source.encode(), to="mjcf", passes="check-inertia", default_classes=each).text
        for each in (False, True)
    )
    return plain, factored


def _written(source: str) -> XmlElement:
    return etree.fromstring(_texts(source)[1].encode())


def _canonical(text: str) -> bytes:
    sink = DiagnosticSink()
    version = known_version("mjcf", versions_of("mjcf")[-1])
    assert version is not None
    tree = normalize(etree.fromstring(text.encode()), Context(sink, "", "mjcf", version), LoadOptions())
    assert tree is not None
    for element in tree.iter("*"):
        element[:] = sorted(element, key=lambda each: str(each.tag)) if element is tree else element[:]
        attributes = sorted(element.attrib.items())
        element.attrib.clear()
        element.attrib.update(attributes)
    return etree.tostring(tree)


def _model(geoms: str = "", joints: str = "") -> str:
    return (
        "<mujoco model='m'><worldbody><body name='a'><geom name='g' size='1'/>"
        f"<body name='b'>{joints}<geom name='h' size='1'/>{geoms}</body></body></worldbody></mujoco>"
    )


def test_shapes_that_are_seen_and_touched_have_a_class_each() -> None:
    tree = _written(_URDF)
    classes = {each.get("class"): dict(each[0].attrib) for each in tree.iterfind("default/default")}
    assert classes == {
        "visual": {"contype": "0", "conaffinity": "0", "group": "2", "density": "0"},
        "collision": {"type": "box", "group": "3"},
    }
    geoms = [(each.get("class"), each.get("group")) for each in tree.iterfind("worldbody//geom")]
    assert sorted(geoms) == [("collision", None)] * 2 + [("visual", None)] * 2


def test_without_the_option_there_are_no_classes() -> None:
    assert "<default" not in twinform.convert(_URDF.encode(), to="mjcf").text


def test_classes_say_what_the_elements_said() -> None:
    for text in (_URDF, _model("<geom name='i' size='2' rgba='1 0 0 1'/>", "<joint name='j' damping='1'/>")):
        plain, factored = _texts(text)
        assert factored != plain
        assert _canonical(factored) == _canonical(plain)


def test_what_one_element_lacks_is_in_no_class() -> None:
    joints = "<joint name='j' type='slide' damping='1'/><joint name='k' type='slide' axis='1 0 0' damping='1'/>"
    more = "<body name='c'><joint name='l' type='slide'/><geom name='n' size='1'/></body>"
    tree = _written(_model(more, joints))
    (joint,) = tree.iterfind("default/joint")
    assert (joint.get("type"), joint.get("damping")) == ("slide", None)


def test_lists_of_different_lengths_are_in_no_class() -> None:
    geoms = "".join(
        f"<geom name='s{n}' size='1' friction='{friction}'/>" for n, friction in enumerate(("1", "1", "1 2"))
    )
    text = _model(geoms).replace("size='1'/>", "size='1' friction='1'/>")
    plain, factored = _texts(text)
    assert _canonical(factored) == _canonical(plain)


def test_joints_have_no_class_where_more_are_made_of_a_flexcomp() -> None:
    joints = "<joint name='j' type='slide' axis='1 0 0' damping='1'/><joint name='k' type='slide' damping='1'/>"
    flex = "<flexcomp name='f' type='grid' count='3 3 1' dim='2' mass='1'/>"
    assert _written(_model(joints=joints)).find("default/joint") is not None
    assert _written(_model(flex, joints)).find("default/joint") is None
