"""Every report by its name: `python -m reports NAME [options]`; without a name, the list of them."""

import ast
import pkgutil
import sys
from importlib import import_module
from pathlib import Path

from reports.harness.report import Report, run

_FOLDER = Path(__file__).parent
_NO_REPORTS = {"__main__", "harness", "pictures"}
_MODULES = {each.name: each.ispkg for each in pkgutil.iter_modules([str(_FOLDER)]) if each.name not in _NO_REPORTS}


def main(arguments: list[str]) -> int:
    """Run a report, or list them all."""
    if not arguments or arguments[0] not in _MODULES:
        print(*(f"{name:<18} {question(name)}" for name in _MODULES), sep="\n")
        return 2 if arguments else 0
    return run(report(arguments[0]), arguments[1:])


def names() -> list[str]:
    """The names of all reports."""
    return list(_MODULES)


def report(name: str) -> Report:
    """The report of a name."""
    return import_module(f"reports.{name}.report" if _MODULES[name] else f"reports.{name}").REPORT


def question(name: str) -> str:
    """What a report is about: the first line of its docstring."""
    path = _FOLDER / name / "__init__.py" if _MODULES[name] else _FOLDER / f"{name}.py"
    return (ast.get_docstring(ast.parse(path.read_text(encoding="utf-8"))) or "").partition("\n")[0]


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
