"""What the process imports until it is confined, which it does for each file."""

import site
import subprocess
import sys

from twinform.compiler.input import xacro

_SCRIPT = f"{xacro.__path__[0]}/__main__.py"
_PROGRAM = """
import sys
from types import SimpleNamespace
script, data = sys.argv.pop(1), sys.argv.pop()
made = {"__name__": "script", "__file__": script}
exec(open(script).read(), made)
made["add_packages"]()
from twinform.compiler.input.xacro import expander, process
nobody = SimpleNamespace(environment=None, match=None)
expander.Expander(nobody, "robot.xacro", yaml=data == "data")
print(*sys.modules)
"""
_DEAR = {"optparse", "pathlib", "textwrap", "twinform.schemas", "urllib.parse", "xacro.cli"}
"""What takes long to import; the command line of xacro is the only one of these that it asks for."""


def _imported(*words: str) -> set[str]:
    command = [sys.executable, "-P", "-S", "-s", "-c", _PROGRAM, _SCRIPT, *site.getsitepackages(), *words]
    return set(subprocess.run(command, capture_output=True, text=True, check=True).stdout.split())


def test_the_process_imports_what_it_needs() -> None:
    assert not _imported("none") & {*_DEAR, "yaml"}


def test_the_process_imports_yaml_where_a_file_reads_data() -> None:
    found = _imported("data")
    assert "yaml" in found
    assert not found & _DEAR
