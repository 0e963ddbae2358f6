"""What the operating system holds a confined process to, layer by layer, whatever code runs in it."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from twinform.compiler.input.xacro.process import limit
from twinform.confinement import confine, kernel, resources

_ROOT = Path(__file__).parents[2]
_TRIES = {
    "read": "open('/etc/passwd')",
    "write": "open('written', 'w')",
    "list": "os.listdir('/')",
    "make": "os.mkdir('made')",
    "delete": "os.unlink('here')",
    "look": "os.stat('/etc/passwd')",
    "fork": "os._exit(0) if os.fork() == 0 else os.wait()",
    "start": "os.posix_spawn('/bin/true', ['true'], {})",
    "become": "os.execv('/bin/true', ['true'])",
    "connect": "socket.socket()",
    "signal": "os.kill(os.getppid(), 0)",
    "code": "mmap.mmap(-1, 4096, prot=mmap.PROT_READ | mmap.PROT_EXEC)",
    "other code": "ctypes.CDLL(None).dlopen(b'/lib/libm.so.6', 2) or 1 / 0",
    "more files": "resource.setrlimit(resource.RLIMIT_NOFILE, (64, 64))",
    "calculate": "sum(range(1000)) and bytearray(2**24) and os.urandom(8) and mmap.mmap(-1, 4096)",
}
_SCRIPT = """
import ctypes, json, mmap, os, resource, socket, sys
from importlib import import_module
name, tries = sys.argv[1], json.loads(sys.argv[2])
module = import_module("twinform.confinement" + (name and "." + name.split(":")[0]))
sys.stdin.readline()
held = getattr(module, name.partition(":")[2] or "confine")()
done = {}
for what, code in tries.items():
    try:
        eval(code)
        done[what] = True
    except (OSError, ValueError, ZeroDivisionError):
        done[what] = False
