"""Whatever stands in a plugin, the migration ends with a valid file, and a second one changes nothing."""

from hypothesis import given, settings
from hypothesis import strategies as st
from lxml import etree

import twinform
from twinform.passes.classic.tables import migrations

PIPELINE = "migrate-gazebo-classic{{release={}}}"
TEXTS = [
    "",
    "0",
    "1",
    "-1.5",
    "1e400",
    "nan",
    "true",
    "False",
    "abc",
    "1 2 3",
    "0 0 0",
    "/a//b/",
    "~/out",
    "base",
    "hip",
    "ü",
]
FILES = sorted({f"lib{file}.so" for migration in migrations().values() for file in migration.files})
NAMES = sorted({name for migration in migrations().values() for name in migration.parameters})
RELEASES = ["fortress", "garden", "harmonic", "ionic", "jetty"]
SENSORS = ["camera", "depth", "ray", "gpu_ray", "gps", "imu", "contact", "multicamera", "sonar", "force_torque"]
URDF = (
    '<robot name="r"><link name="base"/><link name="leg"/><joint name="hip" type="continuous"><parent link="base"/>'
    '<child link="leg"/><axis xyz="0 0 1"/></joint><gazebo{}>{}</gazebo></robot>'
)
WORLD = (
    '<sdf version="1.6"><world name="w"><model name="r"><link name="base">{}</link>{}</model>{}</world></sdf>'
)  # fmt: skip


@st.composite
def plugins(draw: st.DrawFn) -> str:
    element = etree.Element(
        "plugin", name=draw(st.sampled_from(["p", "ü", "a b"])), filename=draw(st.sampled_from(FILES))
    )
    for name, text in draw(st.lists(st.tuples(st.sampled_from(NAMES), st.sampled_from(TEXTS)), max_size=6)):
        etree.SubElement(element, name).text = text
    if draw(st.booleans()):
        ros = etree.SubElement(element, "ros")
        etree.SubElement(ros, "namespace").text = draw(st.sampled_from(TEXTS))
        etree.SubElement(ros, "remapping").text = draw(st.sampled_from(["a:=b", ":=", "~/out:=~/x", "odom:=/o", "x"]))
    return etree.tostring(element, encoding="unicode")


@st.composite
def files(draw: st.DrawFn) -> tuple[str, str]:
    plugin = draw(plugins())
    sensor = f'<sensor name="s" type="{draw(st.sampled_from(SENSORS))}">{plugin}</sensor>'
    if draw(st.booleans()):
        inside = draw(st.sampled_from([("", plugin), (' reference="base"', sensor), (' reference="hip"', sensor)]))
        return "urdf", URDF.format(*inside)
    return "sdf", WORLD.format(
        *draw(st.permutations([sensor, plugin, ""]).filter(lambda at: at[0] != plugin and sensor not in at[1:]))
    )


@settings(max_examples=100, deadline=None)
@given(files(), st.sampled_from(RELEASES))
def test_any_plugin_becomes_a_valid_file_that_stays_as_it_is(file: tuple[str, str], release: str) -> None:
    language, text = file
    to, passes = ("urdf" if language == "urdf" else "sdf"), PIPELINE.format(release)
    if not twinform.check(text.encode()).accepted:
        return
    once = twinform.convert(text.encode(), to=to, passes=passes)
    assert twinform.check(once.text.encode()).accepted
    assert twinform.convert(once.text.encode(), to=to, passes=passes).text == once.text
