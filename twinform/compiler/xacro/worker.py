"""The process that expands one xacro file; it is run as a script and knows nothing of the compiler.

xacro keeps its state in its modules, patches the XML library of Python, and evaluates expressions that may never end.
Here all that happens where it can do no harm, and some of its functions are replaced by ones that know lines.

Messages are lines of JSON. In: the task, then an answer for each question. Out: questions (`{"find": uri}`), and at the
end what became of the task.
"""

import io
import json
import os
import sys
from collections.abc import Callable, Iterator
from importlib import import_module
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from types import ModuleType
from typing import Any, Protocol
from xml.dom import expatbuilder, minidom
from xml.parsers.expat import ExpatError

_LARGEST = 64 * 2**20
_MOST_TAGS = 1_000_000
_MEMORY = 2**29
_SECONDS = 10
"""Of processor time. The slowest real file that we know takes from one to nine, as machines are."""
_DEEPEST = 4000
"""Frames of Python. xacro takes about ten for each macro inside a macro."""
_KEY = "source"
_WATCHED = ("eval_all", "check_attrs", "grab_property", "grab_macro", "process_include", "handle_macro_call")
"""Functions of xacro whose first argument is the element that it is at."""

Place = tuple[str, int]


def _load_guard() -> Any:
    """The file beside this one, by its path: the folder of a script is no place to import from."""
    spec = spec_from_file_location("twinform_guard", Path(__file__).with_name("guard.py"))
    if spec is None or spec.loader is None:
        raise ImportError("guard.py is missing")
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


GUARD = _load_guard()


class _Keeper:
    """Lets clones of an element know where the element was written."""

    def handle(self, operation: int, key: str, data: Any, src: Any, dst: Any) -> None:
        del operation, src
        if dst is not None:
            dst.setUserData(key, data, self)


class _Builder(expatbuilder.ExpatBuilderNS):
    """Builds a tree whose elements know their file and line."""

    def __init__(self, file: str) -> None:
        super().__init__()
        self.file = file

    def start_element_handler(self, name: str, attributes: Any) -> None:
        super().start_element_handler(name, attributes)
        element: Any = self.curNode
        element.setUserData(_KEY, (self.file, self.getParser().CurrentLineNumber), _KEEPER)

    def start_doctype_decl_handler(self, *args: Any, **more: Any) -> None:
        raise _BadFileError(
            "the document has a DOCTYPE; none is allowed", (self.file, self.getParser().CurrentLineNumber)
        )


_KEEPER = _Keeper()


class _Arguments(dict[str, str]):
    """Knows which of them were asked for."""

    def __init__(self, given: dict[str, str]) -> None:
        super().__init__(given)
        self.unused = set(given)

    def __contains__(self, name: object) -> bool:
        self.unused.discard(str(name))
        return super().__contains__(name)

    def __getitem__(self, name: str) -> str:
        self.unused.discard(name)
        return super().__getitem__(name)


class Compiler(Protocol):
    """Who gives tasks, and knows where packages are."""

    def receive(self) -> dict[str, Any]:
        """The task."""
        ...

    def find(self, uri: str, beside: str) -> str:
        """Where a URI leads that stands in a file.

        Raises:
            NotFoundError: nowhere.
        """
        ...


class _Channel:
    """The pipes to the compiler. What is printed here goes into the remarks instead."""

    def __init__(self) -> None:
        self.incoming = os.fdopen(os.dup(0), encoding="utf-8")
        self.outgoing = os.fdopen(os.dup(1), "w", encoding="utf-8")
        nothing = os.open(os.devnull, os.O_RDWR)
        for descriptor in (0, 1):
            os.dup2(nothing, descriptor)

    def send(self, message: dict[str, Any]) -> None:
        self.outgoing.write(json.dumps(message) + "\n")
        self.outgoing.flush()

    def receive(self) -> dict[str, Any]:
        return json.loads(self.incoming.readline())

    def find(self, uri: str, beside: str) -> str:
        """Ask where a URI leads that stands in a file."""
        self.send({"find": uri, "beside": beside})
        answer = self.receive()
        if "error" in answer:
            raise NotFoundError(answer["error"], answer["help"])
        return answer["path"]


class _Remarks(io.StringIO):
    """What xacro and the file print, line by line with the place where they did."""

    def __init__(self, where: Callable[[], Place]) -> None:
        super().__init__()
        self.where = where
        self.found: dict[tuple[str, Place], None] = {}

    def write(self, text: str) -> int:
        self.found.update(((line.strip(), self.where()), None) for line in text.splitlines() if line.strip())
        return len(text)


