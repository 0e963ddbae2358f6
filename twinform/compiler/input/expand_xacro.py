"""Expands a xacro file to text, with the origin of each line: the compiler's side of the process that expands.

The process gets a task, asks questions, and sends a result.
"""

import json
import os
import site
import subprocess
from collections.abc import Iterable, Mapping
from contextlib import suppress
from importlib.machinery import PathFinder
from pathlib import Path
from threading import Timer
from time import thread_time
from typing import Any, cast

from lxml import etree

from twinform.child_python import python_command
from twinform.compiler.input.expansion import Expansion, MacroCall, PartOrigin
from twinform.compiler.input.load_options import LoadOptions
from twinform.compiler.input.parsing import UnreadableError, parse, read_bytes
from twinform.compiler.input.size_limits import LARGEST
from twinform.compiler.input.xacro_files import AllowedFiles, DeniedError, variable
from twinform.compiler.input.xacro_mistakes import report_mistakes, report_unprefixed
from twinform.compiler.input.xacro_needs import (
    absent_packages,
    report_empty_arguments,
    report_missing_arguments,
    report_missing_packages,
    shown_message,
    shown_name,
    suggest_file,
)
from twinform.compiler.observing import note_failure, note_variable
from twinform.compiler.resolve_uris import SearchPath, UriError
from twinform.diagnostics import DiagnosticSink, LineOrigins, Location, nearest_name, rules
from twinform.lazy import lazy_pattern
from twinform.schemas import usual_namespace

_WORKER = Path(__file__).with_name("xacro") / "__main__.py"
_LIBRARIES = ("xacro", "yaml")
# Of the wall clock, on a busy machine. The worker itself has 10 s of processor time.
_SECONDS = 60
# Of processor time, for all questions of one file: what is done here for the worker is not in its
# own ten.
# Without this, 30,000 calls of `$(optenv)` ran until the clock limit of 60 seconds.
_SECONDS_TO_ANSWER = 3
# Questions that repeat do not count: the worker keeps the answers.
_MOST_QUESTIONS = 5000
# The longest name of a file, package or variable that is looked up, in characters: as long as a
# path may be.
_LONGEST_NAME = 4096
_LONGEST_MESSAGE = 4 * LARGEST
_QUESTIONS = frozenset({"environment", "find", "match", "read"})
_PASSED_ON = ("APPDATA", "HOME", "LANG", "PATH", "SYSTEMROOT", "TEMP", "TMPDIR", "USERPROFILE")
# Python needs these to find its modules. Nothing else of the environment is in the process.
_PASSED_ON_STARTS = ("COV", "DYLD_", "LC_", "LD_", "PYTHON")
_EXPAT = lazy_pattern(r"not well-formed XML: .*: line \d+, column (\d+)$")
"""Where expat noticed what is wrong; it counts columns from 0."""
_PREFIX = lazy_pattern(r"the prefix '([\w.-]+)' of ")
_TEXT_IN_BRACES = lazy_pattern(r"is the text '(\{\w+\})'")
_REMARKS = {"warning: ": rules.XACRO_WARNING, "error: ": rules.XACRO_WARNING}


class ExpansionError(UnreadableError):
    """A xacro file cannot be expanded; `texts` are the files that were read until then, by their names."""

    def __init__(self, texts: Mapping[str, bytes]) -> None:
        super().__init__()
        self.texts = texts


def expand(path: Path, load_options: LoadOptions, sink: DiagnosticSink) -> Expansion:
    """The text of a xacro file.

    Raises:
        ExpansionError: it cannot be expanded; the diagnostics tell why.
        UnreadableError: it cannot be read, or becomes too large.
    """
    search = load_options.search
    if search.unsaved_of(path) is None:
        read_bytes(path, sink, load_options.limits, search.readable(path))  # says what is wrong, if it cannot be read
    outcome = _ask_worker(path, load_options)
    _report_remarks(outcome, sink)
    texts = {shown_name(file, sink.file): each for file, each in outcome.get("texts", {}).items()}
    if "text" not in outcome:
        if not (outcome.get("syntax") and _report_syntax(outcome["place"][0], path, load_options, sink)):
            _report_failure(outcome, path, load_options, sink)
            report_unprefixed(texts, sink)
        raise ExpansionError(texts)
    report_missing_packages(outcome["absent"], sink)
    for name in outcome["unused"]:
        message = f"the argument {name!r} is not one of the file's"
        sink.report(rules.UNUSED_ARGUMENT, message, Location(line=1), found=name)
    report_mistakes(sink.file, texts, sink)
    text = outcome["text"].encode()
    if len(text) > LARGEST:
        message = f"the expanded file has {len(text):,} bytes; the limit is {LARGEST:,}"
        sink.report(rules.UNREADABLE_FILE, message)
        raise UnreadableError
    # Nodes of the IR keep the lines of the expanded text, which are the ones that the `xacro`
    # command prints and by which the writer orders children. Findings name the file that the author
    # can edit first.
    strays = {text: Location(shown_name(file, sink.file), line) for text, file, line in outcome["strays"]}
    names = {place[0]: shown_name(place[0], sink.file) for place in (*outcome["places"], *outcome["calls"]) if place}
    parts = [PartOrigin(names[place[0]], *place[1:]) if place else None for place in outcome["places"]]
    calls = [MacroCall(names[file], number, around) for file, number, around in outcome["calls"]]
    return Expansion(text, _origins(text, parts), strays, texts, parts, calls)


