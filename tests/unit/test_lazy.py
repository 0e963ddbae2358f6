"""Packages whose names are imported when they are first used."""

import ast
import subprocess
import sys
from importlib import import_module
from pathlib import Path

import pytest

from twinform.lazy import lazy_attributes

PACKAGES = (
    "twinform",
    "twinform.compiler",
    "twinform.passes",
    "twinform.passes.sdf_versions.kinds",
    "twinform.text",
)


def _typed(package: str) -> dict[str, str]:
    """The names that a type checker sees, and where they come from."""
    tree = ast.parse(Path(str(import_module(package).__file__)).read_text())
    (block,) = [node for node in tree.body if isinstance(node, ast.If)]
    imports = [node for node in block.body if isinstance(node, ast.ImportFrom)]
    return {alias.name: node.module or "" for node in imports for alias in node.names}


@pytest.mark.parametrize("package", PACKAGES)
def test_what_is_there_is_what_a_type_checker_sees(package: str) -> None:
    module, typed = import_module(package), _typed(package)
    assert sorted(typed) == sorted(set(module.__all__))
    for name, home in typed.items():
        assert getattr(module, name) is getattr(import_module(home), name)


@pytest.mark.parametrize("package", PACKAGES)
def test_other_names_are_not_there(package: str) -> None:
    with pytest.raises(AttributeError, match=f"module '{package}' has no attribute 'nothing'"):
        import_module(package).nothing  # noqa: B018 - asked for


def test_a_name_is_looked_for_once() -> None:
    program = "import twinform.compiler as c; assert 'check' not in vars(c); c.check; assert 'check' in vars(c)"
    subprocess.run([sys.executable, "-c", program], check=True)


def test_a_name_that_its_module_lacks_is_an_attribute_error() -> None:
    with pytest.raises(AttributeError, match="nothing"):
        lazy_attributes("twinform", {"twinform.lazy": "nothing"})("nothing")
