"""What workers on other machines must have in common with the command that gives them a model."""

import platform
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from pathlib import Path
from typing import Any

import pytest

from twinform.compiler import ConversionRequest, LoadOptions
from twinform.compiler.batch import Batch, Convert, ModelResult, UnfitWorkerError, batch, of_folder
from twinform.compiler.batch import task as tasks
from twinform.compiler.resolve_uris import SearchPath
from twinform.compiler.workers import Runner

_MODEL = '<robot name="r"><link name="a"/></robot>'
Change = Callable[[Path, pytest.MonkeyPatch], None]


class _Elsewhere(ThreadPoolExecutor):
    """Another machine, which differs in what `change` changes before a model is worked on, until it has been seen."""

    def __init__(self, change: Callable[[], None], undo: Callable[[], None]) -> None:
        super().__init__(1)
        self.change, self.undo = change, undo

    def submit(self, fn: Any, /, *args: Any, **kwargs: Any) -> Future[Any]:
        self.change()
        done: Future[Any] = Future()
        done.set_result(fn(*args, **kwargs))
        self.undo()
        return done


def _run(folder: Path, change: Callable[[], None], undo: Callable[[], None] = lambda: None) -> list[ModelResult]:
    """A run on a worker which is changed before each model, and back again behind it."""
    source, library = folder / "src", folder / "library"
    for each in (source, library):
        each.mkdir(exist_ok=True)
    (source / "one.urdf").write_text(_MODEL)
    runner = Runner(open=lambda: _Elsewhere(change, undo), window=1, remote=True)
    asked = Batch(
        source=source,
        entries=of_folder(source),
        job=Convert(to=ConversionRequest(to="sdf")),
        load_options=LoadOptions(search=SearchPath(own=(library,))),
        dest=folder / "out",
    )
    with batch(asked, runner) as found:
        return list(found)


def _has(name: str, version: str) -> Change:
    def change(_: Path, patch: pytest.MonkeyPatch) -> None:
        found = tasks.versions() | {name: version}
        patch.setattr(tasks, "versions", lambda: found)

    return change


def _of_another_version(_: Path, patch: pytest.MonkeyPatch) -> None:
    patch.setattr(tasks, "own_version", lambda: "0.0.1")


def _without(name: str) -> Change:
    return lambda folder, _: (folder / name).rename(folder / "hidden") and None


def _with_other_content(folder: Path, _: pytest.MonkeyPatch) -> None:
    (folder / "src/one.urdf").write_text(f"{_MODEL} ")


def _restore(folder: Path, name: str) -> None:
    if (folder / "hidden").exists():
        (folder / "hidden").rename(folder / name)
    (folder / "src/one.urdf").write_text(_MODEL)


@pytest.mark.parametrize(
    ("change", "lost", "problem"),
    [
        (_of_another_version, "", r"has twinform 0\.0\.1, and .* asks for the work"),
        (_has("twinform", ""), "", "has twinform missing, not twinform "),
        (_has("xacro", "1.2.3"), "", r"has xacro 1\.2\.3, not xacro "),
        (_has("the code of twinform", "x"), "", "has the code of twinform x, not the code of twinform "),
        (_without("src"), "src", "does not see .*/src$"),
        (_without("src/one.urdf"), "src/one.urdf", r"does not see .*/src/one\.urdf$"),
        (_with_other_content, "", r"has another .*/src/one\.urdf$"),
        (_without("library"), "library", "does not see .*/library$"),
    ],
)
def test_a_worker_that_does_not_fit_ends_the_run_and_makes_nothing(
    change: Change, lost: str, problem: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def undo() -> None:
        monkeypatch.undo()
        _restore(tmp_path, lost)

    with pytest.raises(UnfitWorkerError, match=problem) as caught:
        _run(tmp_path, lambda: change(tmp_path, monkeypatch), undo)
    assert str(caught.value).startswith(platform.node())
    assert list((tmp_path / "out").glob("*.sdf")) == []


def test_a_worker_like_this_one_is_given_the_models(tmp_path: Path) -> None:
    (found,) = _run(tmp_path, lambda: None)
    assert found.record.outcome == "converted"


def test_a_model_that_changes_here_meanwhile_is_no_fault_of_the_worker(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (found,) = _run(tmp_path, lambda: _with_other_content(tmp_path, monkeypatch))
    assert (found.record.outcome, found.record.message) == ("unreadable", "it has changed in the meantime")
    assert found.record.dependencies == ()
