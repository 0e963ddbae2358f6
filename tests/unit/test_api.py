"""The public face of the package."""

import subprocess
import sys

import pytest

import twinform


def test_every_public_name_is_there_and_sorted() -> None:
    assert sorted(twinform.__all__) == list(twinform.__all__)
    for name in twinform.__all__:
        assert getattr(twinform, name) is not None
    assert set(twinform.__all__) <= set(dir(twinform))


def test_an_unknown_name_is_an_attribute_error() -> None:
    name = "nothing"  # a type checker knows too that it is not there
    with pytest.raises(AttributeError, match="nothing"):
        getattr(twinform, name)


@pytest.mark.parametrize("module", ["twinform", "twinform.compiler", "twinform.cli.convert"])
def test_heavy_libraries_are_not_imported(module: str) -> None:
    code = f"import sys, {module}; print(*{{'numpy', 'xmlschema', 'rich', 'trimesh', 'hypothesis'}} & set(sys.modules))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.split() == []
