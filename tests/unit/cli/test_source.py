from pathlib import Path

import pytest

from twinform.cli.source import InputSource

CASES = [
    (b"<robot name='a'/>", "urdf"),
    (b"\xef\xbb\xbf<?xml version='1.0'?>\n<!-- <sdf> -->\n<robot>", "urdf"),
    (b"<!DOCTYPE x><sdf version='1.6'>", "sdf"),
    (b"<sdf\nversion='1.6'>", "sdf"),
    (b"<sdf/>", "sdf"),
    (b" {}", "json"),
    (b"<mujoco/>", None),
    (b"<!-- no end <robot>", None),
    (b"<!--" * 20000, None),
    (b"<", None),
    (b"", None),
]


@pytest.mark.parametrize(("text", "format_"), CASES)
def test_format_is_that_of_the_root_element(text: bytes, format_: str | None) -> None:
    assert InputSource(text, "<stdin>").format == format_


@pytest.mark.parametrize(
    ("name", "format_"),
    [("a.urdf", "urdf"), ("b.WORLD", "sdf"), ("c.json", "json"), ("d.xml", None), ("e\0.sdf", "sdf")],
)
def test_format_of_a_file_that_tells_nothing_is_that_of_its_suffix(
    name: str, format_: str | None, tmp_path: Path
) -> None:
    assert InputSource(str(tmp_path / name), name).format == format_


def test_content_counts_more_than_the_suffix(tmp_path: Path) -> None:
    file = tmp_path / "robot.sdf"
    file.write_text("<robot name='a'/>")
    assert InputSource(str(file), str(file)).format == "urdf"
