"""The pytest plugin: model files of a repository as tests, and fixtures that read models.

It is loaded at every start of pytest and does nothing until it is asked to:

    [tool.pytest.ini_options]
    twinform_models = ["urdf/*.urdf", "worlds/*.sdf", "*.urdf.xacro"]

Each file that matches becomes a test `check` and, if `twinform_round_trip` is set, a second one, `round-trip`.
"""

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from twinform import Document

SUFFIXES = frozenset({".urdf", ".sdf", ".world", ".mjcf", ".xacro"})


class ModelError(AssertionError):
    """A model file that does not pass its test; the message is the report."""


def pytest_addoption(parser: pytest.Parser) -> None:
    """Declare the settings of the ini file; without the first, nothing is collected."""
    parser.addini("twinform_models", "patterns of the model files that are tests", type="args", default=[])
    parser.addini("twinform_strict", "refuse what readers ignore in model files", type="bool", default=False)
    parser.addini("twinform_round_trip", "try the way to the other format and back", type="bool", default=False)
    parser.addini("twinform_paths", "folders of models and packages", type="paths", default=[])


def pytest_collect_file(file_path: Path, parent: pytest.Collector) -> pytest.Collector | None:
    """Collect a model file that a pattern of the ini file fits."""
    patterns: list[str] = parent.config.getini("twinform_models")
    if file_path.suffix not in SUFFIXES or not any(map(file_path.match, patterns)):
        return None
    return ModelFile.from_parent(parent, path=file_path)  # pyright: ignore[reportUnknownMemberType] - pytest leaves its keywords open


class ModelFile(pytest.File):
    """The tests of one model file."""

    def collect(self) -> Iterator[pytest.Item]:
        """Yield the tests."""
        yield CheckItem.from_parent(self, name="check")  # pyright: ignore[reportUnknownMemberType] - pytest leaves its keywords open
        if self.config.getini("twinform_round_trip"):
            yield RoundTripItem.from_parent(self, name="round-trip")  # pyright: ignore[reportUnknownMemberType] - pytest leaves its keywords open


class _ModelItem(pytest.Item):
    def repr_failure(self, excinfo: pytest.ExceptionInfo[BaseException], style: object = None) -> str:
        """Return only the report if the model fails, and a traceback if the test does."""
        del style
        return str(excinfo.value) if excinfo.errisinstance(ModelError) else str(excinfo.getrepr(style="short"))

    def reportinfo(self) -> tuple[Path, int | None, str]:
        """Return the file as the place of the test."""
        return self.path, None, f"{self.path.name}: {self.name}"


class CheckItem(_ModelItem):
    """Tests that `twinform check` finds no error in a file."""

    def runtest(self) -> None:
        """Check the file."""
        from twinform.compiler import check  # noqa: PLC0415 - pytest has to start without the compiler
        from twinform.diagnostics.reporters import REPORTERS, FileFindings  # noqa: PLC0415 - as above

        paths: list[Path] = self.config.getini("twinform_paths")
        checked = check(self.path, strict=self.config.getini("twinform_strict"), paths=paths)
        if not checked.accepted:
            errors = tuple(each for each in checked.diagnostics if each.is_error)
            raise ModelError(REPORTERS["text"]([FileFindings(checked.path, errors)]))


class RoundTripItem(_ModelItem):
    """Tests that a round trip through the other format restores a file."""

    def runtest(self) -> None:
        """Convert the file to the other format and back."""
        from twinform import load  # noqa: PLC0415 - as above
        from twinform.testing.properties import assert_round_trip  # noqa: PLC0415 - as above

        paths: list[Path] = self.config.getini("twinform_paths")
        document = load(self.path, paths=paths)
        try:
            assert_round_trip(document, via=document.format.counterpart.value)
        except AssertionError as error:
            raise ModelError(f"{self.path}: {error}") from error


@pytest.fixture
def load_model(request: pytest.FixtureRequest) -> Callable[[str | Path], "Document"]:
    """Provide a function that reads a model file, named relative to the test file or to the root of the repository."""

    def load_it(name: str | Path) -> "Document":
        from twinform import load  # noqa: PLC0415 - as above

        beside = request.path.parent / name
        return load(beside if beside.exists() else request.config.rootpath / name)

    return load_it
