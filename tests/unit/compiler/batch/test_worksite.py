"""What workers on other machines must have in common with the command, before they are given a model."""

from collections.abc import Callable, Mapping
from concurrent.futures import Executor, ThreadPoolExecutor
from dataclasses import replace
from importlib.metadata import PackageNotFoundError
from pathlib import Path

import pytest

from twinform.compiler import ConversionRequest, LoadOptions
from twinform.compiler.batch import Batch, Convert, ModelResult, UnfitWorkerError, batch, of_folder
from twinform.compiler.batch.worksite import Worksite, worksite
from twinform.compiler.search.resolve_uris import SearchPath
from twinform.compiler.workers import Runner

_MACHINE = "machine-7 (tcp://10.0.0.7:9)"
Answer = Callable[..., object]


def _run(folder: Path, answer: Answer, library: Path | None = None) -> list[ModelResult]:
    """A run on a worker that gives its own answer to each question."""
    source = folder / "src"
    source.mkdir(exist_ok=True)
    (source / "one.urdf").write_text('<robot name="r"><link name="a"/></robot>')

    def everywhere(_: Executor, function: Answer, words: tuple[object, ...]) -> Mapping[str, object]:
        return {_MACHINE: answer(function, *words)}

    runner = Runner(open=lambda: ThreadPoolExecutor(1), window=1, everywhere=everywhere)
    asked = Batch(
        source=source,
        entries=of_folder(source),
        job=Convert(to=ConversionRequest(to="sdf")),
        load_options=LoadOptions(search=SearchPath(own=(library,) if library else ())),
        dest=folder / "out",
    )
    with batch(asked, runner) as found:
        return list(found)


def _of_another_version(function: Answer, *words: object) -> object:
    return "0.0.1" if function is not worksite else function(*words)


def _without_twinform(function: Answer, *words: object) -> object:
    return PackageNotFoundError("twinform") if function is not worksite else function(*words)


def _of_another_kind(function: Answer, *words: object) -> object:
    return ImportError("no module") if function is worksite else function(*words)


def _honest(function: Answer, *words: object) -> object:
    return function(*words)


def _with_other(**versions: str) -> Answer:
    def answer(function: Answer, *words: object) -> object:
        found = function(*words)
        return replace(found, versions={**found.versions, **versions}) if isinstance(found, Worksite) else found

    return answer


def _seeing(text: str | None, name: str) -> Answer:
    def answer(function: Answer, *words: object) -> object:
        found = function(*words)
        if not isinstance(found, Worksite):
            return found
        return replace(
            found, contents={**found.contents, **{each: text for each in found.contents if each.endswith(name)}}
        )

    return answer


@pytest.mark.parametrize(
    ("answer", "problem"),
    [
        (_of_another_version, "has twinform 0.0.1, and here it is "),
        (_without_twinform, "has no twinform"),
        (_with_other(xacro="1.2.3"), "has xacro 1.2.3, and here it is "),
        (_with_other(**{"the code of twinform": "x"}), "with other code than here"),
        (_seeing(None, "/src"), "does not see .*/src$"),
        (_seeing(None, "one.urdf"), "does not see .*/src/one.urdf$"),
        (_seeing("x", "one.urdf"), "has another .*/src/one.urdf$"),
        (_seeing(None, "library"), "does not see .*/library$"),
        (_of_another_kind, "does not know what is asked of it: no module"),
    ],
)
def test_a_worker_that_does_not_fit_ends_the_run_before_the_first_model(
    answer: Answer, problem: str, tmp_path: Path
) -> None:
    (tmp_path / "library").mkdir()
    with pytest.raises(UnfitWorkerError, match=problem) as caught:
        _run(tmp_path, answer, tmp_path / "library")
    assert str(caught.value).startswith(_MACHINE)
    assert list((tmp_path / "out").glob("*.sdf")) == []


def test_a_worker_like_this_one_is_given_the_models(tmp_path: Path) -> None:
    (found,) = _run(tmp_path, _honest)
    assert found.record.outcome == "converted"


def test_a_worker_that_came_later_and_does_not_fit_ends_the_run(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("twinform.compiler.batch.task.fingerprint", lambda: "another")
    with pytest.raises(UnfitWorkerError, match="is another one, on "):
        _run(tmp_path, _honest)
    assert list((tmp_path / "out").glob("*.sdf")) == []
