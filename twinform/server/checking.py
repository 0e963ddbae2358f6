"""Checks of documents by the settings of their project, and rewrites of whole documents, in a process of their own.

The editor's text counts for every open file, also if another file includes it. A hostile document costs no more than a
process and its time: xacro is expanded in the same confined process as by the command `check`.
"""

import os
from collections.abc import Callable, Mapping
from dataclasses import field, replace
from pathlib import Path
from typing import NamedTuple

from twinform.compiler.companions.check_companion import check_companion, is_companion, may_be_companion
from twinform.compiler.conversion_error import CompileError
from twinform.compiler.fixing import with_fixes
from twinform.compiler.formatting import formatted
from twinform.compiler.in_place import convert_in_place
from twinform.compiler.input.finding_spans import SourceFiles, with_columns
from twinform.compiler.input.include_graph import IncludeGraph
from twinform.compiler.input.load_options import LoadOptions, LoadResult
from twinform.compiler.input.loading import read
from twinform.compiler.input.size_limits import Limits
from twinform.compiler.inspection import as_refused, inspect
from twinform.compiler.request import ConversionRequest
from twinform.compiler.resolve_uris import SearchPath
from twinform.dataclass import dataclass
from twinform.diagnostics import Diagnostic, Policy, Span, TextEdit, rules
from twinform.passes import FilesPass, PassError, PipelineError, parse_pipeline
from twinform.text import Lines, SourceText
from twinform.text.formatting import FormatOptions

LARGEST = 4 * 2**20
"""The largest text in bytes that is followed while somebody types: twice the largest real file."""
MOST_TAGS = 100_000
"""The most tags of a text that is followed: more than twice those of the largest real file."""
USUAL_LIMITS = Limits(LARGEST, MOST_TAGS)


@dataclass(frozen=True, slots=True)
class EditorSettings:
    """How files are read and formatted, and which findings are shown; `problem` says why settings were ignored."""

    load_options: LoadOptions = field(default_factory=lambda: LoadOptions(limits=USUAL_LIMITS, tolerant=True))
    policy: Policy = field(default_factory=Policy)
    layout: FormatOptions = field(default_factory=FormatOptions)
    problem: str = ""


SettingsOf = Callable[[Path], EditorSettings]
"""Returns the settings for a file."""


def no_settings(_: Path) -> EditorSettings:
    """Return the defaults, for a project without settings."""
    return EditorSettings()


# Missing in a xacro file that others include, so these are not reported there.
_OF_WHOLE_ROBOTS = frozenset(
    each.name for each in (rules.EMPTY_MODEL, rules.MISSING_ATTRIBUTE, rules.MISSING_ELEMENT, rules.NO_LINKS)
)


class CheckJob(NamedTuple):
    """A document to check, with the texts of all open files; `is_part` if it is made to be included by others."""

    path: Path
    unsaved: Mapping[str, bytes]
    settings: EditorSettings
    is_part: bool = False

    @property
    def load_options(self) -> LoadOptions:
        """The options for reading the document and the files that it includes, with the unsaved texts."""
        search = replace(self.settings.load_options.search, unsaved=self.unsaved, seen=set())
        return replace(self.settings.load_options, search=search)


@dataclass(frozen=True, slots=True)
class Checked:
    """The findings of a check, and the files that were read for it."""

    diagnostics: tuple[Diagnostic, ...]
    files: frozenset[str]


def check(job: CheckJob) -> Checked:
    """Check a document as `twinform check` does."""
    load_options = job.load_options
    data = job.unsaved.get(os.path.realpath(job.path), b"")
    if is_companion(job.path, data):
        loaded = check_companion(job.path, load_options, data)
    elif may_be_companion(job.path):  # YAML of something else
        return Checked((), frozenset())
    else:
        loaded = as_refused(inspect(read(str(job.path), load_options), load_options))
    found = job.settings.policy.apply(_locate_findings(loaded, job.unsaved))
    if job.is_part:
        found = tuple(each for each in found if not _is_of_whole_robot(each))
    return Checked(found, frozenset(str(path.absolute()) for path in load_options.search.seen))


def robots_among(files: list[str], search: SearchPath) -> list[str]:
    """Return the files that are checked as robots, and not as parts of others."""
    return [file for file, role in IncludeGraph(search).roles(files).items() if role in {"robot", "either"}]


def _is_of_whole_robot(found: Diagnostic) -> bool:
    return found.rule.name in _OF_WHOLE_ROBOTS and found.location.path in {"/robot", "/robot/@name"}


def _locate_findings(loaded: LoadResult, unsaved: Mapping[str, bytes]) -> tuple[Diagnostic, ...]:
    """Return the findings with their columns and fixes."""
    files = SourceFiles({**unsaved, **SourceFiles.of(loaded).contents})
    return with_columns(with_fixes(loaded), files)


class Rewritten(NamedTuple):
    """The edits of a document, or the problem that keeps it from being rewritten."""

    edits: tuple[TextEdit, ...] = ()
    problem: str = ""


def run_passes(job: CheckJob, pipeline: str) -> Rewritten:
    """Run passes on a document in place, and return what they change."""
    load_options = job.load_options
    document = read(str(job.path), load_options).document
    if document is None:
        return Rewritten(problem="the document cannot be read: fix what is wrong with it first")
    to = document.format.value
    version = document.version if to == "sdf" else None
    try:
        passes = parse_pipeline(pipeline)
        if any(isinstance(step, FilesPass) for step in passes):
            return Rewritten(problem="it makes files, and an editor changes documents only; use `twinform convert`")
        request = ConversionRequest(to=to, sdf_version=version, passes=passes)
        updated = convert_in_place(request, job.path, load_options)
    except CompileError as error:
        return Rewritten(problem=_first_error(error.diagnostics))
    except (PassError, PipelineError) as error:
        return Rewritten(problem=str(error))
    lines = Lines(SourceText.of(_read(job)).text)
    starts = [(lines.start(place.line) + place.column - 1, old, new) for place, old, new in updated.changes]
    return Rewritten(tuple(TextEdit(Span(start, start + len(old)), new) for start, old, new in starts))


def format_document(job: CheckJob) -> Rewritten:
    """Format a document, and return what changes."""
    data = _read(job)
    try:
        made = formatted(data, str(job.path), job.settings.layout, job.settings.load_options.limits)
    except CompileError as error:
        return Rewritten(problem=_first_error(error.diagnostics))
    before, after = SourceText.of(data).text, SourceText.of(made).text
    return Rewritten((_single_edit(before, after),) if before != after else ())


def _single_edit(before: str, after: str) -> TextEdit:
    """Return the one edit between two texts, without their common beginning and end."""
    most = min(len(before), len(after))
    start = next((n for n in range(most) if before[n] != after[n]), most)
    left = most - start
    end = next((n for n in range(left) if before[-1 - n] != after[-1 - n]), left)
    return TextEdit(Span(start, len(before) - end), after[start : len(after) - end])


def _read(job: CheckJob) -> bytes:
    unsaved = job.load_options.search.unsaved_of(job.path)
    return unsaved if unsaved is not None else job.load_options.search.readable(job.path).read(job.path)


def _first_error(found: tuple[Diagnostic, ...]) -> str:
    errors = [each for each in found if each.is_error] or list(found)
    first = errors[0] if errors else None
    return f"line {first.location.line}: {first.message}" if first else "it cannot be changed in its place"
