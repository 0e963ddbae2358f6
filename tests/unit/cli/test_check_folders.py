import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Generator
from pathlib import Path
from threading import Thread

import pytest

from twinform.installation import install_command

from .conftest import GOOD, WARNED, WRONG, Run


def test_a_folder_is_checked_in_order_and_the_worst_file_decides(run: Run, here: Path) -> None:
    done = run("check", ".", "--format", "json")
    names = [row["path"] for row in json.loads(done.stdout)["files"]]
    assert names == ["broken.urdf", "good.urdf", "warned.urdf", "wrong.urdf"]
    assert done.exit_code == 1
    assert run("check", ".", "--exclude", "broken.*").exit_code == 1
    assert run("check", "w*.urdf", "good.urdf", "good.urdf").stderr.startswith("3 files: ")


def test_no_model_is_wrong_usage_and_an_enforced_exclusion_is_not(run: Run, here: Path) -> None:
    Path("empty").mkdir()
    for word in ("empty", "*.sdf"):
        done = run("check", "good.urdf", word)
        assert (done.exit_code, "no model" in done.stderr) == (2, True)
    done = run("check", "--force-exclude", "--exclude", "wrong.urdf", "wrong.urdf")
    assert (done.exit_code, done.stderr) == (0, "0 files: 0 errors, 0 warnings, 0 notes\n")
    assert run("check", "--exclude", "!", ".").exit_code == 2


def test_exclude_of_the_project_is_instead_of_what_is_usual(run: Run, here: Path) -> None:
    Path("build").mkdir()
    Path("build/wrong.urdf").write_text(WRONG)
    Path("twinform.toml").write_text("extend-exclude = ['/broken.urdf', '/wrong.urdf']")
    assert run("check", ".").exit_code == 0
    Path("twinform.toml").write_text("exclude = ['/broken.urdf', '/wrong.urdf']")
    assert "build/wrong.urdf" in run("check", ".").stdout
    os.chdir("build")
    assert run("check", "..").stdout.count("error: ") == 1


def test_settings_of_files_go_before_those_of_the_project(run: Run, here: Path) -> None:
    Path("robots").mkdir()
    Path("robots/warned.urdf").write_text(WARNED)
    Path("twinform.toml").write_text(
        "[[files]]\nmatch = ['robots/']\nstrict = true\n[[files]]\nmatch = ['wrong.urdf']\nallow = ['missing-part']\n"
    )
    assert run("check", "warned.urdf", "wrong.urdf").exit_code == 0
    assert run("check", "robots").exit_code == 1
    assert run("check", "robots", "--no-strict").exit_code == 0
    assert run("check", "robots", "--allow", "unknown-element").exit_code == 0
    assert run("check", "wrong.urdf", "--deny", "missing-part").exit_code == 1
    assert run("check", "robots", "--no-config").exit_code == 0
    Path("twinform.toml").write_text("allow = ['unknown-element']\n[[files]]\nmatch = ['warned.urdf']\n"
                                     "deny = ['unknown-element']\n[[files]]\nmatch = ['robots/*']\n"
                                     "allow = ['unknown-element']\n")  # fmt: skip
    assert run("check", "warned.urdf").exit_code == 1
    assert run("check", "robots").exit_code == 0


_XACRO = """<robot xmlns:xacro="http://www.ros.org/wiki/xacro" name="r">
<xacro:arg name="side" default="left"/><xacro:arg name="flag" default="false"/>
<link name="$(arg side)_$(arg flag)"/></robot>"""


@pytest.mark.slow
def test_arguments_and_passes_of_files(run: Run, here: Path) -> None:
    Path("r.urdf.xacro").write_text(_XACRO)
    Path("twinform.toml").write_text(
        "[[files]]\nmatch = ['*.xacro']\narguments = { side = 'right', flag = true }\n"
        "passes = 'prefix-names{prefix=p_}'\ncheck-passes = 'prefix-names{prefix=p_}'\n"
    )
    assert 'name="p_right_true"' in run("convert", "r.urdf.xacro", "--to", "urdf").stdout
    assert 'name="up_true"' in run("convert", "r.urdf.xacro", "side:=up", "--to", "urdf", "--passes", "").stdout
    done = run("check", "r.urdf.xacro")
    assert (done.exit_code, "check runs read-only passes" in done.stderr) == (2, True)
    assert run("check", "r.urdf.xacro", "--passes", "").exit_code == 0
    Path("twinform.toml").write_text("[[files]]\nmatch = ['*.xacro']\ncheck-passes = 'chek-limits'\n")
    assert "twinform.toml: files[0].check-passes: no pass is called chek-limits" in run("check", "r.urdf.xacro").stderr


