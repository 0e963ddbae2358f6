"""What has to come back from the other format, and what is reported where it does not."""

import pytest

import twinform
from twinform.testing import assert_round_trip
from twinform.testing.round_trips import ANOTHER_ROBOT, RoundTrip

URDF = """<robot name="r" version="1.1">
  <link name="a"/>
  <link name="b"/>
  <joint name="j" type="fixed"><parent link="a"/><child link="b"/><origin xyz="1 0 0"/></joint>
</robot>"""
MODEL = '<model name="{}"><link name="l"><pose>0 0 {} 0 0 0</pose></link></model>'
WORLD = f'<sdf version="1.6"><world name="w">{MODEL.format("m", 1)}{MODEL.format("n", 2)}</world></sdf>'


def _trip(text: str, model: str | None = None) -> RoundTrip:
    return RoundTrip.of(text.encode(), twinform.loads(text), model=model)


def test_what_comes_back_as_it_was_has_no_mismatch() -> None:
    assert list(_trip(URDF).mismatches(URDF.replace("1 0 0", "1.0 0 0"))) == []


def test_another_robot_is_found_first_and_then_the_parts_that_make_it() -> None:
    robot, place = _trip(URDF).mismatches(URDF.replace("1 0 0", "1 0 0.5"))
    assert robot.kind == ANOTHER_ROBOT
    assert "0.5" in robot.message
    assert (place.kind, place.path) == ("changed", "/robot[@name='r']/joint[@name='j']/origin")


def test_a_name_that_nobody_gave_is_found() -> None:
    (found,) = _trip(URDF).mismatches(
        URDF.replace('<link name="a"/>', '<link name="a"><tf:x xmlns:tf="urn:twinform:1"/></link>')
    )
    assert (found.kind, found.path) == ("left over", "/robot[@name='r']/link[@name='a']/tf:x")


def test_of_a_world_the_model_alone_has_to_come_back() -> None:
    text = _trip(WORLD, "w::n").text.decode()
    assert ['"n"' in text, '"m"' in text, "world" in text] == [True, False, False]
    assert list(_trip(WORLD, "n").mismatches(f'<sdf version="1.6">{MODEL.format("n", 2)}</sdf>')) == []


@pytest.mark.parametrize("version", ["1.4", "1.6", "1.9", "1.12"])
def test_it_comes_back_in_the_version_that_it_went_in(version: str) -> None:
    text = f'<sdf version="{version}">{MODEL.format("m", 1)}</sdf>'
    back = _trip(text).back(twinform.convert(text.encode(), to="urdf").text)
    assert twinform.loads(back).version == version


def test_urdf_comes_back_in_its_version_too() -> None:
    assert 'version="1.1"' in _trip(URDF).back(twinform.convert(URDF.encode(), to="sdf").text)


def test_what_does_not_come_back_as_it_was_fails_the_round_trip(monkeypatch: pytest.MonkeyPatch) -> None:
    assert_round_trip(URDF, via="sdf")

    def rename(*_: object) -> str:
        return URDF.replace('"j"', '"k"')

    monkeypatch.setattr(RoundTrip, "back", rename)
    with pytest.raises(AssertionError, match=r"as it was:(.|\n)*<joint name=\"j\" type=\"fixed\"> is not back"):
        assert_round_trip(URDF, via="sdf")


def test_what_is_refused_in_the_conversion_back_fails_the_round_trip(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object) -> str:
        return twinform.convert(b"<robot/>", to="urdf").text

    monkeypatch.setattr(RoundTrip, "back", refuse)
    with pytest.raises(AssertionError, match="does not come back from sdf:"):
        assert_round_trip(URDF, via="sdf")
