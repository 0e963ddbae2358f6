"""Checks of documents, in a process of their own: what is wrong with a text, and with the files that it is made of.

The editor's text counts for every file that is open, also where another one includes it. Whatever a document holds,
it costs no more than a process and its time: xacro is expanded in the confined process that `check` uses.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import NamedTuple

from twinform.compiler.input.finding_spans import FindingSpans
from twinform.compiler.input.loading import read
from twinform.compiler.input.options import LoadResult
from twinform.compiler.inspection import inspect
from twinform.diagnostics import Diagnostic, Location
from twinform.diagnostics.rules import model, structure
from twinform.server.settings import Settings
from twinform.text import Lines

_OF_WHOLE_ROBOTS = frozenset({model.EMPTY_MODEL.name, structure.MISSING_ATTRIBUTE.name, structure.MISSING_ELEMENT.name})
"""What is missing in a xacro file that others include, and is not looked for in it."""


class Job(NamedTuple):
    """A document to check. `unsaved` are the texts of all files that are open; others include one that `is_part`."""

    path: Path
    unsaved: Mapping[str, bytes]
    settings: Settings
    is_part: bool = False


@dataclass(frozen=True, slots=True)
class Checked:
    """What was found, and the files that were read for it."""

    diagnostics: tuple[Diagnostic, ...]
    files: frozenset[str]


def check(job: Job) -> Checked:
    """Read a document as `twinform check` does."""
    search = replace(job.settings.load_options.search, unsaved=job.unsaved, seen=set())
    load_options = replace(job.settings.load_options, search=search)
    loaded = inspect(read(str(job.path), load_options), load_options)
    found = job.settings.policy.apply(findings_of(loaded))
    if job.is_part:
        found = tuple(each for each in found if not _is_of_whole_robot(each))
    return Checked(found, frozenset(str(path.absolute()) for path in search.seen))


def _is_of_whole_robot(found: Diagnostic) -> bool:
    return found.rule.name in _OF_WHOLE_ROBOTS and found.location.path in {"/robot", "/robot/@name"}


def findings_of(loaded: LoadResult) -> tuple[Diagnostic, ...]:
    """What was found, with columns and fixes: the one place where both come in."""
    places = None if loaded.content is None or loaded.origins else FindingSpans.of(loaded.content)
    if places is None:
        return loaded.diagnostics
    return tuple(replace(each, location=_with_columns(each.location, places)) for each in loaded.diagnostics)


def _with_columns(where: Location, places: FindingSpans) -> Location:
    span = places.span(where)
    if span is None:
        return where
    lines: Lines = places.lines
    start, end = lines.place(span.start), lines.place(span.end)
    return where._replace(line=start.line, column=start.column, end_line=end.line, end_column=end.column)
