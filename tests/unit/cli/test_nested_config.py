"""The nearest configuration of each file counts, on the command line as in the editor."""

import json
from collections.abc import Mapping
from pathlib import Path

import pytest

from twinform.cli.config_file import ConfigError, _configuration_in  # pyright: ignore[reportPrivateUsage]
from twinform.cli.editor_settings import settings_of
from twinform.cli.nearest_projects import NearestProjects

from .conftest import GOOD, WARNED, WRONG, Run

LIMITLESS = GOOD.replace(
    "</robot>",
    '<link name="b"/><joint name="j" type="revolute"><parent link="base"/><child link="b"/></joint></robot>',
)


def _write(path: Path, text: str) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    return path


@pytest.fixture
def repository(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A repository with a file in each of three folders, one of which is to have settings of its own."""
    _write(tmp_path / ".git/HEAD", "")
    for name in ("warned.urdf", "arm/warned.urdf", "arm/deep/warned.urdf", "leg/warned.urdf"):
        _write(tmp_path / name, WARNED)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def _errors(run: Run, *arguments: str | Path) -> Mapping[str, int]:
    """Return the number of errors in each file."""
    done = run("check", *arguments, "--format", "json")
    assert done.exit_code != 2, done.stderr
    files = json.loads(done.stdout)["files"]
    return {each["path"]: sum(one["severity"] == "error" for one in each["diagnostics"]) for each in files}


def test_the_settings_nearest_to_a_file_count_for_it(run: Run, repository: Path) -> None:
    _write(repository / "arm/twinform.toml", "deny = ['unknown-element']")
    wanted = {"arm/deep/warned.urdf": 1, "arm/warned.urdf": 1, "leg/warned.urdf": 0, "warned.urdf": 0}
    assert _errors(run, ".") == wanted
    assert _errors(run, *wanted) == wanted
    assert _errors(run, ".", "--jobs", "2") == wanted
    _write(repository / "twinform.toml", "deny = ['unknown-element']")
    _write(repository / "arm/deep/pyproject.toml", "[tool.twinform]\nallow = ['unknown-element']")
    assert _errors(run, ".") == {**dict.fromkeys(wanted, 1), "arm/deep/warned.urdf": 0}


def test_a_configuration_that_is_named_counts_for_all(run: Run, repository: Path) -> None:
    _write(repository / "arm/twinform.toml", "deny = ['unknown-element']")
    _write(repository / "ci.toml", "")
    assert not any(_errors(run, ".", "--config", "ci.toml").values())
    assert not any(_errors(run, ".", "--no-config").values())


def test_what_is_typed_wins_everywhere(run: Run, repository: Path) -> None:
    _write(repository / "arm/twinform.toml", "strict = true")
    assert _errors(run, ".")["arm/warned.urdf"] == 1
    assert not any(_errors(run, ".", "--no-strict").values())
    assert all(_errors(run, ".", "--deny", "unknown-element").values())


def test_the_command_line_and_the_editor_agree(run: Run, repository: Path) -> None:
    _write(repository / "arm/twinform.toml", "strict = true\nallow = ['missing-limit']\nfor = ['mujoco']")
    settings = settings_of(repository / "arm/deep/warned.urdf")
    assert settings.load_options.strict
    assert settings.policy.allow == {"missing-limit"}
    assert [each.name for each in settings.load_options.profiles] == ["mujoco"]
    assert not settings_of(repository / "leg/warned.urdf").load_options.strict
    assert _errors(run, ".")["arm/deep/warned.urdf"] == 1


@pytest.mark.parametrize(
    ("text", "line", "message"),
    [
        ("strict = true\n[files\n", 2, "Expected ']'"),
        ("strct = true\n", 1, "strct: there is no such key; did you mean strict?"),
        ("allow = ['unknown-elemnt']\n", 1, "allow: no rule is called unknown-elemnt; did you mean unknown-element?"),
        ("strict = true\n\nallow = ['x']\n", 3, "allow: no rule is called x"),
        ("[format]\nindnt = 4\n", 2, "format.indnt: there is no such key"),
        ("[[files]]\nmatch = ['a']\nallow = []\n[[files]]\nmatch = ['*']\nalow = []", 6, "files[1].alow: "),
        ("[pipelines]\n'a b' = ''\n", 2, "the name of a pipeline"),
        ("paths = ['../..']\n", 1, "paths: "),
        ("exclude = ['!']\n", 1, "exclude: "),
        ("check-passes = 'no-such'\n", 1, "check-passes: no pass is called no-such"),
        ("max-size = '1GB'\n", 1, "max-size: "),
    ],
)
def test_a_wrong_one_is_a_finding_of_its_files(run: Run, repository: Path, text: str, line: int, message: str) -> None:
    _write(repository / "arm/twinform.toml", text)
    done = run("check", ".", "--format", "json")
    assert done.exit_code == 1, done.stderr
    files = json.loads(done.stdout)["files"]
    found = [(each["path"], one) for each in files for one in each["diagnostics"] if one["severity"] == "error"]
    ((path, one),) = found
    assert (path.startswith("arm/"), one["rule"], one["line"]) == (True, "wrong-configuration", line)
    assert message in one["message"]
    assert one["file"] == "arm/twinform.toml"
    assert f"\narm/twinform.toml:{line}" in "\n" + run("check", ".").stdout
    assert f"{repository}/arm/twinform.toml:{line}" in run("check", repository).stdout
    assert run("check", "leg", "warned.urdf").exit_code == 0


def test_one_that_leads_out_of_its_folder_is_not_trusted(run: Run, repository: Path) -> None:
    _write(repository / "secret/a.txt", "")
    _write(repository / "arm/twinform.toml", "paths = ['../secret']")
    assert run("check", ".", "--trust-config").exit_code == 1


def test_each_folder_has_its_own_exclusion(run: Run, repository: Path) -> None:
    _write(repository / "twinform.toml", "extend-exclude = ['/leg/']")
    _write(repository / "arm/twinform.toml", "exclude = ['/deep/']")
    assert list(_errors(run, ".")) == ["arm/warned.urdf", "warned.urdf"]
    assert list(_errors(run, "arm")) == ["arm/warned.urdf"]
    assert list(_errors(run, ".", "--no-config")) == [
        "arm/deep/warned.urdf", "arm/warned.urdf", "leg/warned.urdf", "warned.urdf",
    ]  # fmt: skip


def test_each_folder_has_its_own_baseline(run: Run, repository: Path) -> None:
    for name in ("arm/warned.urdf", "leg/warned.urdf"):
        _write(repository / name, WRONG)
    _write(repository / "arm/twinform.toml", "baseline = 'known.json'")
    assert run("check", "arm", "--update-baseline").exit_code == 0
    assert {name for name, count in _errors(run, ".").items() if count} == {"leg/warned.urdf"}


def test_conversions_and_formats_follow_the_file(run: Run, repository: Path) -> None:
    _write(repository / "arm/good.urdf", GOOD)
    _write(repository / "leg/good.urdf", GOOD)
    _write(repository / "arm/twinform.toml", "sdf-version = '1.9'\n[format]\nindent = 4")
    assert 'version="1.9">' in run("convert", "arm/good.urdf").stdout
    assert 'version="1.11">' in run("convert", "leg/good.urdf").stdout
    assert 'version="1.10">' in run("convert", "arm/good.urdf", "--sdf-version", "1.10").stdout
    run("convert", "arm/good.urdf", "leg/good.urdf", "-o", "out")
    run("format", "arm/good.urdf", "leg/good.urdf")
    assert "\n    <link" in Path("arm/good.urdf").read_text()
    assert "\n  <link" in Path("leg/good.urdf").read_text()


def test_format_leaves_files_alone_whose_settings_are_wrong(run: Run, repository: Path) -> None:
    _write(repository / "arm/twinform.toml", "[format]\nindnt = 4")
    before = Path("arm/warned.urdf").read_text()
    done = run("format", ".")
    assert (done.exit_code, "indnt" in done.stderr) == (2, True)
    assert Path("arm/warned.urdf").read_text() == before


def test_arguments_and_passes_are_those_of_the_nearest(run: Run, repository: Path) -> None:
    root = '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">'
    xacro = f'{root}<link name="$(arg a)"/></robot>'
    _write(repository / "arm/r.urdf.xacro", xacro)
    _write(repository / "arm/twinform.toml", "[[files]]\nmatch = ['*.xacro']\narguments = {a = 'x'}")
    _write(repository / "arm/deep/r.urdf.xacro", xacro)
    _write(repository / "arm/deep/twinform.toml", "check-passes = 'check-inertia'")
    done = run("check", ".")
    assert "arm/r.urdf.xacro" not in done.stdout
    assert "arm/deep/r.urdf.xacro" in done.stdout


def test_a_configuration_is_read_once_and_a_folder_looked_into_once(
    run: Run, repository: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = repository / "arm"
    for number in range(30):
        _write(folder / "warned.urdf", WARNED)
        folder /= f"f{number}"
    _write(repository / "arm/twinform.toml", "strict = [")
    looked: list[Path] = []

    def look(folder: Path) -> object:
        looked.append(folder)
        return _configuration_in(folder)

    monkeypatch.setattr("twinform.cli.config_file._configuration_in", look)
    projects = NearestProjects()
    for file in (repository / "arm").rglob("*.urdf"):
        with pytest.raises(ConfigError):
            projects.of(str(file))
    assert len(looked) == len(set(looked)) == 31
    assert run("check", ".", "--format", "json").stdout.count("wrong-configuration") == 1


def test_the_nearest_counts_alone_and_ends_at_the_repository(run: Run, repository: Path) -> None:
    _write(repository / "twinform.toml", "deny = ['unknown-element']")
    _write(repository / "arm/twinform.toml", "")
    _write(repository / "leg/.git/HEAD", "")
    errors = _errors(run, ".")
    assert (errors["arm/warned.urdf"], errors["warned.urdf"]) == (0, 1)
    # a repository in this one has no configuration: that of the current folder counts, as for any file without one
    assert errors["leg/warned.urdf"] == 1
    assert settings_of(repository / "leg/warned.urdf").policy.deny == frozenset()


def test_fixes_use_the_settings_of_each_file(run: Run, repository: Path) -> None:
    shape = '<visual><geometry><sphere radius="1,5"/></geometry></visual>'
    text = f'<robot name="r"><link name="a">{shape}</link></robot>'
    for name in ("arm/r.urdf", "leg/r.urdf"):
        _write(repository / name, text)
    _write(repository / "arm/twinform.toml", "allow = ['invalid-value', 'unknown-element']")
    run("check", "arm/r.urdf", "leg/r.urdf", "--fix", "--unsafe-fixes")
    assert "1,5" in Path("arm/r.urdf").read_text()
    assert "1.5" in Path("leg/r.urdf").read_text()
