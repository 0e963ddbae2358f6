"""What all tests share."""

import gc
import inspect
import sys
from collections.abc import Generator, Mapping
from functools import partialmethod
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner, Result

from testbed.corpus.files import CORPUS, MISSING
from tests.distributions import Install, write_distribution
from tests.profile import DEEP
from twinform.passes import registered_passes

pytest.register_assert_rewrite("tests.expected")  # so that it shows what differs, as tests do

# The collector walks the modules of 7,600 tests seldom. gc.freeze would do more, but Hypothesis 6.170 asks
# for the number of frozen objects at every example, which doubled the time of properties.
_SELDOM = (20_000, 20, 100)

if "mix_stderr" in inspect.signature(CliRunner).parameters:  # before click 8.2
    runner: Any = CliRunner
    result: Any = Result
    runner.__init__ = partialmethod(CliRunner.__init__, mix_stderr=False)
    result.output = property(lambda run: run.stdout + run.stderr)

_TESTS = Path(__file__).parent
_SLOW_ROOMS = frozenset(
    {"batch", "browser", "corpus", "differential", "growth", "hostile", "oracles", "patterns", "portability", "ros2"}
)
"""Folders whose tests are all slow: they start processes, browsers and engines, or read the whole corpus."""
_QUICK = "not slow"
"""The expression of marks that `make test` asks for."""


@pytest.fixture(scope="session", autouse=True)
def own_caches(tmp_path_factory: pytest.TempPathFactory) -> Generator[None]:
    """Keep what passes make of meshes, and results of `check`, out of the cache of whoever runs the tests.

    Workers of the tests share one.
    """
    base = tmp_path_factory.getbasetemp()
    shared = base.parent if base.name.startswith("popen-") else base
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("TWINFORM_MESH_CACHE", str(shared / "mesh-results"))
        patch.setenv("TWINFORM_CACHE_DIR", str(shared / "results"))
        yield


@pytest.fixture(scope="session")
def corpus() -> Path:
    """The folder of real models; tests that need it are skipped where it is missing."""
    if not CORPUS.is_dir():
        pytest.skip(MISSING)
    return CORPUS


@pytest.fixture(scope="module")
def install(tmp_path_factory: pytest.TempPathFactory) -> Generator[Install]:
    """Put a distribution with these passes on the path, as pip would; all are gone at the end of the file."""
    with pytest.MonkeyPatch.context() as patch:

        def put(distribution: str, passes: Mapping[str, str]) -> None:
            folder = tmp_path_factory.mktemp("site")
            write_distribution(folder, distribution, passes)
            patch.setattr("sys.path", [str(folder), *sys.path])
            registered_passes.cache_clear()

        yield put
    registered_passes.cache_clear()


def pytest_ignore_collect(collection_path: Path, config: pytest.Config) -> bool | None:
    """Whether a folder is passed over because `make test` wants nothing in it: importing it would take a while."""
    return True if config.option.markexpr == _QUICK and _is_slow_room(collection_path) else None


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark the tests of slow rooms, and skip those that only `make prove` runs."""
    for item in items:
        if any(_is_slow_room(folder) for folder in item.path.parents):
            item.add_marker(pytest.mark.slow)
        if not DEEP and item.get_closest_marker("deep"):
            item.add_marker(pytest.mark.skip(reason="only with TWINFORM_PROFILE=deep"))


def _is_slow_room(folder: Path) -> bool:
    """Whether all tests of this folder are slow."""
    return folder.parent == _TESTS and folder.name in _SLOW_ROOMS


@pytest.hookimpl(wrapper=True)
def pytest_collection() -> Generator[None, object, object]:
    """Let the garbage collector seldom walk all tests and modules: a fifth of the time of properties.

    `gc.freeze` would do more, but Hypothesis counts what is frozen at every example.
    """
    gc.disable()
    try:
        return (yield)
    finally:
        gc.set_threshold(*_SELDOM)
        gc.enable()
