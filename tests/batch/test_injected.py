"""Faults at the n-th call of a run, for every n: whatever fails, results of earlier runs stay as they were.

The run is the one of the command without its processes: the work is done where it is handed over, so that one counter
sees every file that is opened, moved, linked or removed, by the work as by what keeps its results.
"""

import errno
import shutil
import sys
from collections.abc import Callable, Iterator
from concurrent.futures import BrokenExecutor, CancelledError, Executor, Future
from contextlib import nullcontext, suppress
from functools import partial
from itertools import count
from pathlib import Path
from typing import Any

import pytest
from pebble import ProcessExpired

from tests.profile import DEEP
from twinform.compiler import ConversionRequest, LoadOptions
from twinform.compiler.batch import Batch, Convert, batch, of_folder
from twinform.compiler.batch.entries import Shard
from twinform.compiler.batch.manifest import Manifest
from twinform.compiler.batch.recording import merge
from twinform.compiler.resolve_uris import SearchPath
from twinform.compiler.workers import Runner, process_runner
from twinform.storage.staging import PREFIX

from .conftest import results

_EVENTS = frozenset({"open", "os.rename", "os.remove", "os.mkdir", "os.link", "os.chmod", "os.scandir", "os.listdir"})
_STEP = 1 if DEEP else 9
"""Every so many calls one fails; `make prove` tries all."""
_URDF = '<robot name="{0}"><link name="a"/></robot>'
_WRONG = '<robot name="r"><link name="a"/><link name="a"/></robot>'
_CRATE = '<sdf version="1.11"><model name="crate"><link name="{0}"/></model></sdf>'
_WORLD = '<sdf version="1.11"><world name="w"><include><uri>model://crate</uri></include></world></sdf>'
_CONFIG = '<model><sdf version="1.11">model.sdf</sdf></model>'


class _Faults:
    """Lets something fail at one call that touches a file below a folder, and counts them all."""

    def __init__(self) -> None:
        self.folder, self.at, self.count = "", 0, 0
        self.fault: Callable[[], object] | None = None

    def hear(self, event: str, arguments: tuple[Any, ...]) -> None:
        if self.folder and event in _EVENTS and str(arguments[0]).startswith(self.folder):
            self.count += 1
            if self.fault is not None and self.count == self.at:
                self.fault()

    def begin(self, folder: Path, at: int, fault: Callable[[], object]) -> None:
        """Count anew from the next call on."""
        self.at, self.fault, self.count, self.folder = at, fault, 0, str(folder)


_FAULTS = _Faults()
sys.addaudithook(_FAULTS.hear)


def _raise(error: BaseException) -> None:
    raise error


