"""Carriers are invisible to other programs' readers: whatever names and values they hold, nothing changes for them."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from lxml import etree

import twinform
from testbed.engines.readers import READERS, Reader
from testbed.engines.readers.judging import Effect, effect, without_carriers
from twinform.schemas import XmlElement

SDF_VERSION = "1.9"
"""The newest that libsdformat 12 reads."""
EXAMPLES = max(5, settings.default.max_examples // 20) if settings.default else 5
HARMLESS = {Effect.NONE, Effect.MENTIONED}
BODY = '<mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/>'
URDF = f"""<robot name="r"><link name="a"><inertial>{BODY}</inertial>
<visual><geometry><box size="1 1 1"/></geometry><material name="m"><color rgba="1 0 0 1"/></material></visual></link>
<link name="b"><inertial>{BODY}</inertial></link>
<joint name="j" type="continuous"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/></joint></robot>"""
# of a version in which unknown elements may have names with "::", as libsdformat takes them
SDF = """<sdf version="1.7"><model name="r"><link name="a"><pose>1 2 3 0.1 0.2 0.3</pose></link><link name="b"/>
<joint name="j" type="ball"><parent>a</parent><child>b</child></joint>
<frame name="f" attached_to="a"/></model></sdf>"""
ALPHABET = "ab:/.{}$()-_ 0é機\"'<&>"
VALUES = st.one_of(
    st.text(ALPHABET, max_size=8).filter(lambda text: "${" not in text),  # which is of xacro, and an error
    st.sampled_from(["", "::", "a::B", "world", "__model__", "j", "$a"]),
)


@st.composite
def pieces(draw: st.DrawFn, depth: int = 2) -> XmlElement:
    """An element that neither format knows where it will stand, with such elements inside."""
    element = etree.Element(draw(st.sampled_from(["foo", "bar", "actuator"])))
    for name in draw(st.sets(st.sampled_from(["name", "type", "k"]))):
        element.set(name, draw(VALUES))
    element.text = draw(VALUES) or None
    for _ in range(draw(st.integers(0, depth))):
        element.append(draw(pieces(depth=depth - 1)))
    return element


@pytest.fixture(scope="module", params=READERS, ids=lambda reader: reader.name)
def reader(request: pytest.FixtureRequest) -> Iterator[Reader]:
    chosen: Reader = request.param
    if not chosen.present():
        pytest.skip(f"{chosen.name} is not here: it needs {chosen.needs}")
    yield chosen
    chosen.close()


def _with(text: str, place: str, added: list[XmlElement]) -> bytes:
    root = etree.fromstring(text)
    for element in added:
        found = root.find(place) if place != "." else root
        assert found is not None
        found.append(element)
    return etree.tostring(root)


def _effect(reader: Reader, text: str, folder: Path, suffix: str) -> Effect:
    carried = folder / f"carried{suffix}"
    carried.write_text(text, encoding="utf-8")
    assert "urn:twinform:1" in text
    plain = without_carriers(carried, folder / f"plain{suffix}")
    return effect(reader, carried, reader.ask(plain))


ASKED = settings(max_examples=EXAMPLES, suppress_health_check=[HealthCheck.function_scoped_fixture], deadline=None)


@ASKED
@given(place=st.sampled_from([".", "link", "joint", "link/visual"]), added=st.lists(pieces(), min_size=1, max_size=3))
def test_carriers_in_sdf_change_nothing_for_a_reader(
    place: str, added: list[XmlElement], reader: Reader, tmp_path: Path
) -> None:
    if ".sdf" not in reader.formats:
        pytest.skip(f"{reader.name} does not read SDF")
    result = twinform.convert(_with(URDF, place, added), to="sdf", sdf_version=SDF_VERSION)
    assert _effect(reader, result.text, tmp_path, ".sdf") in HARMLESS


@ASKED
@given(place=st.sampled_from(["model", "model/link", "model/joint"]), added=st.lists(pieces(), min_size=1, max_size=3))
def test_carriers_in_urdf_change_nothing_for_a_reader(
    place: str, added: list[XmlElement], reader: Reader, tmp_path: Path
) -> None:
    if ".urdf" not in reader.formats:
        pytest.skip(f"{reader.name} does not read URDF")
    result = twinform.convert(_with(SDF, place, added), to="urdf")
    assert _effect(reader, result.text, tmp_path, ".urdf") in HARMLESS


def test_a_reader_that_minds_is_found_out(tmp_path: Path) -> None:
    mindful = next(each for each in READERS if each.name == "libsdformat")
    if not mindful.present():
        pytest.skip(mindful.needs)
    # an empty attribute is what carriers avoid
    text = twinform.convert(URDF.encode(), to="sdf", sdf_version=SDF_VERSION).text
    annotated = text.replace("</model>", '<tf:urdf><material name=""/></tf:urdf></model>')
    assert _effect(mindful, annotated, tmp_path, ".sdf") is Effect.OTHERWISE
    mindful.close()
