"""`check` of a folder finds the same with results of earlier runs as without, whatever has changed since."""

import json
import os
import pickle
import shutil
import stat
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path

import pytest

from tests.unit.cli.conftest import GOOD, WARNED, Run
from twinform.compiler import workers

_FILES: Mapping[str, str] = {
    "ws/.git/HEAD": "ref: refs/heads/main\n",
    "ws/.gitignore": "/ignored\n",
    "ws/twinform.toml": '[[files]]\nmatch = ["*.sdf"]\ndeny = ["missing-file"]\n',
    "ws/arm/urdf/twinform.toml": 'deny = ["missing-inertial"]\nexclude = ["ba*"]\n',
    "ws/arm/package.xml": "<package><name>arm</name></package>",
    "ws/arm/meshes/a.stl": "solid a",
    "ws/arm/urdf/plain.urdf": GOOD.replace(
        "</link>", '<visual><geometry><mesh filename="package://arm/meshes/a.stl"/></geometry></visual></link>'
    ),
    "ws/arm/urdf/warned.urdf": WARNED,
    "ws/arm/urdf/allowed.urdf": WARNED.replace("<link", "<!-- twinform: allow unknown-element --><link"),
    "ws/arm/urdf/made.urdf.xacro": """\
<robot name="made" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:include filename="$(find arm)/urdf/macros.xacro"/>
  <xacro:property name="sizes" value="${load_yaml('sizes.yaml')}"/>
  <xacro:part name="base_$(optenv ROS_DISTRO none)" wide="${sizes['wide']}"/>
</robot>
""",
    "ws/arm/urdf/macros.xacro": """\
<robot xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:macro name="part" params="name wide">
    <link name="${name}"><visual><geometry><box size="${wide} 1 1"/></geometry></visual></link>
  </xacro:macro>
</robot>
""",
    "ws/arm/urdf/sizes.yaml": "wide: 2\n",
    "ws/world.sdf": '<sdf version="1.9"><world name="w"><include><uri>model://crate</uri></include></world></sdf>',
    "ws/crate/model.config": "<model><name>crate</name><sdf version='1.9'>model.sdf</sdf></model>",
    "ws/crate/model.sdf": '<sdf version="1.9"><model name="crate"><link name="l"/></model></sdf>',
    "ws/ignored/wrong.urdf": "<robot/>",
}


