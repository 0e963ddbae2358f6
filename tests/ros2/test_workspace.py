"""The CMake package: models are converted where a package is built, again when what they are made of changes."""

import os
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import pytest
from click.testing import CliRunner
from lxml import etree

from testbed.ros2.judges import manifest
from testbed.ros2.launch_stubs import ParameterValue, described
from testbed.ros2.packages import AMENT, ROOT
from twinform import __version__
from twinform.cli import main

_EXAMPLE = ROOT / "testbed/ros2/lift_description"
_PAGE = ROOT / "docs/how-to/use-in-a-ros2-workspace.md"
_PROGRAMS = Path(sys.executable).parent
_ELSEWHERE = "set(CMAKE_FIND_ROOT_PATH /nowhere)\nset(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM ONLY)\n"
"""Lets CMake find no programs."""
_GENERATORS = {"Unix Makefiles": "make", "Ninja": "ninja"}

pytestmark = pytest.mark.skipif(shutil.which("cmake") is None, reason="cmake is not installed")


@dataclass(frozen=True)
class Workspace:
    """A copy of the example package, with the folders that CMake builds and installs into."""

    folder: Path
    generator: str = "Unix Makefiles"

    @property
    def package(self) -> Path:
        return self.folder / "src"

    @property
    def output(self) -> Path:
        return self.folder / "build/lift.sdf"

    def run(self, *words: str) -> subprocess.CompletedProcess[str]:
        environment = {**os.environ, "PATH": f"{_PROGRAMS}{os.pathsep}{os.environ['PATH']}"}
        return subprocess.run(words, capture_output=True, text=True, check=False, cwd=self.folder, env=environment)

    def configure(self) -> subprocess.CompletedProcess[str]:
        settings = (f"-DCMAKE_PREFIX_PATH={AMENT}", f"-DCMAKE_INSTALL_PREFIX={self.folder / 'install'}")
        return self.run("cmake", "-S", "src", "-B", "build", "-G", self.generator, *settings, "--warn-uninitialized")

    def build(self) -> str:
        """Build it; return what was printed."""
        done = self.run("cmake", "--build", "build")
        assert done.returncode == 0, done.stdout + done.stderr
        assert not done.stderr
        return done.stdout

    def replace(self, file: str, old: str, new: str) -> None:
        path = self.package / file
        text = path.read_text()
        assert old in text
        path.write_text(text.replace(old, new))

    def limit(self, name: str) -> float:
        """A limit of the joint in the file that was built."""
        found = etree.parse(self.output).find(f".//joint[@name='lift_joint']/axis/limit/{name}")
        assert found is not None
        assert found.text
        return float(found.text)


@pytest.fixture(params=_GENERATORS)
def workspace(request: pytest.FixtureRequest, tmp_path: Path) -> Workspace:
    if shutil.which(_GENERATORS[request.param]) is None:
        pytest.skip(f"{_GENERATORS[request.param]} is not installed")
    return _workspace(tmp_path / "a workspace", request.param)


def _workspace(folder: Path, generator: str = "Unix Makefiles") -> Workspace:
    shutil.copytree(_EXAMPLE, folder / "src")
    return Workspace(folder, generator)


def test_a_model_is_converted_again_when_what_it_is_made_of_changes(workspace: Workspace) -> None:
    done = workspace.configure()
    assert done.returncode == 0, done.stderr
    assert not done.stderr
    assert "Converting" in workspace.build()
    assert (workspace.limit("upper"), workspace.limit("velocity")) == (1.5, 0.25)
    assert "Converting" not in workspace.build()
    workspace.replace("urdf/mast.xacro", 'value="0.25"', 'value="0.125"')  # a file that is included, and not named
    assert "Converting" in workspace.build()
    assert workspace.limit("velocity") == 0.125
    assert "Converting" not in workspace.build()


def test_the_settings_of_the_project_are_what_a_result_is_made_of(workspace: Workspace) -> None:
    settings = workspace.package / "twinform.toml"
    settings.write_text('sdf-version = "1.9"\n')
    workspace.configure()
    workspace.build()
    assert 'version="1.9"' in workspace.output.read_text()
    settings.write_text('sdf-version = "1.10"\n')
    workspace.build()
    assert 'version="1.10"' in workspace.output.read_text()


def test_a_wrong_model_fails_the_build_and_its_test(tmp_path: Path) -> None:
    workspace = _workspace(tmp_path)
    workspace.configure()
    workspace.build()
    assert workspace.run("ctest", "--test-dir", "build").returncode == 0
    workspace.replace("urdf/mast.xacro", 'parent link="base"', 'parent link="bas"')
    done = workspace.run("cmake", "--build", "build")
    assert done.returncode != 0
    assert "there is no such link" in done.stdout + done.stderr
    done = workspace.run("ctest", "--test-dir", "build", "--output-on-failure")
    assert done.returncode != 0
    line = (workspace.package / "urdf/mast.xacro").read_text().partition('"bas"')[0].count("\n") + 1
    assert f"mast.xacro:{line}" in done.stdout