os.write(1, json.dumps([held, done]).encode())
os._exit(0)
"""
_LAYERS = {
    "landlock": "kernel:renounce_files",
    "resources": "resources:renounce_descriptors",
    "seccomp": "kernel:renounce_calls",
}
_HELD = {
    "landlock": {"read", "write", "list", "make", "delete", "start", "become"},
    "resources": {"read", "write", "list", "connect"},
    "seccomp": set(_TRIES) - {"calculate"},
    "": set(_TRIES) - {"calculate"},
}
"""What each layer alone keeps from happening, and all of them together."""


def _tried(layer: str, folder: Path) -> tuple[object, dict[str, bool]]:
    (folder / "here").touch()
    # limits alone let a program take the place of this one, which then finds none of its files
    tries = {what: code for what, code in _TRIES.items() if what not in {"become", "start"} or layer != "resources"}
    command = [sys.executable, "-c", _SCRIPT, _LAYERS.get(layer, ""), json.dumps(tries)]
    environment = {**os.environ, "PYTHONPATH": str(_ROOT)}
    done = subprocess.run(
        command, cwd=folder, env=environment, input=b"\n", capture_output=True, timeout=60, check=False
    )
    assert done.stdout, done.stderr
    return tuple(json.loads(done.stdout))


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="what is tried is tried on Linux")
@pytest.mark.parametrize("layer", _HELD)
def test_what_a_layer_holds(layer: str, tmp_path: Path) -> None:
    held, done = _tried(layer, tmp_path)
    if not held:
        pytest.skip(f"this kernel does not have {layer}")
    kept = {what for what, worked in done.items() if not worked}
    assert done["calculate"]
    assert kept >= (_HELD[layer] if layer or "seccomp" in str(held) else _HELD["resources"])
    assert {path.name for path in tmp_path.iterdir()} <= ({"here"} if layer == "" else {"here", "made"})


def test_layers_hold_in_this_order_or_are_left_out(monkeypatch: pytest.MonkeyPatch) -> None:
    tried: list[str] = []

    def renounce(name: str, *, holds: bool) -> object:
        def call(**_: bool) -> bool:
            tried.append(name)
            return holds

        return call

    package = "twinform.confinement"
    monkeypatch.setattr(f"{package}.kernel.renounce_files", renounce("landlock", holds=False))
    monkeypatch.setattr(f"{package}.renounce_descriptors", renounce("resources", holds=True))
    monkeypatch.setattr(f"{package}.kernel.renounce_calls", renounce("seccomp", holds=True))
    assert confine() == ["resources", "seccomp"]
    assert tried == ["landlock", "resources", "seccomp"]


def test_a_python_without_ctypes_is_held_to_limits(monkeypatch: pytest.MonkeyPatch) -> None:
    package = "twinform.confinement"

    def renounce(*, threads: bool, opens: bool) -> bool:
        del threads, opens
        return True

    monkeypatch.setattr(f"{package}.renounce_descriptors", renounce)
    monkeypatch.setitem(sys.modules, f"{package}.kernel", None)
    assert confine() == ["resources"]


@pytest.mark.parametrize(("threads", "opens"), [(False, False), (True, False), (True, True)])
@pytest.mark.parametrize("machine", ["x86_64", "aarch64"])
def test_the_filter_lets_through_what_is_listed_and_no_other_call(machine: str, threads: bool, opens: bool) -> None:
    program = list(kernel.program(machine, threads=threads, opens=opens))
    column = list(kernel.ARCHITECTURES).index(machine)
    calls = kernel.CALLS | (kernel.THREAD_CALLS if threads else {}) | (kernel.OPENING_CALLS if opens else {})
    allowed = {numbers[column] for numbers in calls.values()}
    clone = (56, 220)[column] if threads else None
    mapping = {numbers[column] for numbers in kernel.MAPPING_CALLS.values()}
    architecture = kernel.ARCHITECTURES[machine]
    for number in range(500):
        for protection in (0, 3, 4, 7):
            right = number in allowed or (number in mapping and not protection & 4)
            if number != clone:
                assert _runs(program, number, architecture, protection) is right
        assert not _runs(program, number, 0x40000003, 0)
        assert not _runs(program, number | 0x40000000, architecture, 0)
    assert not clone or not _runs(program, clone, architecture, 0, 0x01200011)  # fork
    assert not clone or _runs(program, clone, architecture, 0, 0x003D0F00)  # a thread of glibc


def _runs(
    program: list[tuple[int, int, int, int]], number: int, architecture: int, protection: int, flags: int = 0
) -> bool:
    """Whether the machine of the kernel would let a system call through."""
    data = {0: number, 4: architecture, 16: flags, 32: protection}
    register = place = 0
    for _ in range(len(program)):
        code, if_true, if_false, value = program[place]
        place += 1
        match code:
            case 0x20:
                register = data[value]
            case 0x15:
                place += if_true if register == value else if_false
            case 0x45:
                place += if_true if register & value else if_false
            case _:
                return value == 0x7FFF0000
    raise AssertionError("the program does not end")


def _do_nothing(*_: object) -> None:
    """What would change this process."""


@pytest.fixture
def asked(monkeypatch: pytest.MonkeyPatch) -> dict[str, tuple[int, int]]:
    """What limits were set, on a system that has none of its own but five seconds."""

    class Resource:
        RLIM_INFINITY = -1
        RLIMIT_AS, RLIMIT_CPU, RLIMIT_FSIZE, RLIMIT_NOFILE, RLIMIT_NPROC = "AS", "CPU", "FSIZE", "NOFILE", "NPROC"

        def getrlimit(self, kind: str) -> tuple[int, int]:
            return (5, 6) if kind == "CPU" else (-1, -1)

        def setrlimit(self, kind: str, limits: tuple[int, int]) -> None:
            if kind == "NPROC":
                raise ValueError("not this one")
            found[kind] = limits

    found: dict[str, tuple[int, int]] = {}
    monkeypatch.setattr(resources, "limits", Resource)
    monkeypatch.setattr("twinform.compiler.input.xacro.process.limits", Resource)
    monkeypatch.setattr(sys, "setrecursionlimit", _do_nothing)
    monkeypatch.setattr("signal.signal", _do_nothing)
    return found


def test_the_process_has_limits(asked: dict[str, tuple[int, int]]) -> None:
    limit()
    assert asked == {"AS": (2**29, 2**29), "FSIZE": (0, 0), "CPU": (5, 6)}


def test_descriptors_are_renounced(asked: dict[str, tuple[int, int]]) -> None:
    assert resources.renounce_descriptors()
    assert asked == {"FSIZE": (0, 0), "NOFILE": (0, 0)}


def test_a_system_without_limits_is_reported(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "resource", None)
    monkeypatch.setattr(sys, "setrecursionlimit", _do_nothing)
    limit()
    assert not resources.renounce_descriptors()
