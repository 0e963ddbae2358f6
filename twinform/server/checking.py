"""Checks of documents, in a process of their own: what is wrong with a text, and with the files that it is made of.

The editor's text counts for every file that is open, also where another one includes it. Whatever a document holds,
it costs no more than a process and its time: xacro is expanded in the confined process that `check` uses.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import NamedTuple

from twinform.compiler.fixing import with_fixes
from twinform.compiler.input.finding_spans import with_columns
from twinform.compiler.input.load_options import LoadOptions, LoadResult
from twinform.compiler.input.loading import read
from twinform.compiler.input.source_files import SourceFiles
from twinform.compiler.inspection import inspect
from twinform.diagnostics import Diagnostic, rules
from twinform.server.settings import EditorSettings

# Missing in a xacro file that others include, so these are not reported there.
_OF_WHOLE_ROBOTS = frozenset({rules.EMPTY_MODEL.name, rules.MISSING_ATTRIBUTE.name, rules.MISSING_ELEMENT.name})


class CheckJob(NamedTuple):
    """A document to check. `unsaved` are the texts of all files that are open; others include one that `is_part`."""

    path: Path
    unsaved: Mapping[str, bytes]
    settings: EditorSettings
    is_part: bool = False

    @property
    def load_options(self) -> LoadOptions:
        """How its file is read, and those that it is made of."""
        search = replace(self.settings.load_options.search, unsaved=self.unsaved, seen=set())
        return replace(self.settings.load_options, search=search)


@dataclass(frozen=True, slots=True)
class Checked:
    """What was found, and the files that were read for it."""

    diagnostics: tuple[Diagnostic, ...]
    files: frozenset[str]


def check(job: CheckJob) -> Checked:
    """Read a document as `twinform check` does."""
    load_options = job.load_options
    loaded = inspect(read(str(job.path), load_options), load_options)
    found = job.settings.policy.apply(findings_of(loaded, job.unsaved))
    if job.is_part:
        found = tuple(each for each in found if not _is_of_whole_robot(each))
    return Checked(found, frozenset(str(path.absolute()) for path in load_options.search.seen))


def _is_of_whole_robot(found: Diagnostic) -> bool:
    return found.rule.name in _OF_WHOLE_ROBOTS and found.location.path in {"/robot", "/robot/@name"}


def findings_of(loaded: LoadResult, unsaved: Mapping[str, bytes]) -> tuple[Diagnostic, ...]:
    """What was found, with columns, and with fixes where there are any: the one place where both come in."""
    files = SourceFiles({**unsaved, **SourceFiles.of(loaded).contents})
    return with_columns(with_fixes(loaded), files)
