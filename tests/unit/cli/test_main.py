import subprocess
import sys
from pathlib import Path

import pytest

import twinform
from testbed.imports import COMMANDS as COMMANDS_OF_ALL_DAY
from testbed.imports import REASONS, imported, of_libraries, packages_beside
from twinform.cli import COMMANDS, main

from .conftest import Run

HEAVY = {"pydantic", "lxml", "xmlschema", "numpy", "rich"}


def python(code: str) -> str:
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout


def test_importing_the_command_line_imports_nothing_heavy() -> None:
    assert not HEAVY & set(python("import sys, twinform.cli; print(*sys.modules)").split())


@pytest.mark.parametrize("module", ["explain", "schema"])
def test_commands_without_a_compiler_do_not_import_pydantic(module: str) -> None:
    assert "pydantic" not in python(f"import sys, twinform.cli.{module}; print(*sys.modules)").split()


def test_version(run: Run) -> None:
    assert run("--version").stdout == f"twinform, version {twinform.__version__}\n"


@pytest.mark.parametrize(("word", "hint"), [("chek", " Did you mean 'check'?"), ("c\x1b[31m", ""), ("c" * 2000, "")])
def test_a_misspelt_command_is_suggested(run: Run, word: str, hint: str) -> None:
    done = run(word)
    assert done.exit_code == 2
    assert done.stderr.endswith(f"'.{hint}\n")
    assert "\x1b" not in done.stderr


def test_help_lists_every_command_with_the_summary_that_it_has(run: Run) -> None:
    listed = run("--help").stdout
    for name, summary in COMMANDS.items():
        assert summary in listed
        command = main.get_command(main.make_context("twinform", [name], resilient_parsing=True), name)
        assert command is not None
        assert (command.help or "").splitlines()[0] == summary


@pytest.mark.parametrize("arguments", [["no-such-command"], ["check"], ["convert"], ["check", "--no-such-option", "x"]])
def test_wrong_usage_exits_2(run: Run, arguments: list[str]) -> None:
    done = run(*arguments)
    assert done.exit_code == 2
    assert done.stdout == ""
    assert "Usage" in done.stderr


def test_a_reader_that_stops_early_sees_no_traceback() -> None:
    command = [sys.executable, "-c", "from twinform.cli import main; main(['schema', 'sdf'])"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        assert process.stdout
        assert process.stderr
        process.stdout.read(1)
        process.stdout.close()
        assert process.stderr.read() == b""


def test_the_package_runs_as_the_command() -> None:
    made = subprocess.run([sys.executable, "-m", "twinform", "--version"], capture_output=True, text=True, check=True)
    assert made.stdout.endswith(f"{twinform.__version__}\n")


_UNUSED = {
    "check": [
        "twinform.passes.legalise",
        "twinform.passes.framework.pass_base",
        "twinform.cli.config_settings",
        "twinform.diagnostics.reporters.sarif",
        "twinform.passes.mesh_jobs.job",
        "twinform.storage",
    ],
    "convert": [
        "twinform.passes.legalise.to_urdf",
        "twinform.passes.framework.options_model",
        "twinform.compiler.expand_includes",
        "twinform.compiler.audit",
    ],
    "format": ["twinform.passes.legalise", "twinform.compiler.input.loading", "twinform.ir.verify", "twinform.storage"],
    "diff": [
        "twinform.passes.framework.options_model",
        "twinform.passes.legalise.to_urdf.sequence",
        "twinform.compiler.compare.compare_robots",
        "twinform.compiler.expand_includes",
        "twinform.cli.config_settings",
    ],
}


@pytest.mark.slow
@pytest.mark.parametrize("command", COMMANDS_OF_ALL_DAY)
def test_a_command_imports_what_it_needs(command: str, tmp_path: Path) -> None:
    found = imported(command, tmp_path)
    assert not {each.name for each in found} & {*_UNUSED[command]}
    brought = {name.partition(".")[0] for name in of_libraries()}  # more on newer Pythons
    assert packages_beside(found).keys() == REASONS[command].keys() - brought


@pytest.mark.slow
def test_importing_what_a_command_needs_asks_no_package_and_validates_nothing() -> None:
    program = (
        "import sys; import twinform.cli.check, twinform.cli.convert, twinform.passes.legalise.to_sdf.sequence;"
        "unused = ['importlib.metadata', 'importlib.resources', 'pydantic.plugin._loader', 'email'];"
        "assert not [name for name in unused if name in sys.modules]"
    )
    subprocess.run([sys.executable, "-c", program], check=True)
