"""Whatever the names in a model are, they are data in each file of its package, and no file means anything else."""

import ast
import re
from collections.abc import Mapping
from functools import cache

import yaml
from hypothesis import given, reject
from hypothesis import strategies as st
from lxml import etree

from testbed.ros2.judges import yaml_problems
from tests.profile import examples
from twinform.compiler import CompileError
from twinform.compiler.input.loading import LoadOptions
from twinform.compiler.packaging.kinds import build
from twinform.compiler.packaging.order import Built, Order, PackageDetails
from twinform.compiler.request import ConversionRequest

_HOOKS = ("env-hooks/gazebo_resource_path.dsv.in", "env-hooks/gazebo_resource_path.sh.in")
HOSTILE = (
    "<script>alert(1)</script>", '"; rm -rf ~ #', "'; import os; os.abort()  # '", "a\nb", "../../etc/passwd", "$1",
    "$(rm -rf ~)", "`id`", "{{robot}}", "%s", "yes", "null", "nan", "1e3", "0x10", ".inf", "- a", "a: b", "# a", "&a",
    "*a", "!a", "| a", "]]>", "&amp;", "@PROJECT_NAME@", "\\", "\\u0041", "é", "名", "🤖", "\u2028", "\x85", "\ufeff",
    " a ", "a::b", "--ros-args", "''' + x + '''",
)  # fmt: skip
NAMES = st.sampled_from(HOSTILE) | st.text(
    st.characters(codec="utf-8", exclude_categories=["Cs"], exclude_characters="\ufffe\uffff").filter(
        lambda character: character >= " " or character in "\t\n"
    ),
    min_size=1,
    max_size=20,
)
"""Any text that XML can have."""
TEXTS = NAMES.filter(str.strip)


@examples(0.3)
@given(names=st.lists(NAMES, min_size=9, max_size=9, unique=True), details=st.tuples(TEXTS, TEXTS, TEXTS))
def test_names_are_data_in_every_file(names: list[str], details: tuple[str, str, str]):
    try:
        built = _package(_robot(*names), *details)
    except CompileError:
        reject()  # such a model is refused, and no file is written
    texts = _texts(built)
    assert {path for path in texts if not path.startswith(("config/", "launch/"))} == {
        "CMakeLists.txt", "package.xml", "rviz/robot.rviz", "urdf/robot.urdf", "worlds/robot.sdf", *_HOOKS
    }  # fmt: skip
    robot, base, _, _, wheel, arm, sensor, _, topic = names  # texts of elements lose the spaces around them
    _check_python(texts, robot)
    _check_yaml(texts, base, wheel, arm, sensor, topic)
    _check_the_rest(texts, details)


def _check_python(texts: Mapping[str, str], robot: str) -> None:
    for path in ("launch/display.launch.py", "launch/gazebo.launch.py"):
        found, other = ast.parse(texts[path]), ast.parse(_plain_texts()[path])
        for each in ast.walk(found):
            if isinstance(each, ast.Assign) and ast.unparse(each.targets[0]) == "ROBOT":
                assert ast.literal_eval(each.value) == robot
        strings = ("ROBOT", "CONTROLLERS")
        assert ast.dump(_without(found, strings)) == ast.dump(_without(other, strings))


def _without(module: ast.Module, names: tuple[str, ...]) -> ast.Module:
    """Python without the assignments of some constants, which must be literals."""
    for each in list(module.body):
        if isinstance(each, ast.Assign) and ast.unparse(each.targets[0]) in names:
            ast.literal_eval(each.value)
            module.body.remove(each)
    return module


