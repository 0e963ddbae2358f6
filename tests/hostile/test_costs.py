"""What costs more than its size: documents that repeat something, long values, and patterns of paths."""

from pathlib import Path

import pytest

from tests.hostile.child import rules, twinform
from tests.hostile.costly_documents import DOCUMENTS, SIZE, link_with, model_with
from tests.profile import DEEP

_SECONDS = 3 if DEEP else 4
_ONCE_DEAR = (
    "URDF: links of one name",
    "URDF: stray texts of one name",
    "URDF: transmissions without anything of their own names",
    "broken XML: two colons of one name",
    "broken XML: open comments of their own names",
    "broken XML: broken numbers of their own names",
)
_NAMES = tuple(DOCUMENTS) if DEEP else (*_ONCE_DEAR, *list(DOCUMENTS)[::100])


@pytest.mark.parametrize("name", _NAMES)
def test_a_document_costs_no_more_than_its_size(name: str, tmp_path: Path) -> None:
    document = DOCUMENTS[name]
    (tmp_path / f"robot.{document.suffix}").write_text(document.make())
    outcome = twinform("check", f"robot.{document.suffix}", folder=tmp_path, seconds=_SECONDS)
    assert outcome.code in {0, 1, 2}, outcome.output[-2000:]
    assert "Traceback" not in outcome.output


@pytest.mark.parametrize("digits", [1_500, 30_000])
@pytest.mark.parametrize("end", ["", "x", " ", "e", ".."])
def test_a_number_of_many_digits_is_not_guessed_at_for_long(digits: int, end: str, tmp_path: Path) -> None:
    """The first took 35 seconds, and a file with more of them minutes."""
    number = "9" * digits + end
    (tmp_path / "r.urdf").write_text(
        f'<robot name="r"><link name="a"><inertial><mass value="{number}"/>'
        f'<inertia ixx="{number}" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link></robot>'
    )
    assert twinform("check", "r.urdf", folder=tmp_path).code in {0, 1, 2}


@pytest.mark.parametrize("pattern", ["*a" * 40 + "*b", "**/a*" * 40 + "b", "*[a]" * 40 + "b"])
@pytest.mark.parametrize("where", [".gitignore", "twinform.toml", "the command line"])
def test_a_pattern_of_paths_is_done_with_a_long_name_at_once(pattern: str, where: str, tmp_path: Path) -> None:
    (tmp_path / ".git").mkdir()
    name = "a" * 240 + ".urdf"
    (tmp_path / name).write_text('<robot name="r"><link name="a"/></robot>')
    texts = {".gitignore": pattern, "twinform.toml": f'exclude = ["{pattern}"]'}
    if where in texts:
        (tmp_path / where).write_text(texts[where])
    outcome = twinform("check", "." if where in texts else f"{pattern}.urdf", folder=tmp_path)
    assert (name in str(outcome.opened)) is (where in texts)
    assert outcome.code == (0 if where in texts else 2), outcome.output


_SECONDS_OF_COMMAND = 12 if DEEP else 4
"""The deep documents are four times as large. What grew with the square of the size took minutes for them."""
_ONCE_DEAR_TO = (
    ("diff", "a world: models of their own names"),
    ("diff", "URDF: tree of their own names"),
    ("diff", "URDF: joints with transmissions of their own names"),
    ("diff", "SDF: links of their own names"),
    ("diff", "SDF: includes of their own names"),
    ("convert", "SDF: includes of their own names"),
    ("check --fix --diff", "broken XML: undeclared prefixes of their own names"),
    ("check --fix --diff", "broken XML: late declarations of their own names"),
)


@pytest.mark.parametrize(("command", "name"), _ONCE_DEAR_TO)
def test_no_command_costs_more_than_the_size_of_its_document(command: str, name: str, tmp_path: Path) -> None:
    document = DOCUMENTS[name]
    file = f"robot.{document.suffix}"
    (tmp_path / file).write_text(document.make())
    files = [file, file] if command == "diff" else [file]
    outcome = twinform(*command.split(), *files, folder=tmp_path, seconds=_SECONDS_OF_COMMAND)
    assert outcome.code in {0, 1, 2}, outcome.output[-2000:]
    assert "Traceback" not in outcome.output


