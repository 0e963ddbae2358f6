"""What bash, zsh and fish offer when the tab key is pressed; a shell that is not installed is left out."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from twinform.diagnostics import catalog
from twinform.passes import registered_passes
from twinform.schemas import versions_of

pytestmark = pytest.mark.slow

_BASH = """
source <(_TWINFORM_COMPLETE=bash_source twinform)
compopt() { COMPREPLY+=("<files>"); }
COMP_WORDS=(@WORDS@) COMP_CWORD=@COUNT@
_twinform_completion twinform
printf '%s\\n' "${COMPREPLY[@]}"
"""
_ZSH = """
compdef() { :; }
_describe() { local -a found; found=(${(P)3}); print -l -- ${found%%:*}; }
compadd() { print -l -- ${argv[-1]:+${(P)argv[-1]}}; }
_path_files() { print "<files>"; }
eval "$(_TWINFORM_COMPLETE=zsh_source twinform)"
words=(@WORDS@) CURRENT=@COUNT@
_twinform_completion
"""
_FISH = """
_TWINFORM_COMPLETE=fish_source twinform | source
complete -C "@LINE@" | cut -f1
"""
SHELLS = {"bash": _BASH, "zsh": _ZSH, "fish": _FISH}

CASES: dict[tuple[str, ...], set[str]] = {
    ("ch",): {"check"},
    ("explain", "dangling-l"): {"dangling-link"},
    ("check", "--allow", "dangling-l"): {"dangling-link"},
    ("check", "--allow", "phys"): {"physics"},
    ("check", "--engine", "x"): {"xmlschema"},
    ("passes", "fill-l"): {"fill-limits"},
    ("convert", "--passes", "check-inertia,fill-l"): {"check-inertia,fill-limits"},
    ("convert", "--sdf-version", "1.1"): {each for each in versions_of("sdf") if each.startswith("1.1")},
    ("check", "--for", "drake,muj"): {"drake,mujoco"},
    ("check", "--for", "urdfdom@r"): {"urdfdom@rolling"},
    ("advise", "--for", "moveit@j"): {"moveit@jazzy"},
    ("batch", "mer"): {"merge"},
    ("explain", ""): set(catalog()),
    ("passes", ""): set(registered_passes()),
}


def _asked(shell: str, words: tuple[str, ...], folder: Path) -> list[str]:
    if shutil.which(shell) is None:
        pytest.skip(f"{shell} is not installed")
    typed = ["twinform", *words]
    quoted = " ".join(f"'{word}'" for word in typed)
    count = len(typed) - (shell == "bash")
    script = SHELLS[shell].replace("@WORDS@", quoted).replace("@COUNT@", str(count)).replace("@LINE@", " ".join(typed))
    path = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])
    environment = {"PATH": path, "HOME": str(folder)}
    done = subprocess.run(
        [shell, "-c", script], cwd=folder, env=environment, capture_output=True, text=True, check=True
    )
    return done.stdout.split()


@pytest.mark.parametrize("shell", SHELLS)
@pytest.mark.parametrize("words", CASES)
def test_what_is_offered(tmp_path: Path, shell: str, words: tuple[str, ...]) -> None:
    parts = shell == "fish" and "," in words[-1]  # click's script for fish ends a word there
    assert set(_asked(shell, words, tmp_path)) == (set() if parts else CASES[words])


@pytest.mark.parametrize("shell", SHELLS)
@pytest.mark.parametrize("words", [("check", "rob"), ("convert", "rob"), ("convert", "-o", "rob"), ("diff", "rob")])
def test_models_are_files(tmp_path: Path, shell: str, words: tuple[str, ...]) -> None:
    (tmp_path / "robot.urdf").write_text("<robot/>")
    assert set(_asked(shell, words, tmp_path)) & {"<files>", "robot.urdf"}