def _report_failure(outcome: Mapping[str, Any], path: Path, load_options: LoadOptions, sink: DiagnosticSink) -> None:
    if "missing" in outcome:
        from twinform.installation import install_command  # noqa: PLC0415 - most have what they need

        advice = f"run: {install_command()}"
        message = f"this is a xacro file, and xacro is not installed ({outcome['missing']})"
        sink.report(rules.XACRO_MISSING, message, Location(line=1), help=advice)
        return
    file, line = outcome["place"]
    absent = list(outcome.get("absent", ()))
    if outcome.get("rule") == rules.MISSING_ARGUMENT.name:
        where = Location(shown_name(file, sink.file), line)
        report_missing_arguments(path, outcome["argument"], where, load_options, sink)
    if outcome.get("rule") == rules.MISSING_PACKAGE.name or absent:
        report_missing_packages([*absent, *absent_packages(path, load_options)], sink)
    if outcome.get("rule") in {rules.MISSING_ARGUMENT.name, rules.MISSING_PACKAGE.name}:
        return
    found = _EXPAT.search(outcome["error"])
    column = int(found[1]) + 1 if found else 0
    unknown = outcome.get("unknown")
    meant = nearest_name(unknown["name"], unknown["known"]) if unknown else None
    advice = _advice(outcome, meant) or outcome.get("help") or suggest_file(outcome["error"], path, load_options)
    where = Location(shown_name(file, sink.file), line, "", column)
    message = shown_message(outcome["error"], sink.file)
    if not report_empty_arguments(message, path, where, load_options, sink):
        name = unknown and unknown["name"]
        sink.report(rules.XACRO_ERROR, message, where, found=name, expected=meant, help=advice or None)


def _report_syntax(file: str, path: Path, load_options: LoadOptions, sink: DiagnosticSink) -> bool:
    """Report why a file is not well-formed as for files without xacro; return whether there is anything to report."""
    found = DiagnosticSink(file)
    with suppress(UnreadableError, DeniedError, OSError):
        # The process says which file it is, so it has to be one that `path` may read.
        parse(_Conversation(path, load_options).read(file), found, load_options.limits)
    if not found.diagnostics:
        return False
    # What is repaired in other files is refused by xacro, which stops at the first mistake.
    first = found.diagnostics[0]
    prefix = _PREFIX.search(first.message)
    advice = f'add xmlns:{prefix[1]}="{usual_namespace(prefix[1])}" to the root element' if prefix else first.help
    words = first.message.replace(", repaired:", ":", 1)
    where = first.location._replace(file=shown_name(file, sink.file))
    sink.report(rules.NOT_WELL_FORMED, words, where, help=advice)
    return True


def _advice(outcome: Mapping[str, Any], near: str | None) -> str:
    """Say which name may have been meant by an unknown one, and where that is defined."""
    text = _TEXT_IN_BRACES.search(outcome["error"])
    if text:
        return f"did you mean ${text[1]}?"
    unknown = outcome.get("unknown")
    if unknown is None:
        return ""
    if near:
        place = unknown["known"][near]
        where = f" ({Path(place[0]).name}:{place[1]})" if place else ""
        return f"did you mean {near!r}{where}?"
    if unknown["kind"] == "parameter":
        return f"it has {', '.join(unknown['known'])}" if unknown["known"] else "it has none"
    return "if it is in a file, include that before this line" if unknown["kind"] == "macro" else ""