def test_a_baseline_keeps_what_is_known_and_reports_what_is_new(run: Run, here: Path) -> None:
    names = ["wrong.urdf", "warned.urdf", "--baseline", "known.json"]
    done = run("check", *names)
    assert (done.exit_code, "there is no baseline known.json: --update-baseline makes it" in done.stderr) == (2, True)
    done = run("check", *names, "--update-baseline")
    assert (done.exit_code, done.stdout) == (0, "")
    assert done.stderr.endswith("known.json: 2 findings\n")
    done = run("check", *names)
    assert (done.exit_code, done.stdout) == (0, "")
    assert done.stderr == "2 files: 0 errors, 0 warnings, 0 notes; 2 in the baseline\n"
    Path("wrong.urdf").write_text("\n\n" + WRONG.replace("</robot>", "<link name='a'/></robot>"))
    done = run("check", *names)
    assert (done.exit_code, "[duplicate-name]" in done.stdout, "[missing-part]" in done.stdout) == (1, True, False)
    Path("wrong.urdf").write_text(GOOD)
    assert "1 entry of the baseline does not occur any more" in run("check", *names).stderr
    assert run("check", "warned.urdf", *names[2:]).stderr.count("\n") == 1
    assert "known.json: 1 finding\n" in run("check", *names, "--update-baseline").stderr


def test_a_baseline_has_names_from_its_own_folder(run: Run, here: Path) -> None:
    Path("known").mkdir()
    Path("twinform.toml").write_text("baseline = 'known/base.json'")
    assert run("check", ".", "--update-baseline").exit_code == 0
    rows = json.loads(Path("known/base.json").read_text())["findings"]
    assert [row["file"] for row in rows] == ["../broken.urdf", "../warned.urdf", "../wrong.urdf"]
    assert run("check", ".").exit_code == 0
    os.chdir("known")
    assert run("check", "../wrong.urdf").exit_code == 0
    Path("../wrong.urdf").unlink()
    run("check", "../good.urdf", "--update-baseline")
    left = [row["file"] for row in json.loads(Path("base.json").read_text())["findings"]]
    assert left == ["../broken.urdf", "../warned.urdf"]


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        (b"{", "known.json:1: this is no JSON"),
        (b"\xff\xfe", "known.json: this is no baseline: it is not in UTF-8"),
        (b'{"twinform-baseline": 9}', "known.json: this is a baseline of version 9"),
    ],
)
def test_what_is_no_baseline_is_refused(run: Run, here: Path, text: bytes, problem: str) -> None:
    Path("known.json").write_bytes(text)
    done = run("check", "good.urdf", "--baseline", "known.json")
    assert (done.exit_code, problem in done.stderr) == (2, True)
    assert Path("known.json").read_bytes() == text


def test_baselines_need_a_place_that_the_project_may_name(run: Run, here: Path) -> None:
    assert "needs --baseline FILE" in run("check", "good.urdf", "--update-baseline").stderr
    Path("twinform.toml").write_text("baseline = '../known.json'")
    done = run("check", "good.urdf")
    assert (done.exit_code, "leads out of the folder of the configuration" in done.stderr) == (2, True)


