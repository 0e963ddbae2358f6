"""A batch that fails loses nothing: results of earlier runs go only after a verdict on the model itself.

And none of them is out of date without a word, whatever the times and sizes of files are.
"""

import io
import json
import os
import subprocess
import sys
import tarfile
from pathlib import Path

import pytest

from testbed import robots

_BATCH = (sys.executable, "-P", "-c", "from twinform.cli import main; main()", "batch", "convert")
_LONG_AGO = 1_000_000_000
_WRONG = '<robot name="r"><link name="a"/><link name="a"/></robot>'
_WORLD = '<sdf version="1.11"><world name="w"><include><uri>model://crate</uri></include></world></sdf>'
_CRATE = '<sdf version="1.11"><model name="crate"><link name="base"/></model></sdf>'
_CONFIG = '<model><sdf version="1.11">model.sdf</sdf></model>'
_XACRO = """<robot name="x" xmlns:xacro="http://www.ros.org/wiki/xacro">
<xacro:include filename="part.xacro"/><link name="base"/></robot>"""
_PART = '<robot xmlns:xacro="http://www.ros.org/wiki/xacro"><material name="{0}"/></robot>'


@pytest.fixture
def here(tmp_path: Path) -> Path:
    (tmp_path / "src/.git").mkdir(parents=True)
    return tmp_path


def _batch(here: Path, *words: str, src: str = "src") -> tuple[int, dict[str, str], str]:
    """The exit code of a run, the outcome of each model, and what it printed."""
    command = [*_BATCH, src, "out", "--to", "sdf", "--jobs", "1", "--report", "report.json", *words]
    done = subprocess.run(command, cwd=here, capture_output=True, text=True, check=False)
    assert "Traceback" not in done.stderr, done.stderr
    rows = map(json.loads, (here / "report.json").read_text().splitlines())
    return done.returncode, {row["source"]: row["outcome"] for row in rows}, done.stderr


def _results(here: Path) -> dict[str, bytes]:
    found = (path for path in (here / "out").rglob("*.*") if path.is_file() and ".twinform-batch" not in path.parts)
    return {path.relative_to(here / "out").as_posix(): path.read_bytes() for path in found}


def _put(path: Path, text: str) -> None:
    """Write a file with a time that every other one has, too."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    os.utime(path, (_LONG_AGO, _LONG_AGO))


def test_only_a_verdict_on_the_model_takes_a_result_away(here: Path) -> None:
    src = here / "src"
    names = ("gone", "pipe", "half", "empty", "folder", "wrong", "good")
    for name in names:
        (src / f"{name}.urdf").write_text(robots.urdf(2).replace("tree_of_2", name))
    _put(here / "library/crate/model.sdf", _CRATE)
    _put(here / "library/crate/model.config", _CONFIG)
    _put(src / "world.world", _WORLD)
    words = ("--path", "library", "--expand-includes")
    assert _batch(here, *words)[0] == 0
    before = _results(here)
    assert len(before) == len(names) + 1
    for name in ("gone", "pipe", "folder"):
        (src / f"{name}.urdf").unlink()
    (src / "gone.urdf").symlink_to("nowhere")
    os.mkfifo(src / "pipe.urdf")
    (src / "folder.urdf").symlink_to("/")
    for name in ("half", "empty"):
        with (src / f"{name}.urdf").open("r+") as file:
            file.truncate(100 if name == "half" else 0)
    (src / "wrong.urdf").write_text(_WRONG)
    (here / "library").rename(here / "elsewhere")
    (here / "library").mkdir()  # as the place of a disk that is not mounted
    code, outcomes, output = _batch(here, *words)
    assert code == 2
    assert outcomes == {
        **dict.fromkeys(("gone.urdf", "pipe.urdf", "half.urdf", "empty.urdf"), "unreadable"),
        **dict.fromkeys(("wrong.urdf", "world.world"), "refused"),
        "good.urdf": "converted",
    }
    assert output.count("the result of an earlier run stays") == 5
    assert _results(here) == {name: text for name, text in before.items() if name != "wrong.sdf"}
    (here / "library").rmdir()
    (here / "elsewhere").rename(here / "library")
    (src / "half.urdf").write_text(_WRONG)  # what was kept is still known, and goes with the next verdict
    assert _batch(here, *words)[1]["world.world"] == "converted"
    assert "half.sdf" not in _results(here)


def test_a_run_with_no_time_loses_nothing(here: Path) -> None:
    for number in range(3):
        (here / f"src/{number}.urdf").write_text(robots.urdf(1_500 + number))
    assert _batch(here)[0] == 0
    before = _results(here)
    code, outcomes, _ = _batch(here, "--fresh", "--timeout", "0.01")
    assert (code, set(outcomes.values())) == (1, {"late"})
    assert _results(here) == before
    assert _batch(here)[2].endswith("(3 known from before)\n")


def test_a_file_of_the_same_time_and_size_is_not_the_same(here: Path) -> None:
    """As `rsync -t`, Nix, Bazel and a checkout with fixed times leave it."""
    src = here / "src"
    texts = {"one.urdf": robots.urdf(2), "x.urdf.xacro": _XACRO, "part.xacro": _PART.format("red")}
    texts |= {"world.world": _WORLD, "crate/model.sdf": _CRATE, "crate/model.config": _CONFIG}
    for name, text in texts.items():
        _put(src / name, text)
    _batch(here, "--expand-includes")
    _put(src / "one.urdf", robots.urdf(2).replace("link_1", "link_9"))
    _put(src / "new", _PART.format("tan"))
    (src / "new").replace(src / "part.xacro")
    _put(src / "crate/model.sdf", _CRATE.replace("base", "foot"))
    os.utime(src, (_LONG_AGO, _LONG_AGO))
    _, outcomes, output = _batch(here, "--expand-includes")
    assert set(outcomes.values()) == {"converted"}
    assert output == "4 models: 4 converted\n"
    found = _results(here)
    assert b"link_9" in found["one.sdf"]
    assert b"foot" in found["world.world"]
    assert b"foot" in found["crate/model.sdf"]
    assert b"tan" in found["x.sdf"]
    assert _batch(here, "--expand-includes")[2].endswith("(4 known from before)\n")


def test_an_archive_with_fixed_times_is_read_by_its_contents(here: Path) -> None:
    """Nothing but the contents of two reproducible archives differs."""
    texts = {"one.urdf": robots.urdf(2), "two.urdf": robots.urdf(3), "x.urdf.xacro": _XACRO}
    for color, link, known in (("red", "link_1", ""), ("tan", "link_9", " (1 known from before)")):
        with tarfile.open(here / "models.tar", "w") as archive:
            for name, text in {**texts, "part.xacro": _PART.format(color)}.items():
                content = (text.replace("link_1", link) if name == "one.urdf" else text).encode()
                info = tarfile.TarInfo(name)
                info.size, info.mtime = len(content), _LONG_AGO
                archive.addfile(info, io.BytesIO(content))
        output = _batch(here, src="models.tar")[2]
        assert output == f"3 models: 3 converted{known}\n"
        assert link.encode() in _results(here)["one.sdf"]
        assert color.encode() in _results(here)["x.sdf"]
    assert _batch(here, src="models.tar")[2].endswith("(3 known from before)\n")
