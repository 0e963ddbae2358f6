"""The command with a fault at the n-th call to the system, for every n, as SQLite tests itself.

A process imports the program and runs the command once. For each n a fork of it runs the command in a new folder, in
which the n-th call fails, or is interrupted. What is in the folder then is compared with what was there, and with what
a run without a fault leaves.
"""

import builtins
import contextlib
import errno
import io
import json
import os
import shutil
import signal
import stat
import sys
import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property, partial, wraps
from pathlib import Path
from typing import Any, NoReturn

from click.testing import CliRunner

CALLS = (
    "chmod", "chown", "fsync", "link", "listdir", "listxattr", "lstat", "mkdir", "open", "readlink", "remove", "rename",
    "replace", "rmdir", "scandir", "sendfile", "stat", "unlink", "utime", "write",
)  # fmt: skip
"""Functions of `os` that may fail; reading and writing by file objects is counted too."""
ERRORS = {name: getattr(errno, name) for name in ("EIO", "ENOSPC", "EACCES", "EINTR")}
SIGNALS = ("SIGINT", "SIGTERM", "SIGHUP")
FAULTS = (*ERRORS, *(f"{name} {when}" for name in SIGNALS for when in ("before", "after")), "KeyboardInterrupt")
_open = open
CACHE = "kept"
"""The folder of results that are kept for later runs, in which one may be missing."""
_NAMED = (os.devnull, "/twinform/", "/site-packages/", "standard output")
"""What else a message may name than files of the folder."""
_LEFT = "[unreadable-mesh]"
"""What is said of a mesh that cannot be read, and stays as it is."""
_FORGOTTEN = ("Traceback", "Exception ignored", "Fatal Python error")
Tree = Mapping[str, bytes | None]


@dataclass
class Counter:
    """Counts calls, and makes one of them fail."""

    fault: str
    number: int
    count: int = 0

    def around(self, call: Callable[..., Any]) -> Callable[..., Any]:
        """A function that is counted."""

        @wraps(call)
        def counted(*args: Any, **more: Any) -> Any:
            self.count += 1
            if self.count != self.number:
                return call(*args, **more)
            return self._fail(partial(call, *args, **more), args)

        return counted

    def _fail(self, call: Callable[[], Any], args: Sequence[Any]) -> Any:
        if self.fault in ERRORS:
            number = ERRORS[self.fault]
            raise OSError(number, os.strerror(number), args[0] if args and isinstance(args[0], str | Path) else None)
        if self.fault == "KeyboardInterrupt":
            raise KeyboardInterrupt
        name, when = self.fault.split()
        result = call() if when == "after" else None
        signal.raise_signal(signal.Signals[name])
        return result if when == "after" else call()

    def install(self) -> None:
        """Count the calls of this process from now on."""
        for name in CALLS:
            setattr(os, name, self.around(getattr(os, name)))
        opened = self.around(partial(_opened, self))
        io.open = opened
        builtins.open = opened


class _File(io.FileIO):
    """A file whose calls are counted."""

    counter: Counter

    def write(self, data: Any, /) -> int:
        return self.counter.around(super().write)(data)

    def readinto(self, buffer: Any, /) -> Any:
        return self.counter.around(super().readinto)(buffer)

    def readall(self) -> bytes:
        return self.counter.around(super().readall)()


def _opened(counter: Counter, file: Any, mode: str = "r", buffering: int = -1, *text: Any, **more: Any) -> Any:
    """What `open` gives, of a file that counts; pipes to child processes do not."""
    if isinstance(file, int) and stat.S_ISFIFO(os.fstat(file).st_mode):
        return _open(file, mode, buffering, *text, **more)
    raw = _File(file, mode.replace("b", "").replace("t", ""), more.pop("closefd", True), more.pop("opener", None))
    raw.counter = counter
    if buffering == 0:
        return raw
    kind: Any = io.BufferedRandom if "+" in mode else io.BufferedReader if "r" in mode else io.BufferedWriter
    return kind(raw) if "b" in mode else io.TextIOWrapper(kind(raw), *text, **more, line_buffering=buffering == 1)


