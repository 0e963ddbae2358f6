"""Child processes of Python."""

import re
import subprocess
import sys
from pathlib import Path

import twinform

_ROOT = Path(twinform.__file__).parent
_ANOTHER_WAY = re.compile(r"sys\.executable|get_context\(|set_start_method|ProcessPoolExecutor")
_PROGRAM = """
from twinform.child_python import spawn_context
from multiprocessing import spawn
spawn_context()
spawn_context()
print(*spawn.get_command_line(pipe_handle=1))
"""


def test_child_processes_are_started_in_one_place() -> None:
    files = [file for file in _ROOT.rglob("*.py") if _ANOTHER_WAY.search(file.read_text(encoding="utf-8"))]
    assert files == [_ROOT / "child_python.py"]


def test_a_python_that_ignores_its_environment_starts_children_with_safe_paths_too() -> None:
    done = subprocess.run([sys.executable, "-E", "-c", _PROGRAM], capture_output=True, text=True, check=True)
    assert done.stdout.split()[1:4] == ["-P", "-E", "-c"]