def _check_yaml(texts: Mapping[str, str], base: str, wheel: str, arm: str, sensor: str, topic: str) -> None:
    for path, text in texts.items():
        if path.endswith((".yaml", ".rviz")):
            assert yaml_problems(text) == []
    controllers = yaml.safe_load(texts["config/controllers.yaml"])
    parameters = [each["ros__parameters"] for name, each in controllers.items() if name != "controller_manager"]
    assert {"joints": [wheel], "interface_name": "velocity"} in parameters
    assert {"joints": [arm], "command_interfaces": ["position"], "state_interfaces": ["position"]} in parameters
    assert {"sensor_name": sensor, "frame_id": base.strip()} in parameters
    manager = controllers["controller_manager"]["ros__parameters"]
    assert all(name.isidentifier() and name.isascii() for name in manager)
    assert yaml.safe_load(texts["rviz/robot.rviz"])["Visualization Manager"]["Global Options"]["Fixed Frame"] == base
    written = "/" + "/".join(filter(None, f"t{topic}t".split("/")))
    topics = [each["gz_topic_name"] for each in yaml.safe_load(texts["config/bridge.yaml"])]
    valid = re.sub(r"[@~]|:=", "", written.replace(" ", "_"))  # TopicUtils.cc, AsValidTopic
    assert any(topics == ["/clock", each] or set(topics[1:]) == {each, f"{each}/points"} for each in (written, valid))


def _check_the_rest(texts: Mapping[str, str], details: tuple[str, str, str]) -> None:
    manifest = etree.fromstring(texts["package.xml"].encode())
    maintainer = manifest.find("maintainer")
    assert maintainer is not None
    found = (manifest.findtext("description"), maintainer.text, manifest.findtext("license"))
    assert found == tuple(" ".join(text.split()) for text in details)
    assert [child.tag for child in manifest if isinstance(child.tag, str)][:6] == [
        "name", "version", "description", "maintainer", "license", "buildtool_depend",
    ]  # fmt: skip
    for path in ("CMakeLists.txt", *_HOOKS):
        assert texts[path] == _plain_texts()[path]
    etree.fromstring(texts["worlds/robot.sdf"].encode())


@cache
def _plain_texts() -> dict[str, str]:
    """The files of a robot with plain names."""
    return _texts(_package(_robot("robot", "b", "c", "d", "e", "f", "g", "h", "i"), "", "", ""))


def _texts(built: Built) -> dict[str, str]:
    return {path: content.decode() for path, content in built.package.files.items() if isinstance(content, bytes)}


def _package(urdf: bytes, description: str, maintainer: str, license_: str) -> Built:
    details = PackageDetails(description=description, maintainer=maintainer, email="a@example.org", license=license_)
    order = Order(
        source=urdf,
        source_name="robot.urdf",
        name="robot",
        folder="robot",
        conversion=ConversionRequest(to="urdf"),
        load_options=LoadOptions(),
        details=details,
    )
    return build(order, ("ros2",))


def _robot(
    name: str, base: str, rim: str, link: str, wheel: str, arm: str, sensor: str, system: str, topic: str
) -> bytes:
    """A robot with these names: two links on a base, a system of ros2_control, and a lidar with a topic."""
    robot = etree.Element("robot", name=name)
    for each in (base, rim, link):
        inertial = etree.SubElement(etree.SubElement(robot, "link", name=each), "inertial")
        etree.SubElement(inertial, "mass", value="1")
        inertia = {f"i{axes}": "1" if axes[0] == axes[1] else "0" for axes in ("xx", "xy", "xz", "yy", "yz", "zz")}
        etree.SubElement(inertial, "inertia", inertia)
    for joint, child, kind in ((wheel, rim, "continuous"), (arm, link, "revolute")):
        added = etree.SubElement(robot, "joint", name=joint, type=kind)
        etree.SubElement(added, "parent", link=base)
        etree.SubElement(added, "child", link=child)
        etree.SubElement(added, "axis", xyz="0 1 0")
        etree.SubElement(added, "limit", lower="-1", upper="1", effort="1", velocity="1")
    control = etree.SubElement(robot, "ros2_control", name=system, type="system")
    etree.SubElement(etree.SubElement(control, "hardware"), "plugin").text = "gz_ros2_control/GazeboSimSystem"
    for joint, interface in ((wheel, "velocity"), (arm, "position")):
        added = etree.SubElement(control, "joint", name=joint)
        etree.SubElement(added, "command_interface", name=interface)
        etree.SubElement(added, "state_interface", name="position")
    force = etree.SubElement(control, "sensor", name=sensor)
    etree.SubElement(force, "state_interface", name="force.x")
    etree.SubElement(force, "param", name="frame_id").text = base
    lidar = etree.SubElement(etree.SubElement(robot, "gazebo", reference=base), "sensor", name=sensor, type="gpu_lidar")
    etree.SubElement(lidar, "topic").text = f"t{topic}t"
    return etree.tostring(robot)
