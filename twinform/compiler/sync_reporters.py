"""What `twinform sync` found, as text and as JSON; reporters only format."""

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from textwrap import indent
from types import MappingProxyType

from twinform.compiler.compare.comparison_reporters import item_fields
from twinform.compiler.compare.comparison_reporters import text as comparison_text
from twinform.compiler.in_place import TextChange
from twinform.compiler.syncing import SyncedFile, SyncState
from twinform.dataclass import dataclass
from twinform.diagnostics.reporters import printable


@dataclass(frozen=True, slots=True)
class SyncedGroup:
    """The files of one robot: the name of the group in the configuration, the source, and the others."""

    name: str
    source: str
    files: Sequence[SyncedFile]


def text(groups: Sequence[SyncedGroup]) -> str:
    """Format each file that is not up to date with the differences in it, and a line of counts for each group."""
    return "".join(line for group in groups for line in _group_lines(group))


def _group_lines(group: SyncedGroup) -> Iterator[str]:
    for each in group.files:
        if each.state is SyncState.CURRENT:
            continue
        yield f"{printable(each.path)}: {each.state}\n"
        yield indent(comparison_text(each.comparison), "  ") if each.comparison else ""
    name = f"{group.name}: " if group.name else ""
    yield f"{printable(name)}{printable(group.source)} is the source: {', '.join(_counts(group.files))}\n"


def _counts(files: Iterable[SyncedFile]) -> Iterator[str]:
    count = Counter(each.state for each in files)
    return (f"{count[state]} {state}" for state in SyncState if count[state])


def json(groups: Sequence[SyncedGroup]) -> str:
    """Format groups as `{"groups": [{"name", "source", "files": [...]}]}`; every key is always there.

    A file is `{"path", "format", "state", "differences", "changes", "anew"}`. Its differences are items as
    `twinform diff` has them, and a change of its text is `{"line", "column", "old", "new"}`.
    """
    from json import dumps  # noqa: PLC0415 - a text needs none of it

    whole = [
        {"name": each.name, "source": each.source, "files": [_file_fields(file) for file in each.files]}
        for each in groups
    ]
    return dumps({"groups": whole}, indent=2, allow_nan=False) + "\n"


def _file_fields(file: SyncedFile) -> dict[str, object]:
    return {
        "path": file.path,
        "format": file.format,
        "state": str(file.state),
        "differences": [item_fields(each) for each in file.comparison.items] if file.comparison else [],
        "changes": [_change_fields(each) for each in file.changes],
        "anew": file.anew,
    }


def _change_fields(change: TextChange) -> dict[str, object]:
    line, column = change.place
    return {"line": line, "column": column, "old": change.old, "new": change.new}


REPORTERS: Mapping[str, Callable[[Sequence[SyncedGroup]], str]] = MappingProxyType({"text": text, "json": json})
"""Every output format by its name on the command line."""
