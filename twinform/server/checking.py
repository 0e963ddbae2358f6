"""Checks of documents by the settings of their project; `check` runs in a process of its own.

The editor's text counts for every open file, also if another file includes it. A hostile document costs no more than a
process and its time: xacro is expanded in the same confined process as by the command `check`.
"""

from collections.abc import Callable, Mapping
from dataclasses import field, replace
from pathlib import Path
from typing import NamedTuple

from twinform.compiler.fixing import with_fixes
from twinform.compiler.input.finding_spans import SourceFiles, with_columns
from twinform.compiler.input.load_options import LoadOptions, LoadResult
from twinform.compiler.input.loading import read
from twinform.compiler.input.size_limits import Limits
from twinform.compiler.inspection import as_refused, inspect
from twinform.dataclass import dataclass
from twinform.diagnostics import Diagnostic, Policy, rules
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
    loaded = as_refused(inspect(read(str(job.path), load_options), load_options))
    found = job.settings.policy.apply(_locate_findings(loaded, job.unsaved))
    if job.is_part:
        found = tuple(each for each in found if not _is_of_whole_robot(each))
    return Checked(found, frozenset(str(path.absolute()) for path in load_options.search.seen))


def _is_of_whole_robot(found: Diagnostic) -> bool:
    return found.rule.name in _OF_WHOLE_ROBOTS and found.location.path in {"/robot", "/robot/@name"}


def _locate_findings(loaded: LoadResult, unsaved: Mapping[str, bytes]) -> tuple[Diagnostic, ...]:
    """Return the findings with their columns and fixes."""
    files = SourceFiles({**unsaved, **SourceFiles.of(loaded).contents})
    return with_columns(with_fixes(loaded), files)
