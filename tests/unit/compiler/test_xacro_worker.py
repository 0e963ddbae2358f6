"""The expander of xacro by itself: what it asks the compiler, and what it answers."""

import resource
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from twinform.compiler.xacro import guard, worker

_HEAD = '<robot xmlns:xacro="http://www.ros.org/wiki/xacro" name="r">'


class Channel:
    """The compiler as the worker sees it: one task, and answers for the URIs that it asks for."""

    def __init__(self, file: Path, arguments: dict[str, str], known: dict[str, Path]) -> None:
        self.task = {"file": str(file), "arguments": arguments, "folders": [str(file.parent)], "trusted": []}
        self.known = known
        self.asked: list[tuple[str, str]] = []

    def receive(self) -> dict[str, Any]:
        return self.task

    def find(self, uri: str, beside: str) -> str:
        self.asked.append((uri, Path(beside).name))
        if uri not in self.known:
            raise worker.NotFoundError(f"there is no {uri}", "install it")
        return str(self.known[uri])


Expand = Callable[..., dict[str, Any]]


def _unwatched(*_: object) -> None:
    """What nothing takes away again would watch the other tests too."""


@pytest.fixture
def expand(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Expand:
    """Expand a body in a fresh xacro, in this process."""
    for name in [name for name in sys.modules if name.split(".")[0] == "xacro"]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setattr(worker.GUARD, "watch", _unwatched)
    monkeypatch.setattr(sys, "stdout", sys.stdout)
    monkeypatch.setattr(sys, "stderr", sys.stderr)

    def run(body: str, known: dict[str, Path] | None = None, **arguments: str) -> dict[str, Any]:
        path = tmp_path / "r.xacro"
        path.write_text(f"{_HEAD}\n{body}\n</robot>")
        return worker.run(Channel(path, arguments, known or {}))

    return run


def _places(outcome: dict[str, Any]) -> list[tuple[str, int]]:
    return [(Path(file).name, line) for file, line in outcome["places"]]


def test_every_element_knows_where_it_was_written(expand: Expand, tmp_path: Path) -> None:
    part = tmp_path / "part.xacro"
    part.write_text(f'{_HEAD}\n\n<xacro:macro name="m" params="n"><link\nname="${{n}}"/></xacro:macro></robot>')
    body = '<xacro:include filename="$(find parts)/part.xacro"/>\n<xacro:m n="a"/>\n<link name="b"/>'
    outcome = expand(body, {"package://parts": tmp_path})
    assert _places(outcome) == [("r.xacro", 1), ("part.xacro", 3), ("r.xacro", 4)]
    assert '<link name="a"/>' in outcome["text"]
    assert (outcome["remarks"], outcome["unused"]) == ([], [])


def test_a_package_by_its_uri_is_asked_for_beside_the_file_that_names_it(expand: Expand, tmp_path: Path) -> None:
    (tmp_path / "part.xacro").write_text(f'{_HEAD}<link name="p"/></robot>')
    known = {"package://parts/part.xacro": tmp_path / "part.xacro"}
    assert '<link name="p"/>' in expand('<xacro:include filename="package://parts/part.xacro"/>', known)["text"]


def test_arguments_that_nobody_asked_for_are_named(expand: Expand) -> None:
    outcome = expand('<xacro:arg name="side" default="left"/>\n<link name="$(arg side)"/>', side="right", size="2")
    assert '<link name="right"/>' in outcome["text"]
    assert outcome["unused"] == ["size"]


def test_what_is_printed_is_a_remark_with_its_place(expand: Expand) -> None:
    (text, file, line), *rest = expand('<link name="a"/>\n<link name="${xacro.warning(\'mind the gap\')}"/>')["remarks"]
    assert ("mind the gap" in text, Path(file).name, line, rest) == (True, "r.xacro", 3, [])


FAILURES = {
    "an unknown macro": ("\n<xacro:wheel/>", "unknown macro name: xacro:wheel", 3),
    "an unknown name": ('<link name="${radius}"/>', "name 'radius' is not defined", 2),
    "a macro in a macro": (
        '<xacro:macro name="m" params=""><link name="${x}"/></xacro:macro>\n<xacro:m/>',
        "name 'x' is not defined",
        2,
    ),
    "a macro that calls itself": (
        '<xacro:macro name="m" params=""><xacro:m/></xacro:macro>\n<xacro:m/>',
        "macros or expressions go round without an end",
        2,
    ),
    "a hidden name": ('<link name="${().__class__}"/>', "an expression must not use '__class__'", 2),
    "a hidden name in eval": ('<link name="$(eval [].mro)"/>', "an expression must not use 'mro'", 2),
    "a file that is not there": ('<xacro:include filename="none.xacro"/>', "No such file or directory", 2),
    "a folder": ('<xacro:include filename="."/>', "this is no file", 1),
    "a package that is not there": (
        '<xacro:include filename="$(find none)/a.xacro"/>',
        "there is no package://none",
        2,
    ),
    "a document type": ('<xacro:include filename="typed.xacro"/>', "the document has a DOCTYPE; none is allowed", 1),
    "a broken file": ('<xacro:include filename="broken.xacro"/>', "not well-formed XML: ", 3),
}


@pytest.mark.parametrize("name", FAILURES)
def test_a_failure_has_words_and_a_place(name: str, expand: Expand, tmp_path: Path) -> None:
    (tmp_path / "typed.xacro").write_text("<!DOCTYPE robot><robot/>")
    (tmp_path / "broken.xacro").write_text("<robot>\n<link>\n</robot>")
    body, words, line = FAILURES[name]
    outcome = expand(body)
    assert words in outcome["error"]
    assert outcome["place"][1] == line
    assert outcome.get("help") == ("install it" if "package" in name else None)


@pytest.mark.parametrize(("limit", "words"), [("_LARGEST", "larger than 9 bytes"), ("_MOST_TAGS", "more than 9 tags")])
def test_a_file_that_is_too_large_is_not_read(
    limit: str, words: str, expand: Expand, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(worker, limit, 9)
    assert words in expand("<link/>" * 20)["error"]


def test_xacro_that_is_not_installed_is_missing(expand: Expand, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "xacro", None)
    assert "xacro" in expand("")["missing"]


def test_the_process_has_limits(monkeypatch: pytest.MonkeyPatch) -> None:
    asked: dict[int, int] = {}

    def hard(kind: int) -> tuple[int, int]:
        return 0, 5 if kind == resource.RLIMIT_CPU else resource.RLIM_INFINITY

    def ask(kind: int, limits: tuple[int, int]) -> None:
        asked[kind] = limits[0]

    def recurse(deepest: int) -> None:
        assert deepest > 1000

    monkeypatch.setattr(resource, "getrlimit", hard)
    monkeypatch.setattr(resource, "setrlimit", ask)
    monkeypatch.setattr(sys, "setrecursionlimit", recurse)
    worker.limit()
    assert asked == {resource.RLIMIT_AS: 2**29, resource.RLIMIT_CPU: 5, resource.RLIMIT_FSIZE: 0}


@pytest.mark.parametrize("expression", ["a.b + 1", "[x for x in range(3)]", " cos(0) ", "'__'"])
def test_expressions_of_robots_are_let_through(expression: str) -> None:
    assert guard.checked(expression) == expression


@pytest.mark.parametrize(
    "expression", ["a.__b", "__import__('os')", "a.mro", "(x for x in a).gi_frame", "f.func_globals"]
)
def test_what_is_hidden_is_not(expression: str) -> None:
    with pytest.raises(guard.ForbiddenError, match="an expression must not use"):
        guard.checked(expression)


def test_eval_has_the_builtins_that_it_is_given() -> None:
    evaluate = guard.guarded_eval({"len": len})
    assert evaluate("len(x) + 1", {}, {"x": "ab"}) == 3
    with pytest.raises(NameError):
        evaluate("open('x')", {}, {})


@pytest.fixture
def hook(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[..., None]:
    """What the guard would have Python call, for a file in `own`, with the folder `trusted` besides."""
    for name in ("own", "trusted", "secret"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "file").touch()
    (tmp_path / "trusted" / "link").symlink_to(tmp_path / "secret" / "file")
    (tmp_path / "own" / "link").symlink_to(tmp_path / "secret" / "file")
    found: list[Callable[..., None]] = []
    monkeypatch.setattr(sys, "addaudithook", found.append)
    monkeypatch.setattr(sys, "dont_write_bytecode", sys.dont_write_bytecode)
    monkeypatch.setattr(sys, "path", [])
    own, trusted = str(tmp_path / "own"), str(tmp_path / "trusted")
    guard.watch([f"{own}/file"], [own], [trusted])
    return found[0]


@pytest.mark.parametrize("path", ["own/file", "trusted/file", "trusted/link", "own/none"])
def test_files_of_its_folders_may_be_read(path: str, hook: Callable[..., None], tmp_path: Path) -> None:
    hook("open", (str(tmp_path / path), "r", 0))
    hook("open", (3, "r", 0))
    hook("compile", ("1", "x"))


OPENED = {
    "another folder": ("secret/file", "r", 0, "outside"),
    "a link that leads out": ("own/link", "r", 0, "outside"),
    "a folder": ("own", "r", 0, "it is no file"),
    "writing": ("own/file", "w", 0, "nothing may be written"),
    "writing by flags": ("own/file", None, 1, "nothing may be written"),
}


@pytest.mark.parametrize("name", OPENED)
def test_no_other_file_is_opened(name: str, hook: Callable[..., None], tmp_path: Path) -> None:
    path, mode, flags, words = OPENED[name]
    with pytest.raises(PermissionError, match=words):
        hook("open", (str(tmp_path / path), mode, flags))


@pytest.mark.parametrize("event", ["os.system", "subprocess.Popen", "socket.connect", "shutil.rmtree"])
def test_nothing_is_started(event: str, hook: Callable[..., None]) -> None:
    with pytest.raises(guard.ForbiddenError, match=event):
        hook(event, ())
