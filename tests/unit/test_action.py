"""The action for GitHub and the hooks for pre-commit: what they do with what somebody else has named or written."""

import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
import yaml

_ROOT = Path(__file__).parents[2]
_STEPS: list[dict[str, Any]] = yaml.safe_load((_ROOT / "action.yml").read_text())["runs"]["steps"]
_SCRIPTS: dict[str, str] = {each["name"]: each["run"] for each in _STEPS if "run" in each}
_PRINTS_ITS_WORDS = """\
#!/bin/sh
for word in "$@"; do printf '%s\\n' "$word"; done >> "$WORDS"
echo "##[set-output name=exit-code]0" >&2
exit 1
"""
_HOSTILE = "$(touch RAN) `touch RAN` ; touch RAN && ${IFS}x *.urdf"


def _runner(tmp_path: Path, script: str, **variables: str) -> subprocess.CompletedProcess[str]:
    """Run a step as GitHub does, in a repository with a module that pip would be, and a fake `twinform`."""
    programs, repository = tmp_path / "bin", tmp_path / "repository"
    programs.mkdir()
    repository.mkdir()
    (programs / "twinform").write_text(_PRINTS_ITS_WORDS)
    (programs / "twinform").chmod(0o755)
    # no link: the environment of a link's target is another one, where pip may be missing
    (programs / "python").write_text(f'#!/bin/sh\nexec "{sys.executable}" "$@"\n')
    (programs / "python").chmod(0o755)
    for module in ("pip", "secrets"):
        (repository / f"{module}.py").write_text("open('RAN', 'w')")
    given = {name: str(tmp_path / name) for name in ("WORDS", "GITHUB_OUTPUT")}
    environment = {"PATH": f"{programs}{os.pathsep}{os.environ['PATH']}", "RUNNER_TEMP": str(tmp_path), **given}
    command = ["bash", "--noprofile", "--norc", "-eo", "pipefail", "-c", script]
    done = subprocess.run(
        command, cwd=repository, env={**environment, **variables}, capture_output=True, text=True, check=False
    )
    assert not (repository / "RAN").exists()
    return done


@pytest.mark.parametrize("name", _SCRIPTS)
def test_inputs_are_never_part_of_a_script(name: str) -> None:
    assert "${{" not in _SCRIPTS[name]


def test_arguments_are_words_and_nothing_else(tmp_path: Path) -> None:
    done = _runner(tmp_path, _SCRIPTS["Check"], ARGS=f"a b\n{_HOSTILE}\n--all", SARIF="out.sarif")
    words = (tmp_path / "WORDS").read_text().split("\n")
    assert words[:4] == ["check", "--format", "sarif", "a"]
    assert words[-2:] == ["--all", ""]
    assert "$(touch" in words
    assert "*.urdf" in words
    assert (done.returncode, (tmp_path / "GITHUB_OUTPUT").read_text()) == (1, "exit-code=1\n")


def test_messages_are_no_commands_to_github(tmp_path: Path) -> None:
    lines = _runner(tmp_path, _SCRIPTS["Check"], ARGS=".", SARIF="").stdout.splitlines()
    begin = next(each for each in lines if each.startswith("::stop-commands::"))
    token = begin.rpartition("::")[2]
    assert len(token) == 32
    assert lines == [begin, "##[set-output name=exit-code]0", f"::{token}::"]


@pytest.mark.parametrize("asked", ["--help", "./nowhere; touch RAN", "$(touch RAN)", "x==1;touch RAN"])
@pytest.mark.slow
def test_what_is_installed_is_one_word_for_pip(asked: str, tmp_path: Path) -> None:
    done = _runner(tmp_path, _SCRIPTS["Install twinform"], ASKED=asked, EXTRAS="", OWN=".")
    assert done.returncode
    assert "ERROR" in done.stderr


def test_a_file_that_is_called_like_an_option_is_a_file_for_the_hooks() -> None:
    for hook in yaml.safe_load((_ROOT / ".pre-commit-hooks.yaml").read_text()):
        assert hook.get("pass_filenames", True) is False or hook["args"][-1] == "--"