def _report_remarks(outcome: Mapping[str, Any], sink: DiagnosticSink) -> None:
    for text, file, line in outcome.get("remarks", ()):
        start = next((start for start in _REMARKS if text.startswith(start)), "")
        rule = _REMARKS.get(start, rules.XACRO_MESSAGE)
        sink.report(rule, text.removeprefix(start), Location(shown_name(file, sink.file), line))


def _origins(text: bytes, parts: Iterable[PartOrigin | None]) -> LineOrigins:
    """Elements are in the same order in the expanded text and in the list of their origins."""
    parser = etree.XMLParser(remove_comments=True, remove_pis=True, resolve_entities=False, no_network=True)
    try:
        root = etree.fromstring(text, parser)
    except etree.XMLSyntaxError:
        return LineOrigins()  # reading the text will say what is wrong with it
    pairs = zip(root.iter(), parts, strict=False)
    return LineOrigins.of((element.sourceline or 0, Location(*part[:2])) for element, part in pairs if part)


def _ask_worker(path: Path, load_options: LoadOptions) -> dict[str, Any]:
    """What becomes of a file in a process of its own.

    Such a process imports no more than most files need. One that needs more than it has says so, does nothing, and
    another takes its place: which files are read, and whether they read data, is only known when nothing can be
    imported any more.
    """
    # The YAML library takes longer to import than all else, and few files need it.
    task = {"file": str(path), "arguments": dict(load_options.arguments)}
    folders = _library_folders()
    outcome = _ask(path, load_options, {**task, "yaml": _mentions_data(path, load_options.search)}, folders)
    if "missing" in outcome and folders:
        folders = ()
        outcome = _ask(path, load_options, {**task, "yaml": True}, folders)
    return _ask(path, load_options, {**task, "yaml": True}, folders) if "lacks" in outcome else outcome


def _mentions_data(path: Path, search: SearchPath) -> bool:
    """Whether a file says that it reads data; it may also say so in a file that it includes."""
    unsaved = search.unsaved_of(path)
    if unsaved is not None:
        return b"yaml" in unsaved
    try:
        return b"yaml" in search.readable(path).read(path, LARGEST)
    except OSError:
        return True  # reading it will say what is wrong


def _library_folders() -> tuple[str, ...]:
    """The folders of installed packages, if xacro is in them; none where Python has to look for it by itself.

    Nowhere else is looked, least of all in the current folder, which may have come with the file. The measurement of
    coverage has to begin when Python does.
    """
    folders = [*site.getsitepackages(), *([site.getusersitepackages()] if site.ENABLE_USER_SITE else [])]
    found = all(PathFinder.find_spec(name, folders) for name in _LIBRARIES)
    measured = any(name.startswith("COV") for name in os.environ)
    return tuple(folders) if found and not measured else ()


def _ask(path: Path, load_options: LoadOptions, task: Mapping[str, object], folders: tuple[str, ...]) -> dict[str, Any]:
    """What becomes of a task in a process of its own."""
    # -W: what Python warns of is not the file's to know.
    # -S: nothing is run that packages have left for the start of Python
    bare = ["-S", "-s"] if folders else []
    command = python_command(*bare, "-W", "ignore", str(_WORKER), *folders)
    pipe = subprocess.PIPE
    # xacro keeps state in module globals and replaces a method of Python's XML library on import,
    # so each file gets a process of its own, in a batch too. That costs about 45 ms, of which
    # confinement is a tenth.
    with subprocess.Popen(  # noqa: S603 - our own script, and no shell
        command, stdin=pipe, stdout=pipe, stderr=subprocess.DEVNULL, env=environment()
    ) as process:
        timer = Timer(_SECONDS, process.kill)
        timer.start()
        try:
            return _Conversation(path, load_options).hold(process, task)
        finally:
            timer.cancel()
            process.kill()
            if process.stdin is not None:
                with suppress(BrokenPipeError):  # it has died with something left to read
                    process.stdin.close()


def environment() -> dict[str, str]:
    """The environment of the process."""
    passed_on = {
        name: value for name, value in os.environ.items() if name in _PASSED_ON or name.startswith(_PASSED_ON_STARTS)
    }
    # what is written from a set has the same order each time
    return {**passed_on, "PYTHONHASHSEED": "0", "PYTHONIOENCODING": "utf-8"}


class _TooMuchError(DeniedError):
    """Too much is asked for by one file."""


