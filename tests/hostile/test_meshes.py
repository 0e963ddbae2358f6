"""Mesh files that may be anybody's: each is passed over with a word, or counted, for little time and memory."""

from collections.abc import Iterable
from pathlib import Path

import pytest

from tests.hostile.child import Outcome, twinform
from tests.hostile.meshes import MESHES
from tests.snippets import INERTIAL

_SECONDS = 8
"""Of the processor for each process, of which one reads all meshes; alone, none may take more than three."""
_SHAPE = '<{0}><geometry><mesh filename="{1}"/></geometry></{0}>'
_JOINT = '<joint name="j{0}" type="fixed"><parent link="l0"/><child link="l{0}"/></joint>'
_SAID = {
    "nodes that double 17 times": "its nodes place 131,072 parts, of which 5,000 are read at most",
    "nodes that double 60 times": "its nodes place 1,152,921,504,606,846,976 parts",
    "nodes a hundred times in each other": "its nodes place 10,000,000,000,000,000 parts",
    "a node of itself": "its node 'n' is a part of itself",
    "two nodes of each other": "its node 'n' is a part of itself",
    "a chain of 20,000 nodes": "its nodes are nested more than 200 deep",
    "20,000 nodes beside each other": "its nodes place 20,000 parts",
    "a large part 2,000 times": "bytes of parts, in a file that has",
    "entities of entities": "it declares a document type",
    "an entity of a file": "it declares a document type",
    "a document type in UTF-16": "it is not in UTF-8",
    "a face of 1.5 million corners": "it has a face with more than 1,000 corners",
    "a face of 1.5 million corners in many lines": "it has a face with more than 1,000 corners",
    "50,000 materials": "it changes its material more than 10,000 times",
    "4 thousand million points in GLB": "it needs more memory than it may have",
    "5,000 times the same points": "it needs more memory than it may have",
    "100,000 nodes in GLB": "it has more than 10,000 nodes",
}
"""What is said of those that are refused before anything is made of them."""


def _robot(folder: Path, names: Iterable[str]) -> dict[str, str]:
    """A robot with a link for each mesh, as `a.urdf`; the file of each."""
    files: dict[str, str] = {}
    for number, name in enumerate(names):
        kind, make = MESHES[name]
        files[name] = f"{number:03}.{kind}"
        (folder / files[name]).write_bytes(make())
    shapes = ["".join(_SHAPE.format(tag, file) for tag in ("visual", "collision")) for file in files.values()]
    links = "".join(f'<link name="l{number}">{INERTIAL}{each}</link>' for number, each in enumerate(shapes))
    joints = "".join(_JOINT.format(number) for number in range(1, len(files)))
    (folder / "a.urdf").write_text(f'<robot name="a">{links}{joints}</robot>')
    return files


def _require_harmless(found: Outcome) -> None:
    assert found.code == 0, found.output
    assert "Traceback" not in found.output
    assert not {path for path in found.opened if path.startswith(("/etc", "/dev/zero"))}


def test_every_mesh_is_counted_or_passed_over_with_a_word(tmp_path: Path) -> None:
    files = _robot(tmp_path, MESHES)
    found = twinform("stats", "a.urdf", folder=tmp_path, seconds=_SECONDS)
    _require_harmless(found)
    for name, file in files.items():
        line = next(line for line in found.output.splitlines() if f" {file}: " in line)
        assert "triangle" in line or "(" in line, line
        assert _SAID.get(name, "") in line


def test_what_is_not_measured_is_named_in_a_finding(tmp_path: Path) -> None:
    files = _robot(tmp_path, _SAID)
    found = twinform("check", "--passes", "check-inertia{meshes=true}", "a.urdf", folder=tmp_path, seconds=_SECONDS)
    _require_harmless(found)
    for name, words in _SAID.items():
        assert any(f"'{files[name]}'" in line and words in line for line in found.output.splitlines()), name


@pytest.mark.deep
@pytest.mark.parametrize("name", MESHES)
@pytest.mark.parametrize(
    "words",
    [
        ("stats",),
        ("check", "--passes", "check-inertia{meshes=true}"),
        ("convert", "--to", "sdf", "--passes", "fill-inertia{overwrite=true}"),
        ("package", "-o", "made", "--kind", "gazebo-model", "--allow-missing"),
        ("report", "-o", "made.html"),
    ],
    ids=lambda words: words[0],
)
def test_each_mesh_alone_takes_little(name: str, words: tuple[str, ...], tmp_path: Path) -> None:
    _robot(tmp_path, [name])
    command, *options = words
    found = twinform(command, "a.urdf", *options, folder=tmp_path, seconds=3, written=2**28)
    assert found.code in {0, 1, 2}, found.output  # what is not there may be an error, and never a signal
    assert "Traceback" not in found.output