def test_convert_can_say_whether_a_file_is_up_to_date(run: Run, here: Path) -> None:
    call = ["convert", "good.urdf", "-o", "good.sdf", "--ledger", "good.json"]
    done = run(*call, "--check")
    assert (done.exit_code, "good.sdf is not there" in done.stderr, Path("good.sdf").exists()) == (1, True, False)
    assert run(*call).exit_code == 0
    done = run(*call, "--check")
    assert (done.exit_code, done.stdout, done.stderr) == (0, "", "2 files are up to date\n")
    Path("good.urdf").write_text(GOOD.replace('"base"', '"root"'))
    before = Path("good.sdf").read_bytes()
    done = run(*call, "--check")
    assert (done.exit_code, '-    <link name="base">\n+    <link name="root">\n' in done.stdout) == (1, True)
    assert Path("good.sdf").read_bytes() == before
    assert run("convert", "good.urdf", "--to", "sdf", "--check").exit_code == 2
    assert run("convert", "good.urdf", "-o", "-", "--to", "sdf", "--check").exit_code == 2
    assert run("convert", "wrong.urdf", "-o", "good.sdf", "--check").exit_code == 1
    fill = ["convert", "good.urdf", "--in-place", "--passes", "rename{names=[root:base]}", "--check"]
    assert run(*fill).exit_code == 1
    assert 'name="root"' in Path("good.urdf").read_text()


class Watching:
    """A real process, and the lines that it has printed so far."""

    def __init__(self, folder: Path) -> None:
        command = [sys.executable, "-m", "twinform", "check", "--watch", "."]
        self.process = subprocess.Popen(
            command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
        )
        self.text = ""
        self.reader = Thread(target=self._read, daemon=True)
        self.reader.start()

    def _read(self) -> None:
        assert self.process.stdout is not None
        for line in self.process.stdout:
            self.text += line

    def wait_for(self, words: str) -> None:
        end = time.monotonic() + 60
        while words not in self.text:
            assert time.monotonic() < end, self.text
            time.sleep(0.05)
        self.text = self.text.partition(words)[2]


@pytest.fixture
def watching(tmp_path: Path) -> Generator[Watching]:
    (tmp_path / "robot.urdf.xacro").write_text(
        '<robot xmlns:xacro="http://www.ros.org/wiki/xacro" name="r"><xacro:include filename="parts.xacro"/>'
        "<xacro:part/></robot>"
    )
    (tmp_path / "parts.xacro").write_text(
        '<robot xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:macro name="part" params=""><link name="a"/>'
        "</xacro:macro></robot>"
    )
    (tmp_path / "good.urdf").write_text(GOOD)
    started = Watching(tmp_path)
    yield started
    started.process.kill()
    started.process.wait()
    started.reader.join()
    if started.process.stdout:
        started.process.stdout.close()


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="there Ctrl-C is no signal to one process")
def test_what_changes_is_checked_again_until_ctrl_c(watching: Watching, tmp_path: Path) -> None:
    watching.wait_for("3 files: 0 errors, 0 warnings, 0 notes\nwatching 3 files; Ctrl-C ends\n")
    parts = tmp_path / "parts.xacro"
    parts.write_text(parts.read_text().replace("<link", "<color/><link"))
    watching.wait_for("[unknown-element]")
    watching.wait_for("2 files: 0 errors, 1 warning, 0 notes\n")
    (tmp_path / "new.urdf").write_text(WRONG)
    watching.wait_for("new.urdf:3:4: error: ")
    watching.wait_for("watching 4 files; Ctrl-C ends\n")
    watching.process.send_signal(signal.SIGINT)
    assert watching.process.wait(timeout=60) == 130


def test_watching_is_for_files_and_text(run: Run, here: Path) -> None:
    for more in (["--format", "json"], ["-"]):
        done = run("check", "good.urdf", "--watch", *more)
        assert (done.exit_code, "--watch prints text, of files" in done.stderr) == (2, True)


def test_watching_without_watchfiles_says_how_to_get_it(run: Run, here: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "watchfiles", None)
    done = run("check", "good.urdf", "--watch")
    assert (done.exit_code, f"run: {install_command('watch')}" in done.stderr) == (2, True)


def test_thousands_of_lines_of_a_difference_are_cut(run: Run, here: Path) -> None:
    Path("good.sdf").write_text("x\n" * 5000)
    done = run("convert", "good.urdf", "-o", "good.sdf", "--check")
    assert (done.exit_code, done.stdout.count("\n") < 500, "lines more" in done.stdout) == (1, True, True)
