"""The public face of the package."""

import doctest
import inspect
import subprocess
import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path

import pytest

import twinform
from generators.options import OPTIONS
from testbed.corpus.files import ROOT


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


_READERS: list[Callable[[str], object]] = [
    twinform.load,
    partial(twinform.convert, to="sdf"),
    partial(twinform.diff, b"<robot name='a'><link name='b'/></robot>"),
]


@pytest.mark.parametrize("read", _READERS)
@pytest.mark.parametrize("name", ["nope.urdf", "nope.sdf", "nope.urdf.xacro", "nope/nope.urdf"])
def test_a_file_that_is_not_there_is_the_error_of_python_and_ours(read: Callable[[str], object], name: str) -> None:
    with pytest.raises(FileNotFoundError, match="nope") as found:
        read(name)
    assert found.value.filename == name
    assert isinstance(found.value, twinform.CompileError)
    assert found.value.unreadable
    assert found.value.diagnostics[0].rule.name == "unreadable-file"


@pytest.mark.parametrize("read", _READERS)
def test_a_file_that_is_there_and_wrong_is_no_missing_file(read: Callable[[str], object], tmp_path: Path) -> None:
    (tmp_path / "a.urdf").write_text("<robot")
    (tmp_path / "b.urdf").symlink_to("a.urdf")
    for wrong in ("a.urdf", "b.urdf", "."):
        with pytest.raises(twinform.CompileError) as found:
            read(str(tmp_path / wrong))
        assert not isinstance(found.value, OSError)


_FUNCTIONS = [each for each in OPTIONS if each is not twinform.load_description]


@pytest.mark.parametrize("function", _FUNCTIONS, ids=lambda each: each.__name__)
def test_an_example_in_a_docstring_does_what_it_shows(
    function: Callable[..., object], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "examples").symlink_to(ROOT / "examples")
    monkeypatch.chdir(tmp_path)
    (example,) = doctest.DocTestFinder(recurse=False).find(function, globs={"twinform": twinform})
    result = doctest.DocTestRunner().run(example)
    assert result.attempted >= 1
    assert result.failed == 0


@pytest.mark.parametrize("function", OPTIONS, ids=lambda each: each.__name__)
def test_help_says_each_parameter_and_each_option(function: Callable[..., object]) -> None:
    text = inspect.getdoc(function) or ""
    own = [each for each in inspect.signature(function).parameters if each != "options"]
    for name in (*own, *OPTIONS[function].__annotations__):
        assert f"\n    {name}: " in text