class _Here(Executor):
    """Does the work at once; the n-th job ends with an error, or cannot be handed over."""

    def __init__(self, at: int = -1, error: BaseException | None = None, *, on_submit: bool = False) -> None:
        self.at, self.error, self.on_submit, self.count = at, error, on_submit, 0

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        self.count += 1
        future: Future[Any] = Future()
        if self.error is not None and self.count == self.at:
            if self.on_submit:
                raise self.error
            future.set_exception(self.error)
            return future
        try:
            future.set_result(fn(*args, **kwargs))
        except Exception as error:  # noqa: BLE001 - as any executor does
            future.set_exception(error)
        return future


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A finished run in `done`, and sources of which some have changed since then, one to a wrong one."""
    monkeypatch.chdir(tmp_path)
    texts = {f"{name}.urdf": _URDF.format(name) for name in ("one", "two", "three", "four")}
    texts |= {"crate/model.sdf": _CRATE.format("base"), "crate/model.config": _CONFIG, "w.world": _WORLD}
    for name, text in texts.items():
        _put(name, text)
    (tmp_path / "src/.git").mkdir()
    _run("done", _Here())
    for name, text in {"two.urdf": _URDF.format("owt"), "crate/model.sdf": _CRATE.format("foot")}.items():
        _put(name, text)
    _put("three.urdf", _WRONG)
    _run("wanted", _Here())
    return tmp_path


def _put(name: str, text: str) -> None:
    path = Path("src", name)
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)


def _run(
    dest: str, executor: Executor, runner: Runner | None = None, *, fresh: bool = False, shard: Shard | None = None
) -> None:
    source = Path("src")
    asked = Batch(
        source=source,
        entries=of_folder(source),
        job=Convert(to=ConversionRequest(to="sdf", expand_includes=True), ledgers=True),
        load_options=LoadOptions(search=SearchPath()),
        dest=Path(dest),
        fresh=fresh,
        shard=shard,
    )
    with batch(asked, runner or executor) as found:
        for _ in found:
            pass


def _fail(run: Callable[[], None]) -> None:
    """Run after a finished run, and hold what is there then to what was there before."""
    shutil.rmtree("out", ignore_errors=True)
    shutil.copytree("done", "out")
    with suppress(OSError, RuntimeError, KeyboardInterrupt, BrokenExecutor, CancelledError):
        run()
    _FAULTS.folder = ""
    wanted, before, after = _files("wanted"), _files("done"), _files("out")
    for name, text in before.items():
        assert name in after or name not in wanted, name
        assert after.get(name, text) in {text, wanted.get(name)}, name
    assert set(after) <= set(before) | set(wanted)
    _run("out", _Here())
    assert _files("out") == wanted


def _files(folder: str) -> dict[str, bytes]:
    """Results without what is hidden: where removing it is the call that fails, a file that was being written stays."""
    found = results(folder).items()
    return {name: text for name, text in found if not any(part.startswith(".") for part in Path(name).parts)}


def _until_none(error: BaseException, *, fresh: bool) -> Iterator[int]:
    """Fail at more and more calls, until there are no more."""
    at = 1
    while True:

        def run(at: int = at) -> None:
            _FAULTS.begin(Path.cwd(), at, partial(_raise, error))
            _run("out", _Here(), fresh=fresh)

        _fail(run)
        yield at
        if _FAULTS.count < at:
            return
        at += _STEP


@pytest.mark.parametrize("fresh", [False, True])
@pytest.mark.parametrize(
    "error",
    [OSError(errno.EIO, "Input/output error"), OSError(errno.ENOSPC, "No space left on device"), KeyboardInterrupt()],
    ids=["io", "full", "interrupt"],
)
def test_a_call_that_fails_loses_no_result(error: BaseException, fresh: bool, here: Path) -> None:
    assert here.is_dir()
    assert max(_until_none(error, fresh=fresh)) > 40


class _Unplugged(_Here):
    """Takes the disk of the results away at a call that comes after the first job was handed over."""

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        if not self.count:
            _FAULTS.begin(Path("out").absolute(), self.at, lambda: Path("out").rename("away"))
        return super().submit(fn, *args, **kwargs)


def test_nothing_is_written_where_the_folder_of_the_results_was(here: Path) -> None:
    for at in count(1, _STEP):

        def run(at: int = at) -> None:
            try:
                _run("out", _Unplugged(at), fresh=True)
            finally:
                _FAULTS.folder = ""
                if Path("away").is_dir():
                    assert not Path("out").exists()
                    Path("away").rename("out")

        _fail(run)
        if _FAULTS.count < at:
            assert at > 10
            break


def _manifests(folder: str) -> dict[str, bytes]:
    """What is kept beside results: the manifests, and nothing else that has content."""
    found = Path(folder, ".twinform-batch").rglob("*")
    return {path.name: content for path in found if path.is_file() and (content := path.read_bytes())}


@pytest.mark.parametrize(
    "error", [OSError(errno.EIO, "Input/output error"), KeyboardInterrupt()], ids=["io", "interrupt"]
)
def test_a_merge_that_fails_leaves_the_manifests_of_all_shards(error: BaseException, here: Path) -> None:
    for number in (1, 2):
        _run("shards", _Here(), shard=Shard(number, 2))
    shutil.copytree("shards", "merged")
    merge(here / "merged", [])
    before, after = _manifests("shards"), _manifests("merged")
    assert (len(before), len(after)) == (2, 1)
    for at in count(1, _STEP):
        shutil.rmtree("out", ignore_errors=True)
        shutil.copytree("shards", "out")
        _FAULTS.begin(here / "out", at, partial(_raise, error))
        with suppress(OSError, KeyboardInterrupt):
            merge(here / "out", [])
        _FAULTS.folder = ""
        assert _manifests("out") in (before, after)
        assert not [*Path("out").rglob(f"{PREFIX}*")]
        if _FAULTS.count < at:
            assert at > 10
            break


@pytest.mark.parametrize("on_submit", [False, True])
@pytest.mark.parametrize(
    "error",
    [
        BrokenExecutor(),
        CancelledError(),
        OSError("gone"),
        RuntimeError(),
        MemoryError(),
        TimeoutError(),
        ProcessExpired(""),
    ],
    ids=lambda error: type(error).__name__,
)
def test_an_executor_that_fails_loses_no_result(error: BaseException, on_submit: bool, here: Path) -> None:
    assert here.is_dir()
    usual = process_runner(1)
    for at in range(1, 7):
        executor = _Here(at, error, on_submit=on_submit)
        runner = Runner(open=lambda executor=executor: nullcontext(executor), window=3, failure=usual.failure)
        _fail(lambda executor=executor, runner=runner: _run("out", executor, runner, fresh=True))


@pytest.mark.parametrize("dest", ["done", "new"])
def test_a_result_whose_record_was_cut_off_goes_with_the_next_verdict(
    dest: str, here: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A run that is killed between the two, and a model that has an error by the next run."""
    result = here / dest / "crate/model.sdf"
    before = result.read_bytes() if dest == "done" else b""
    with monkeypatch.context() as patch:

        def end(*_: object) -> None:
            raise KeyboardInterrupt

        patch.setattr(Manifest, "add", end)
        one = _Here()
        with pytest.raises(KeyboardInterrupt):
            _run(dest, one, Runner(open=lambda: nullcontext(one), window=1))
    assert result.read_bytes() != before
    _put("crate/model.sdf", _CRATE.format("a").replace("<link", '<link name="a"/><link'))
    _run(dest, _Here())
    assert not result.exists()
    _put("crate/model.sdf", _CRATE.format("foot"))
    _put("three.urdf", _URDF.format("three"))
    _run(dest, _Here())
    assert result.is_file()
    assert (here / dest / ".twinform-batch/journal.jsonl").read_bytes() == b""