def _shapes(name: str, width: int) -> str:
    box = '<visual{}><geometry><box size="{} 1 {}"/></geometry></visual>'
    each = (box.format(name.replace("%", str(n)), width, n + 1) for n in range(SIZE // 100))
    return link_with("".join(each))


@pytest.mark.parametrize("name", ["", ' name="v%"'])
def test_shapes_that_all_differ_are_not_each_held_against_each(name: str, tmp_path: Path) -> None:
    """Two files of 28 kB took 36 seconds."""
    (tmp_path / "a.urdf").write_text(_shapes(name, 1))
    (tmp_path / "b.urdf").write_text(_shapes(name, 2))
    outcome = twinform("diff", "a.urdf", "b.urdf", folder=tmp_path, seconds=_SECONDS_OF_COMMAND)
    assert (outcome.code, outcome.output.count("box/size is")) == (1, SIZE // 100)


def test_frames_that_only_one_file_has_are_looked_for_once(tmp_path: Path) -> None:
    """Each was held against each frame of its file: 4,000 in each of two files took seven seconds."""
    count = SIZE // 25
    own, shared = (
        "".join(f'<frame name="{name}{n}"><pose>{n} 0 0 0 0 0</pose></frame>' for n in range(0, count, step))
        for name, step in (("a", 1), ("s", 2))
    )
    (tmp_path / "a.sdf").write_text(model_with(own + shared))
    (tmp_path / "b.sdf").write_text(model_with(shared))
    outcome = twinform("diff", "a.sdf", "b.sdf", folder=tmp_path, seconds=_SECONDS_OF_COMMAND)
    assert (outcome.code, outcome.output.count(" is where frame 's")) == (1, count // 2)


_MANY = {
    "numbers in an attribute": (
        "urdf",
        link_with('<visual><origin xyz="%"/></visual>'),
        "1 ",
        3_000_000,
        "invalid-value",
    ),
    "numbers in an element": ("sdf", model_with("<pose>%</pose>"), "1 ", 3_000_000, "invalid-value"),
    "elements in one": ("urdf", link_with("%"), "<x/>", 200_000, "oversized-file"),
    "materials in one": ("urdf", '<robot name="r">%</robot>', '<material name="m"/>', 200_000, "oversized-file"),
}


@pytest.mark.parametrize("name", _MANY)
def test_a_great_many_of_one_thing_are_refused_before_they_are_read(name: str, tmp_path: Path) -> None:
    """Three million numbers took 12 seconds and 470 MB."""
    suffix, around, one, count, rule = _MANY[name]
    (tmp_path / f"robot.{suffix}").write_text(around.replace("%", one * count))
    outcome = twinform("check", f"robot.{suffix}", folder=tmp_path, seconds=3)
    assert rules(outcome.output) == [rule], outcome.output[:2000]


_DEAR_TO_ANSWER = {
    "variables": (
        "".join(f'<x a="$(optenv N{n} 0)"/>' for n in range(30_000)),
        "5,000 files, packages and variables",
    ),
    "files": (
        "".join(f'<xacro:include filename="{n}.xacro" optional="true"/>' for n in range(30_000)),
        "5,000 files, packages",
    ),
    "patterns": (
        "".join(f'<xacro:include filename="{n}*.xacro" optional="true"/>' for n in range(30_000)),
        "more than 1,000 things",
    ),
    "a long pattern": (f'<xacro:include filename="{"*a" * 500_000}b"/>', "more than 4,096 characters"),
    "a long path": (f'<xacro:include filename="{"a/" * 500_000}"/>', "more than 4,096 characters"),
    "a long package": (f'<x a="$(find {"a" * 1_000_000})"/>', "more than 4,096 characters"),
    "a long variable": (f'<x a="$(env {"a" * 1_000_000})"/>', "more than 4,096 characters"),
}


@pytest.mark.parametrize("name", _DEAR_TO_ANSWER)
def test_what_a_xacro_file_asks_for_is_counted(name: str, tmp_path: Path) -> None:
    """The process that expands had its limit; who answered it had none but the clock."""
    body, words = _DEAR_TO_ANSWER[name]
    start = '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro"><link name="a"/>'
    (tmp_path / "r.urdf.xacro").write_text(f"{start}\n{body}</robot>")
    outcome = twinform("check", "r.urdf.xacro", folder=tmp_path)
    assert (outcome.code, words in outcome.output) == (1, True), outcome.output[:2000]
    assert outcome.output.startswith("r.urdf.xacro:2:")
