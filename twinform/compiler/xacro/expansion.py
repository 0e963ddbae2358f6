"""From a xacro file to the text that it expands to, and where its lines come from."""

import json
import os
import subprocess
import sys
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from threading import Timer
from typing import Any

from lxml import etree

from twinform.compiler.limits import LARGEST
from twinform.compiler.parsing import UnreadableError
from twinform.compiler.surroundings import folders_around
from twinform.compiler.uris import SearchPath, UriError
from twinform.diagnostics import Location, Notes, Origins
from twinform.diagnostics.rules import reading
from twinform.diagnostics.rules import xacro as rules

_WORKER = Path(__file__).with_name("worker.py")
_SECONDS = 60
"""Of the clock, on a machine that is busy; the worker itself has 10 of the processor."""
_REMARKS = {"warning: ": rules.XACRO_WARNING, "error: ": rules.XACRO_WARNING}


@dataclass(frozen=True, slots=True)
class Expansion:
    """The expanded text, and where the elements on its lines were written."""

    text: bytes
    origins: Origins


def expand(path: Path, arguments: Mapping[str, str], search: SearchPath, notes: Notes) -> Expansion:
    """The text of a xacro file.

    Raises:
        UnreadableError: it cannot be expanded; the notes say why.
    """
    if not path.is_file():
        notes.report(reading.UNREADABLE_FILE, "cannot read the file: there is none of this name")
        raise UnreadableError
    outcome = _ask_worker(path, arguments, search)
    _report_remarks(outcome, notes)
    if "text" not in outcome:
        _report_failure(outcome, notes)
        raise UnreadableError
    for name in outcome["unused"]:
        message = f"the argument {name!r} is not one of the file's"
        notes.report(rules.UNUSED_ARGUMENT, message, Location(line=1), found=name)
    text = outcome["text"].encode()
    if len(text) > LARGEST:
        message = f"the expanded file has {len(text):,} bytes; the limit is {LARGEST:,}"
        notes.report(reading.UNREADABLE_FILE, message)
        raise UnreadableError
    return Expansion(text, _origins(text, outcome["places"]))


def _ask_worker(path: Path, arguments: Mapping[str, str], search: SearchPath) -> dict[str, Any]:
    # -P: the folder of the script is no place to import from, it has modules of common names
    command = [sys.executable, "-P", str(_WORKER)]
    environment = {**os.environ, "PYTHONIOENCODING": "utf-8"}
    pipe = subprocess.PIPE
    with subprocess.Popen(  # noqa: S603 - our own script, and no shell
        command, stdin=pipe, stdout=pipe, stderr=subprocess.DEVNULL, env=environment, encoding="utf-8"
    ) as process:
        timer = Timer(_SECONDS, process.kill)
        timer.start()
        try:
            return _converse(process, _task(path, arguments, search), path, search)
        finally:
            timer.cancel()
            process.kill()


def _task(path: Path, arguments: Mapping[str, str], search: SearchPath) -> dict[str, object]:
    """What the worker is to do, and the folders whose files it may read.

    Folders that the environment names are the user's own installation, in which links lead to where it was built from.
    """
    folders = (path.parent, *search.own, *folders_around(path))
    trusted = (*search.models, *search.packages, *search.workspaces)
    return {
        "file": str(path),
        "arguments": dict(arguments),
        "folders": [*map(str, folders), *map(str, trusted)],
        "trusted": [*map(str, trusted)],
    }


def _converse(
    process: subprocess.Popen[str], task: Mapping[str, object], path: Path, search: SearchPath
) -> dict[str, Any]:
    """Give the worker its task and answer its questions, until it says what became of it."""
    to_worker, from_worker = process.stdin, process.stdout
    message: Mapping[str, object] = task
    try:
        while to_worker and from_worker:
            to_worker.write(json.dumps(message) + "\n")
            to_worker.flush()
            line = from_worker.readline()
            if not line:
                break
            said: dict[str, Any] = json.loads(line)
            if "find" not in said:
                return said
            message = _answer(said["find"], (Path(said["beside"]), path), search)
    except BrokenPipeError:
        pass  # it died before it could listen
    return _no_end(path)


def _answer(uri: str, files: Iterable[Path], search: SearchPath) -> dict[str, str]:
    """Where a URI leads from the first of the files from which it leads anywhere."""
    answer: dict[str, str] = {}
    for file in files:
        try:
            return {"path": str(search.find(uri, file))}
        except UriError as error:
            answer = {"error": error.message, "help": error.help or ""}
    return answer


def _no_end(path: Path) -> dict[str, Any]:
    return {"error": "the expansion died, or did not end within its time", "place": (str(path), 1)}


def _report_failure(outcome: Mapping[str, Any], notes: Notes) -> None:
    if "missing" in outcome:
        advice = "run: pip install 'twinform[xacro]'"
        message = f"this is a xacro file, and xacro is not installed ({outcome['missing']})"
        notes.report(rules.XACRO_MISSING, message, Location(line=1), help=advice)
        return
    file, line = outcome["place"]
    notes.report(rules.XACRO_ERROR, outcome["error"], Location(file, line), help=outcome.get("help"))


def _report_remarks(outcome: Mapping[str, Any], notes: Notes) -> None:
    for text, file, line in outcome.get("remarks", ()):
        start = next((start for start in _REMARKS if text.startswith(start)), "")
        rule = _REMARKS.get(start, rules.XACRO_MESSAGE)
        notes.report(rule, text.removeprefix(start), Location(file, line))


def _origins(text: bytes, places: list[tuple[str, int] | None]) -> Origins:
    """Elements are in the same order in the expanded text and in the list of places."""
    parser = etree.XMLParser(remove_comments=True, remove_pis=True, resolve_entities=False, no_network=True)
    try:
        root = etree.fromstring(text, parser)
    except etree.XMLSyntaxError:
        return Origins()  # reading the text will say what is wrong with it
    pairs = zip(root.iter(), places, strict=False)
    return Origins.of((element.sourceline or 0, Location(*place)) for element, place in pairs if place)