@pytest.fixture
def workspace(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A workspace with a file of each kind that counts, and the current folder in it."""
    for name, text in _FILES.items():
        _write(tmp_path / name, text)
    monkeypatch.setenv("TWINFORM_CACHE_DIR", str(tmp_path / "cache"))
    monkeypatch.delenv("ROS_DISTRO", raising=False)
    monkeypatch.chdir(tmp_path / "ws")
    return tmp_path


def _write(path: Path, text: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)


def _same_findings(run: Run, *options: str) -> str:
    """Check with and without results of earlier runs; return what both print."""
    anew = run("check", ".", "--format", "json", "--expand-includes", "--no-cache", *options)
    kept = run("check", ".", "--format", "json", "--expand-includes", *options)
    assert anew.stdout or "twinform.toml" in anew.stderr
    assert (kept.exit_code, kept.stdout, kept.stderr) == (anew.exit_code, anew.stdout, anew.stderr)
    return anew.stdout


def _retarget(path: Path) -> None:
    """Put a link to a file of the same content and status outside of the repository in the place of a file."""
    other = path.parents[len(path.relative_to(Path.cwd()).parts)] / "outside"
    path.rename(other)
    path.symlink_to(other)


def _work(*_: object) -> None:
    """Stand for work that must not be done."""
    pytest.fail("it was done again")


_Change = Callable[[Path], object]
_CHANGES: Mapping[str, _Change] = {
    "edit": lambda path: path.write_text(path.read_text().replace("a", "b", 1)),
    "edit without a trace in size and time": lambda path: _edit_silently(path),  # noqa: PLW0108 - defined below
    "delete": lambda path: path.unlink(),
    "rename": lambda path: path.rename(path.with_name(f"other_{path.name}")),
    "link": _retarget,
    "empty": lambda path: path.write_text(""),
    "folder": lambda path: (path.unlink(), path.mkdir()),
}


def _edit_silently(path: Path) -> None:
    before = path.stat()
    text = path.read_text()
    path.write_text(
        text[:-2] + text[-2:].swapcase() if text[-2:].swapcase() != text[-2:] else text.replace("1", "3", 1)
    )
    os.utime(path, ns=(before.st_atime_ns, before.st_mtime_ns))


@pytest.mark.parametrize("change", _CHANGES)
@pytest.mark.parametrize("name", [name for name in _FILES if "HEAD" not in name])
@pytest.mark.slow
def test_a_change_of_any_file_that_counts_is_seen(workspace: Path, run: Run, name: str, change: str) -> None:
    _same_findings(run)
    _CHANGES[change](workspace / name)
    _same_findings(run)
    _same_findings(run)


_ADDED = {
    "a model": ("ws/arm/urdf/new.urdf", WARNED),
    "a package of the same name nearer": ("ws/arm/urdf/arm/meshes/other.stl", ""),
    "a repository in the repository": ("ws/arm/.git/HEAD", ""),
    "a project in the repository": ("ws/arm/twinform.toml", 'deny = ["unknown-element"]'),
    "patterns of git": ("ws/arm/.gitignore", "*.urdf"),
    "patterns of git that are not committed": ("ws/.git/info/exclude", "*.sdf"),
    "a model beside the world": ("ws/models/crate/model.config", "<model/>"),
    "a newer model": ("ws/crate/model-1_9.sdf", "<sdf/>"),
    "a manifest": ("ws/crate/package.xml", "<package><name>arm</name></package>"),
}


@pytest.mark.parametrize("added", _ADDED)
def test_a_file_that_is_added_is_seen(workspace: Path, run: Run, added: str) -> None:
    before = _same_findings(run)
    name, text = _ADDED[added]
    _write(workspace / name, text)
    assert added != "a model" or _same_findings(run) != before
    _same_findings(run)


def test_options_variables_and_folders_count(workspace: Path, run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    seen = {_same_findings(run)}
    for options in (
        ["--strict"],
        ["--deny", "unknown-element"],
        ["--passes", "check-inertia"],
        ["--for", "drake"],
        ["--no-xacro"],
    ):
        seen.add(_same_findings(run, *options))
    assert len(seen) >= 4
    monkeypatch.setenv("ROS_DISTRO", "jazzy ")
    _same_findings(run)
    monkeypatch.setenv("GZ_SIM_RESOURCE_PATH", str(workspace / "ws" / "models"))
    _same_findings(run)
    monkeypatch.chdir("arm")
    _same_findings(run)


def test_nothing_is_read_again_where_nothing_has_changed(
    workspace: Path, run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    found = _same_findings(run)
    _same_findings(run)  # the files were young, so their contents were compared
    monkeypatch.setattr("twinform.cli.checked_file.CheckTask.do", _work)
    monkeypatch.setattr("twinform.cli.inputs.discover", _work)
    assert run("check", ".", "--format", "json", "--expand-includes").stdout == found


def _results(workspace: Path) -> list[Path]:
    return sorted((workspace / "cache").glob("*.json"))


@pytest.mark.parametrize("damage", ["cut", "empty", "other text", "other digest", "wrong numbers", "folder"])
def test_damaged_results_are_ignored_and_replaced(workspace: Path, run: Run, damage: str) -> None:
    _same_findings(run)
    (file,) = _results(workspace)
    whole = file.read_bytes()
    match damage:
        case "cut":
            file.write_bytes(whole[:-9])
        case "empty":
            file.write_bytes(b"")
        case "other text":
            file.write_bytes(whole.replace(b"dialect", b"dialogs"))
        case "other digest":
            file.write_bytes(b"0" * 64 + whole[64:])
        case "wrong numbers":
            from twinform.compiler.observing import digest  # noqa: PLC0415 - for this case

            dependencies, groups, results = json.loads(whole.partition(b"\n")[2])
            data = json.dumps(
                [dependencies, groups, {key: [[99999], {}, text] for key, (_, _, text) in results.items()}]
            )
            file.write_bytes(digest(data.encode()).encode() + b"\n" + data.encode())
        case _:
            file.unlink()
            file.mkdir()
    _same_findings(run)
    if damage != "folder":
        assert _results(workspace)[0].stat().st_size == pytest.approx(len(whole), rel=0.2)


def test_results_hold_nothing_that_runs(workspace: Path, run: Run) -> None:
    _same_findings(run)
    (file,) = _results(workspace)
    json.loads(file.read_bytes().partition(b"\n")[2])


@pytest.mark.skipif(not hasattr(os, "getuid"), reason="there are no such permissions")
@pytest.mark.parametrize("way", ["others may write", "a link"])
def test_a_folder_that_others_may_have_written_is_not_used(workspace: Path, run: Run, way: str) -> None:
    cache = workspace / "cache"
    cache.mkdir()
    if way == "a link":
        cache.rename(workspace / "elsewhere")
        cache.symlink_to(workspace / "elsewhere")
    else:
        cache.chmod(0o777)
    _same_findings(run)
    assert not _results(workspace)
    refused = run("check", ".", "--cache-dir", cache)
    assert (refused.exit_code, "you alone" in refused.stderr) == (2, True)


def test_what_came_with_a_repository_is_not_read(workspace: Path, run: Run) -> None:
    run("check", ".", "--cache-dir", ".twinform_cache")
    own = workspace / "ws" / ".twinform_cache"
    assert (own / ".gitignore").read_text() == "*\n"
    shutil.copytree(workspace / "ws", workspace / "clone")
    os.chdir(workspace / "clone")
    marks = {folder.name for folder in (workspace / "clone/.twinform_cache").iterdir() if folder.is_dir()}
    run("check", ".", "--cache-dir", ".twinform_cache")
    made = {folder.name for folder in (workspace / "clone/.twinform_cache").iterdir() if folder.is_dir()}
    assert len(made - marks) == 1


def test_a_file_alone_is_not_kept_and_clean_deletes(workspace: Path, run: Run) -> None:
    assert run("check", "world.sdf").exit_code == 0
    assert run("check", ".", "--no-cache").exit_code != 2
    assert not (workspace / "cache").exists()
    assert "no results" in run("clean").stderr
    run("check", ".")
    (workspace / "cache" / "notes.txt").write_text("mine")
    assert "deleted 1 file" in run("clean").stderr
    assert [each.name for each in (workspace / "cache").iterdir()] == ["notes.txt"]
    assert stat.S_IMODE((workspace / "cache").stat().st_mode) & 0o022 == 0


def test_format_knows_what_is_formatted_until_it_changes(
    workspace: Path, run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    def both() -> tuple[int, str, str]:
        kept, anew = run("format", ".", "--diff"), run("format", ".", "--diff", "--no-cache")
        assert (kept.exit_code, kept.stdout, kept.stderr) == (anew.exit_code, anew.stdout, anew.stderr)
        return kept.exit_code, kept.stdout, kept.stderr

    assert both()[0] == 1
    assert run("format", ".").exit_code == 0
    assert both()[0] == 0
    (workspace / "ws/crate/model.sdf").write_text("<sdf  version='1.9'/>")
    assert "-<sdf  version" in both()[1]
    found = run("format", ".", "--diff").stdout
    monkeypatch.setattr("twinform.cli.format.formatted", _work)
    assert run("format", ".", "--diff").stdout == found


def test_two_runs_keep_the_results_of_both(workspace: Path, run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    from twinform.compiler.result_cache import ResultCache  # noqa: PLC0415 - as the command does it

    one, other = (ResultCache(workspace / "results.json") for _ in range(2))
    for number, each in enumerate((one, other)):
        made, seen = each.observer.observe((workspace / "ws/world.sdf").read_text)
        assert seen is not None
        each.put(str(number), made, seen)
        each.save()
    both = ResultCache(workspace / "results.json")
    assert both.get("0", str) == both.get("1", str) == (workspace / "ws/world.sdf").read_text()


@pytest.mark.parametrize("options", [(), ("--no-cache",)])
def test_what_processes_are_sent_is_linear_in_the_files(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, options: tuple[str, ...]
) -> None:
    def sent(count: int) -> int:
        folder = tmp_path / str(count)
        for number in range(count):
            _write(folder / f"package_{number}/package.xml", f"<package><name>package_{number}</name></package>")
            _write(folder / f"package_{number}/robot.urdf", GOOD)
        monkeypatch.chdir(folder)
        sizes: list[int] = []

        def process_runner(*_: object, common: object) -> None:
            sizes.append(len(pickle.dumps(common)))

        def run_on(_runner: object, work: object, jobs: Iterable[object]) -> None:
            sizes.extend(len(pickle.dumps((work, each))) for each in jobs)
            raise SystemExit(0)

        monkeypatch.setattr(workers, "process_runner", process_runner)
        monkeypatch.setattr(workers, "run_on", run_on)
        run("check", ".", "--jobs", "2", "--cache-dir", tmp_path / "kept", *options)
        assert len(sizes) == count + 1
        return sum(sizes)

    assert sent(80) < 2.2 * sent(40)