class _Conversation:
    """Answers the questions of the process."""

    def __init__(self, path: Path, load_options: LoadOptions) -> None:
        self.path = path
        self.search = load_options.search
        self.variables = load_options.variables
        self.files = AllowedFiles(self.search.readable(path))
        self.texts: dict[str, bytes] = {}
        self.asked = 0
        self.spent = 0.0

    def hold(self, process: subprocess.Popen[bytes], task: Mapping[str, object]) -> dict[str, Any]:
        """Give the task and answer, until the process sends the result."""
        to_worker, from_worker = process.stdin, process.stdout
        message, content = task, b""
        try:
            while to_worker and from_worker:
                to_worker.write(json.dumps(message).encode() + b"\n" + content)
                to_worker.flush()
                received = _understood(from_worker.readline(_LONGEST_MESSAGE))
                if not received:
                    break
                if not _QUESTIONS.intersection(received):
                    return {**received, "texts": self.texts}
                begin = thread_time()
                message, content = self._answer(received)
                self.spent += thread_time() - begin
        except BrokenPipeError:
            pass  # it died before it could listen
        note_failure()
        return {"error": "the expansion died, or did not end within its time", "place": (str(self.path), 1)}

    def _answer(self, received: Mapping[str, str]) -> tuple[Mapping[str, object], bytes]:
        try:
            self._require_little(received)
            match received:
                case {"find": uri, "beside": beside}:
                    return self._find(uri, (Path(beside), self.path)), b""
                case {"read": path}:
                    return self._read(path)
                case {"match": pattern}:
                    return {"paths": self.files.match(pattern)}, b""
                case _:
                    return {"value": self._variable(received["environment"])}, b""
        except DeniedError as error:
            return {"error": str(error), "help": error.advice, "ends": isinstance(error, _TooMuchError)}, b""
        except (OSError, ValueError) as error:
            return {"missing": getattr(error, "strerror", None) or str(error)}, b""

    def _require_little(self, received: Mapping[str, str]) -> None:
        """Count a question, and refuse it where too much is asked.

        Raises:
            _TooMuchError: a name is too long, or there were too many questions, or they took too long.
        """
        self.asked += 1
        if any(len(name) > _LONGEST_NAME for name in received.values()):
            raise _TooMuchError(f"the name of a file, package or variable has more than {_LONGEST_NAME:,} characters")
        if self.asked > _MOST_QUESTIONS:
            raise _TooMuchError(f"the file asks for more than {_MOST_QUESTIONS:,} files, packages and variables")
        if self.spent > _SECONDS_TO_ANSWER:
            message = f"the files and packages it asks for take more than {_SECONDS_TO_ANSWER} seconds to find"
            raise _TooMuchError(message)

    def _read(self, path: str) -> tuple[Mapping[str, object], bytes]:
        try:
            content = self.read(path)
        except FileNotFoundError:
            source = self.search.source_of(Path(path))
            if source is None:
                raise
            path, content = str(source), self.read(str(source))
        self.texts[path] = content
        return {"size": len(content), "path": path}, content

    def read(self, path: str) -> bytes:
        """What is in a file that may be read, or what an editor has of it.

        Raises:
            DeniedError: it must not be read.
            OSError: it cannot be read.
        """
        unsaved = self.search.unsaved_of(path)
        if unsaved is None:
            return self.files.read(path)
        self.files.require_readable(path)
        return unsaved

    def _find(self, uri: str, files: Iterable[Path]) -> dict[str, str]:
        """Where a URI leads from the first of the files from which it leads anywhere."""
        answer: dict[str, str] = {}
        for file in files:
            try:
                self.files.require_readable(str(file))  # the process may say anything about where it is
                return {"path": str(self.search.find(uri, file).absolute())}  # links keep their names
            except UriError as error:
                absent = error.rule is rules.UNRESOLVED_URI
                answer = {"error": error.message, "help": error.help or "", **({"absent": "yes"} if absent else {})}
        return answer

    def _variable(self, name: str) -> str | None:
        """The value of an environment variable.

        Raises:
            DeniedError: it must not be read.
        """
        value = None
        try:
            value = variable(name, os.environ, self.variables)
        finally:
            note_variable(name, value)  # what was not given is not written down either
        return value


def _understood(line: bytes) -> dict[str, Any]:
    """A message; nothing where the process died while it spoke."""
    try:
        received: object = json.loads(line)
    except ValueError:
        return {}
    return cast("dict[str, Any]", received) if isinstance(received, dict) else {}