@dataclass
class Injection:
    """A command before which a folder is made from a template; `apart` means that each file is written for itself.

    Without a fault its exit code is `code`.
    """

    arguments: Sequence[str]
    template: Path
    apart: bool = False
    code: int = 0
    runs: int = 0
    before: Tree = field(init=False)
    after: Tree = field(init=False)
    printed: str = field(init=False)

    def run(self, faults: Sequence[str], every: int) -> Iterator[str]:
        """Each problem with each fault at every n-th call; `runs` counts how often the command was run."""
        self.before = tree(self.template)
        clean = self._once("", 0)
        self.after, self.printed = clean.tree, clean.errors
        if clean.code != self.code:
            yield f"without a fault: exit code {clean.code}: {clean.errors}"
            return
        for index, fault in enumerate(faults):
            number = 1 + (len(self.arguments) + index) % every  # so that a few runs see many calls
            while True:
                done = self._once(fault, number)
                if done.count < number:
                    break
                self.runs += 1
                yield from (f"{fault} at call {number}: {each}" for each in self._problems(done, fault))
                number += every

    def _problems(self, done: "_Done", fault: str) -> Iterator[str]:
        if any(word in done.errors and word not in self.printed for word in _FORGOTTEN):
            yield f"a traceback: {done.errors[-1500:]}"
        if _LEFT not in done.errors and not self._is_whole(done.tree, complete=done.code == 0):
            names = {*done.tree, *self.before}
            changed = sorted(name for name in names if done.tree.get(name, 0) != self.before.get(name, 0))
            yield f"exit code {done.code}, and what is there is neither old nor new: {changed}: {done.errors[-300:]}"
        if done.left:
            yield f"left among temporary files: {done.left}"
        if fault in ERRORS:
            if done.code not in {0, 1, 2}:
                yield f"exit code {done.code}: {done.errors[-500:]}"
            elif done.code and not any(name in done.errors for name in (tempfile.gettempdir(), *_NAMED, *self._names)):
                yield f"the message names no file: {done.errors[-500:]}"
        else:
            name = fault.partition(" ")[0]
            expected = 128 + signal.Signals[name] if name in SIGNALS else 130
            if done.code not in {self.code, expected}:
                yield f"exit code {done.code}: {done.errors[-500:]}"

    def _is_whole(self, found: Tree, *, complete: bool) -> bool:
        if not self.apart and not complete:
            return found in (self.before, self.after)
        return (not complete or _without_cache(found) == _without_cache(self.after)) and all(
            found.get(name, 0) in (self.before.get(name, 0), self.after.get(name, 0))
            for name in {*found, *self.before, *self.after}
        )

    @cached_property
    def _names(self) -> set[str]:
        return {Path(name).name for name in (*self.before, *self.after)}

    def _once(self, fault: str, number: int) -> "_Done":
        """Run the command in a fork, in a folder of its own."""
        top = Path(tempfile.mkdtemp(prefix="injected-"))  # not one that goes at exit, which a fork has too
        here, temporary, errors = top / "here", top / "tmp", top / "errors"
        shutil.copytree(self.template, here, symlinks=True)
        temporary.mkdir()
        reading, writing = os.pipe()
        child = os.fork()
        if not child:
            try:
                self._become(here, temporary, errors, Counter(fault, number), writing)
            finally:
                os._exit(99)
        os.close(writing)
        with os.fdopen(reading, "rb") as counted:
            count = int.from_bytes(counted.read(), "big")
        code = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
        done = _Done(code, count, errors.read_text(errors="replace"), tree(here), sorted(tree(temporary)))
        shutil.rmtree(top)
        return done

    def _become(self, here: Path, temporary: Path, errors: Path, counter: Counter, pipe: int) -> NoReturn:
        os.chdir(here)
        os.environ["TMPDIR"] = tempfile.tempdir = str(temporary)
        nothing, messages = os.open(os.devnull, os.O_RDWR), os.open(errors, os.O_WRONLY | os.O_CREAT)
        for stream, number in ((nothing, 0), (nothing, 1), (messages, 2)):
            os.dup2(stream, number)
        leave, write = os._exit, os.write

        def counted_exit(code: int) -> NoReturn:
            write(pipe, counter.count.to_bytes(8, "big"))
            leave(code)

        os._exit = counted_exit
        sys.argv = ["twinform", *self.arguments]
        from twinform.__main__ import program  # noqa: PLC0415 - it changes what signals do

        counter.install()
        try:
            program()
        except SystemExit as end:
            counted_exit(end.code if isinstance(end.code, int) else 0)
        except BaseException as error:  # noqa: BLE001 - as Python does at its end
            sys.excepthook(type(error), error, error.__traceback__)
        counted_exit(1)


@dataclass
class _Done:
    code: int
    count: int
    errors: str
    tree: Tree
    left: list[str]


def tree(folder: Path) -> Tree:
    """All files of a folder with their bytes, and its folders with None."""
    return {
        path.relative_to(folder).as_posix(): path.read_bytes() if path.is_file() else None for path in folder.rglob("*")
    }


def _without_cache(tree: Tree) -> Tree:
    return {path: content for path, content in tree.items() if path.partition("/")[0] != CACHE}


def main() -> None:
    """Print the problems of an injection, and how many runs there were."""
    request = json.loads(sys.argv[1])
    injection = Injection(request["arguments"], Path(request["template"]), request["apart"], request["code"])
    warm(injection)
    problems = list(injection.run(request["faults"], request["every"]))
    sys.stdout.write(json.dumps({"runs": injection.runs, "problems": problems}))


def warm(injection: Injection) -> None:
    """Run the command in this process, which imports what it needs. No child process stays, which forks would share."""
    from twinform.cli import main as command  # noqa: PLC0415 - who only wants the names of faults does not need it
    from twinform.passes.mesh_jobs.child_process import shared  # noqa: PLC0415 - as above

    with tempfile.TemporaryDirectory() as top:
        here = Path(top, "here")
        shutil.copytree(injection.template, here, symlinks=True)
        with contextlib.chdir(here):
            CliRunner().invoke(command, list(injection.arguments))
    shared().end()


if __name__ == "__main__":
    main()
