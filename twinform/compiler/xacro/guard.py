"""What a xacro file may do in the process that expands it: read files of some folders, and calculate.

xacro evaluates Python expressions with few names, but what can be reached through the attributes of any value is all of
Python, and `$(eval ...)` has every builtin. So expressions are looked at before they are evaluated, and a hook that
nothing can take away again sees every file, process and connection that is asked for. It is loaded by the worker, which
knows nothing of the compiler.
"""

import ast
import errno
import os
import sys
from collections.abc import Callable, Mapping, Sequence
from typing import Any

_HIDDEN = frozenset({"mro"})
_HIDDEN_STARTS = ("_", "f_", "tb_", "gi_", "cr_", "ag_", "co_", "func_")
"""Attributes that lead from a value to the frames, code and classes behind it."""
_FORBIDDEN = (
    "ctypes.", "ftplib.", "gc.", "http.", "mmap.", "msvcrt.", "os.chdir", "os.chflags", "os.chmod", "os.chown",
    "os.exec", "os.fork", "os.kill", "os.link", "os.listxattr", "os.lockf", "os.mkdir", "os.posix_spawn", "os.putenv",
    "os.remove", "os.rename", "os.rmdir", "os.setxattr", "os.spawn", "os.startfile", "os.symlink", "os.system",
    "os.truncate", "os.unsetenv", "os.utime", "pty.", "shutil.", "smtplib.", "socket.", "sqlite3.", "subprocess.",
    "syslog.", "tempfile.", "urllib.", "webbrowser.", "winreg.",
)  # fmt: skip
"""Beginnings of the names of audit events, as the page of Python's documentation lists them."""
_WRITING = os.O_WRONLY | os.O_RDWR | os.O_CREAT | os.O_TRUNC | os.O_APPEND
_OUTSIDE = "it is outside of the folders of models and packages; name its folder with --path DIR if it is meant"


class ForbiddenError(Exception):
    """An expression wants what no robot needs."""


def checked(expression: str) -> str:
    """The expression, if it touches nothing hidden.

    Raises:
        ForbiddenError: it does.
    """
    for node in ast.walk(ast.parse(expression.strip(), "<expression>", "eval")):
        name = node.attr if isinstance(node, ast.Attribute) else node.id if isinstance(node, ast.Name) else ""
        hidden = isinstance(node, ast.Attribute) and (name in _HIDDEN or name.startswith(_HIDDEN_STARTS))
        if hidden or name.startswith("__"):
            raise ForbiddenError(f"an expression must not use {name!r}")
    return expression


def guarded_eval(builtins: Mapping[str, Any]) -> Callable[..., Any]:
    """An `eval` for `$(eval ...)` that has these builtins and no others."""

    def evaluate(expression: str, _: dict[str, Any], names: Mapping[str, Any]) -> Any:
        return eval(checked(expression), {"__builtins__": dict(builtins)}, names)  # noqa: S307 - it was looked at

    return evaluate


def watch(files: Sequence[str], folders: Sequence[str], trusted: Sequence[str]) -> None:
    """From here on, let nothing be written, started or fetched, and little be read.

    That is: these files, what is really in these folders, and what is named in trusted ones, wherever links lead from
    there.
    """
    own = [*sys.path, sys.prefix, sys.base_prefix]
    real = [os.path.realpath(each) for each in (*folders, *own) if each]
    named = [os.path.abspath(each) for each in trusted]
    single = {os.path.realpath(os.devnull), *map(os.path.realpath, files)}

    def may_read(path: str) -> bool:
        where = os.path.realpath(path)
        return where in single or _inside(where, real) or _inside(os.path.abspath(path), named)

    def hook(event: str, arguments: tuple[Any, ...]) -> None:
        if event == "open":
            path, mode, flags = arguments
            if isinstance(path, int):
                return
            if set(mode or "") & set("wxa+") or (flags or 0) & _WRITING:
                raise PermissionError(errno.EACCES, "nothing may be written", os.fsdecode(path))
            if not may_read(os.fsdecode(path)):
                raise PermissionError(errno.EACCES, _OUTSIDE, os.fsdecode(path))
            if os.path.exists(path) and not os.path.isfile(path) and os.path.realpath(path) not in single:
                raise PermissionError(errno.EACCES, "it is no file", os.fsdecode(path))
        elif event.startswith(_FORBIDDEN):
            raise ForbiddenError(f"an expression must not use {event}")

    sys.dont_write_bytecode = True
    sys.addaudithook(hook)


def _inside(path: str, folders: Sequence[str]) -> bool:
    return any(path == each or path.startswith(each.rstrip(os.sep) + os.sep) for each in folders)