class _Expander:
    """xacro, with its functions replaced that read files, find packages, and look at elements."""

    def __init__(self, channel: Compiler, file: str) -> None:
        self.xacro: Any = import_module("xacro")
        self.channel = channel
        self.file = file
        self.node: Any = None
        self._watch()
        substitution: ModuleType = import_module("xacro.substitution_args")
        builtins = vars(substitution)["_eval_dict"]["__builtins__"]
        vars(substitution)["eval"] = GUARD.guarded_eval(builtins)
        self.evaluate: Callable[..., Any] = self.xacro.safe_eval
        self.xacro.safe_eval = self._evaluate
        vars(substitution)["_eval_find"] = self._package
        vars(substitution)["_eval_dict"]["find"] = self._package
        self.beside: Callable[[str], str] = self.xacro.abs_filename_spec
        self.xacro.abs_filename_spec = self._path
        self.xacro.parse = self._parse
        self.xacro.print_location = _say_nothing

    def expand(self, arguments: dict[str, str]) -> minidom.Document:
        return self.xacro.process_file(self.file, mappings=arguments, verbosity=0)

    def place(self) -> Place:
        """Where the element was written that was looked at last."""
        node = self.node
        while node is not None:
            source = node.getUserData(_KEY)
            if source:
                return source
            node = node.parentNode
        return (self.file, 1)

    def _watch(self) -> None:
        for name in _WATCHED:
            if hasattr(self.xacro, name):
                setattr(self.xacro, name, self._watched(getattr(self.xacro, name)))

    def _watched(self, function: Callable[..., Any]) -> Callable[..., Any]:
        def call(node: Any, *rest: Any) -> Any:
            self.node = node
            return function(node, *rest)

        return call

    def _evaluate(self, expression: str, *names: Any) -> Any:
        return self.evaluate(GUARD.checked(expression), *names)

    def _package(self, name: str) -> str:
        return self._find(f"package://{name}")

    def _path(self, name: str) -> str:
        """What a file name means in the file that is being read."""
        return self._find(name) if name.startswith("package://") else self.beside(name)

    def _find(self, uri: str) -> str:
        return self.channel.find(uri, (self.xacro.filestack or [None])[-1] or self.file)

    def _parse(self, text: Any, filename: str) -> minidom.Document:
        """What xacro's own function does, with lines."""
        path = Path(self.xacro.root_dir) / filename
        try:
            if path.exists() and not path.is_file():
                raise _BadFileError("this is no file", (filename, 1))
            if path.stat().st_size > _LARGEST:
                raise _BadFileError(f"the file is larger than {_LARGEST:,} bytes", (filename, 1))
            data = path.read_bytes()
            if data.count(b"<") > _MOST_TAGS:
                raise _BadFileError(f"the file has more than {_MOST_TAGS:,} tags", (filename, 1))
        except OSError as error:
            self.xacro.filestack.pop()
            raise self.xacro.XacroException(f"{error.strerror}: {filename}", exc=error) from error
        try:
            return _Builder(filename).parseString(data)
        except ExpatError as error:
            raise _BadFileError(f"not well-formed XML: {error}", (filename, error.lineno)) from error


class NotFoundError(Exception):
    """A URI or package that leads nowhere."""

    def __init__(self, message: str, advice: str) -> None:
        super().__init__(message)
        self.advice = advice


class _BadFileError(Exception):
    """A file that cannot be expanded whatever is in its macros."""

    def __init__(self, message: str, place: Place) -> None:
        super().__init__(message)
        self.place = place


def _say_nothing() -> None:
    """Every remark has its place already."""


def run(channel: Compiler) -> dict[str, Any]:
    """Do the task that the compiler gives, and say what became of it."""
    task = channel.receive()
    try:
        expander = _Expander(channel, task["file"])
    except ImportError as error:
        return {"missing": str(error)}
    remarks = _Remarks(expander.place)
    sys.stdout = sys.stderr = remarks
    arguments = _Arguments(task["arguments"])
    GUARD.watch([task["file"]], task["folders"], task["trusted"])
    outcome = _expanded(expander, arguments)
    noted = [[text, *place] for text, place in remarks.found]
    return {**outcome, "remarks": noted, "unused": sorted(arguments.unused)}


def _expanded(expander: _Expander, arguments: dict[str, str]) -> dict[str, Any]:
    try:
        document = expander.expand(arguments)
        root = document.documentElement
        places = [] if root is None else [element.getUserData(_KEY) for element in _elements(root)]
        return {"text": document.toprettyxml(indent="  "), "places": places}
    except _BadFileError as error:
        return {"error": str(error), "place": error.place}
    except Exception as error:  # noqa: BLE001 - an expression may raise anything, and it is the file's fault
        return {**_words(error), "place": expander.place()}


def _words(error: Exception) -> dict[str, str]:
    """What an exception says, and the macros through which it came."""
    cause = _cause(error)
    if isinstance(cause, RecursionError):
        return {"error": "macros or expressions go round without an end"}
    if isinstance(cause, MemoryError):
        return {"error": "an expression needs more memory than there is for it"}
    if isinstance(cause, NotFoundError):
        return {"error": str(cause), "help": cause.advice}
    if isinstance(cause, GUARD.ForbiddenError):
        return {"error": str(cause)}
    if isinstance(cause, OSError) and cause.filename:
        return {"error": f"cannot read {cause.filename!r}: {cause.strerror}"}
    text = " ".join(str(error).split()) or type(error).__name__
    macros = [macro.body.getAttribute("name") for macro in getattr(error, "macros", []) if macro.body is not None]
    return {"error": f"{text} (in macro {', '.join(macros)})" if macros else text}


def _cause(error: BaseException) -> BaseException:
    """The exception inside those that xacro wraps it in."""
    while isinstance(inner := getattr(error, "exc", None), BaseException):
        error = inner
    return error


def _elements(root: Any) -> Iterator[Any]:
    """All elements in the order of the document; no recursion, since the document may be deep."""
    stack = [root]
    while stack:
        element = stack.pop()
        yield element
        stack.extend(node for node in reversed(element.childNodes) if node.nodeType == node.ELEMENT_NODE)


def limit() -> None:
    """Keep an expression such as `'x' * 10**12` from taking the machine with it."""
    sys.setrecursionlimit(_DEEPEST)
    try:
        resource: Any = import_module("resource")
        for kind, most in ((resource.RLIMIT_AS, _MEMORY), (resource.RLIMIT_CPU, _SECONDS), (resource.RLIMIT_FSIZE, 0)):
            hard = resource.getrlimit(kind)[1]
            resource.setrlimit(kind, (most if hard == resource.RLIM_INFINITY else min(most, hard), hard))
    except (ImportError, OSError, ValueError):
        return  # there are systems without


def main() -> None:
    """Do one task."""
    limit()
    channel = _Channel()
    channel.send(run(channel))


if __name__ == "__main__":
    main()
