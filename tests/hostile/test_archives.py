"""Archives that may be anybody's: each is refused with a word, or harmless, for little time and memory."""

import unicodedata
from pathlib import Path

import pytest

from tests.hostile.archives import LEFT_OUT, REFUSED, placed, zipped
from tests.hostile.child import twinform
from twinform.compiler.batch.archives import unpacked
from twinform.compiler.batch.entries import FolderError

_WRITTEN = 2**29
"""More than any archive may unpack to."""
_SECONDS = 3
_QUICK = frozenset({
    "a PAX header of 3 GiB", "a GNU name of 3 GiB", "a chain of PAX headers", "a PAX header of digits",
    "a dictionary of 1.5 GiB in xz", "one content for 5,000 files in zip", "the name up in tar", "the name root in zip",
})  # fmt: skip
"""What the quick tests send through the command; `make prove` sends all."""
_CASES = [pytest.param(what, marks=[] if what in _QUICK else [pytest.mark.deep]) for what in REFUSED]
_LARGE = "files and folders"


@pytest.mark.parametrize("what", _CASES)
def test_a_hostile_archive_is_refused_with_a_word(what: str, tmp_path: Path) -> None:
    name, make, word = REFUSED[what]
    archive = placed(tmp_path, name, make())
    found = twinform("batch", "check", archive, folder=tmp_path, seconds=_SECONDS, written=_WRITTEN)
    assert found.code == 2, found.output
    assert str(archive) in found.output
    assert word in found.output
    assert "Traceback" not in found.output
    assert [path.name for path in tmp_path.iterdir()] == [name]


@pytest.mark.parametrize("what", [what for what, case in REFUSED.items() if what not in _QUICK and case[2] != _LARGE])
def test_what_the_command_would_refuse_is_refused(what: str, tmp_path: Path) -> None:
    name, make, word = REFUSED[what]
    archive = placed(tmp_path, name, make())
    with pytest.raises(FolderError) as caught, unpacked(archive):
        pass
    assert word in str(caught.value)
    assert str(archive) in str(caught.value)


@pytest.mark.parametrize("what", LEFT_OUT)
def test_what_does_no_harm_is_left_out(what: str, tmp_path: Path) -> None:
    name, make = LEFT_OUT[what]
    with unpacked(placed(tmp_path, name, make())) as content:
        found = {path.name for path in content.folder.rglob("[!.]*")}
    assert found <= {"good.urdf", "in.zip"}
    assert "good.urdf" in found


def test_names_that_differ_in_little_are_different_files(tmp_path: Path) -> None:
    names = ["a.urdf", "A.urdf", "é.urdf", unicodedata.normalize("NFD", "é.urdf")]
    with unpacked(placed(tmp_path, "a.zip", zipped([(name, name.encode()) for name in names]))) as content:
        found = {path.name: path.read_bytes() for path in content.folder.glob("*.urdf")}
    assert found == {name: name.encode() for name in names}