def test_what_is_installed_can_be_spawned_by_the_launch_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    workspace = _workspace(tmp_path)
    workspace.configure()
    workspace.build()
    assert workspace.run("cmake", "--install", "build").returncode == 0
    prefix = workspace.folder / "install"
    monkeypatch.setenv("PATH", f"{_PROGRAMS}{os.pathsep}{os.environ['PATH']}")
    launched = described(prefix / "share/lift_description/launch/gazebo.launch.py", prefix)
    description = launched.node("robot_state_publisher").parameters[0]["robot_description"]
    assert isinstance(description, ParameterValue)
    robot = etree.fromstring(launched.perform(description.value).encode())
    assert robot.tag == "robot"
    assert robot.xpath("//joint[@name='lift_joint']/limit/@upper") == ["1.5"]
    assert "robot_description" in launched.node("ros_gz_sim").arguments


@pytest.mark.parametrize(
    ("old", "new", "why"),
    [
        ("TO sdf", "TO usd", "TO is 'usd'; expected sdf, urdf or mjcf"),
        ("TO sdf", "", "TO is ''"),
        ("TO sdf", "TO sdf TOO", "'TOO' is none of its keywords"),
        ("TO sdf DESTINATION share/${PROJECT_NAME}/sdf", "TO sdf DESTINATION", "DESTINATION has no value"),
        ("(urdf/lift.urdf.xacro TO", "(urdf/lfit.urdf.xacro TO", "there is no file urdf/lfit.urdf.xacro"),
        ("twinform_check(urdf/lift.urdf.xacro", "twinform_check(", "there is nothing to check"),
        ("twinform_check(urdf/lift", "twinform_check(urdf/lfit", "there is no file"),
        ("find_package(twinform", f"{_ELSEWHERE}find_package(twinform", "the command twinform is not found"),
    ],
)
def test_a_mistake_in_a_cmakelists_is_named_when_it_is_configured(old: str, new: str, why: str, tmp_path: Path) -> None:
    workspace = _workspace(tmp_path)
    workspace.replace("CMakeLists.txt", old, new)
    done = workspace.configure()
    assert done.returncode != 0
    assert why in " ".join(done.stderr.split())


def test_the_page_shows_the_package_that_is_built_here() -> None:
    page, files = _PAGE.read_text(), "".join(path.read_text() for path in sorted(_EXAMPLE.rglob("*.*")))
    for block in page.split("```")[1::2]:
        language, _, text = block.partition("\n")
        if language in {"cmake", "text"}:
            assert text in files


def test_the_repository_is_a_package_of_its_own() -> None:
    found = manifest(ROOT)
    assert found.warnings == ()
    assert (found.name, found.version, found.build_type) == ("twinform", __version__, "cmake")
    assert manifest(_EXAMPLE).warnings == ()


def _convert(*words: str) -> tuple[int, str]:
    done = CliRunner().invoke(main, ["convert", str(_EXAMPLE / "urdf/lift.urdf.xacro"), *words])
    return done.exit_code, done.stderr


def test_a_depfile_names_what_was_read_as_make_wants_it(tmp_path: Path) -> None:
    folder = tmp_path / "a $#b"
    shutil.copytree(_EXAMPLE, folder)
    out, listed = tmp_path / "out it.sdf", tmp_path / "out.d"
    model = folder / "urdf/lift.urdf.xacro"
    done = CliRunner().invoke(main, ["convert", str(model), "-o", str(out), "--depfile", str(listed)])
    assert (done.exit_code, done.output) == (0, "")
    escaped = str(folder).replace("$", "$$").replace(" ", "\\ ").replace("#", "\\#")
    sources = f"{escaped}/urdf/lift.urdf.xacro {escaped}/urdf/mast.xacro"
    assert listed.read_text() == f"{tmp_path}/out\\ it.sdf: {sources}\n"


@pytest.mark.parametrize(
    "words",
    [
        ["--depfile", "a.d"],
        ["--depfile", "a.d", "--in-place"],
        ["--depfile", "same", "-o", "same"],
        ["--depfile", "a.d", "--split", "-o", "out"],
    ],
    ids=" ".join,
)
def test_a_depfile_is_for_one_file_that_is_made(
    words: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    code, said = _convert(*words)
    assert code == 2
    assert said
    assert [*tmp_path.iterdir()] == []


def test_a_failed_conversion_writes_no_depfile(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    code, _ = _convert("-o", "a.sdf", "--depfile", "a.d", "height:=tall")
    assert code == 1
    assert [*tmp_path.iterdir()] == []
