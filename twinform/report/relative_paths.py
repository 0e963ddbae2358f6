"""Paths in a report, which is read on other machines: they do not begin at the root of the one that made it."""

import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import fields, is_dataclass, replace
from os.path import abspath, realpath
from pathlib import Path
from typing import Any, TypeVar, cast

from twinform.compiler.resolve_uris import SearchPath
from twinform.dataclass import dataclass
from twinform.diagnostics import Location, Rule
from twinform.diagnostics.reporters import FileFindings
from twinform.diagnostics.reporters.file_findings import FileTexts

Value = TypeVar("Value")
Shorten = Callable[[str], str]
"""Makes the paths in a text relative."""


def relative_to_here(files: Iterable[str], search: SearchPath) -> Shorten:
    """Return a function that makes paths in a text relative to the working directory.

    Paths elsewhere begin with the name of the folder in which files were looked for.
    """
    here = Path.cwd()
    # a root, such as the working directory of a container may be, has no name, and every path is below it
    names = {str(each): each.name for each in _folders(files, search) if each.name}
    if here.name:
        names = {each: name for each, name in names.items() if not Path(each).is_relative_to(here)} | {str(here): ""}
    longest_first = sorted(names, key=len, reverse=True)
    if not longest_first:
        return str
    found = re.compile(rf"(?<![\w.~-])({'|'.join(map(re.escape, longest_first))})([/\\]|(?![\w-]|\.\w))")
    return lambda text: found.sub(lambda match: _shortened(names[match[1]], match[2]), text)


def _shortened(name: str, separator: str) -> str:
    return f"{name}{separator}" if name else "" if separator else "."


def _folders(files: Iterable[str], search: SearchPath) -> Iterator[Path]:
    """Yield the folders in which files are looked for, as they are named and where links lead to."""
    surroundings = [search.surroundings(Path(file)) for file in files]
    found = [around.neighbors or around.folders[-1] for around in surroundings]
    found += (*search.own, *search.models, *search.packages, *search.workspaces, *search.fuel, *search.asked)
    for folder in found:
        yield Path(abspath(folder))  # noqa: PTH100 - links stay links
        yield Path(realpath(folder))


def with_relative_paths(value: Value, shorten: Shorten) -> Value:
    """Shorten every text in a value but the paths of elements, which begin at the root of their file, and rules."""
    if type(value) is str:
        return cast("Value", shorten(value))
    if isinstance(value, Location):
        return cast("Value", value._replace(file=shorten(value.file)))
    if isinstance(value, FileFindings):
        return cast("Value", _shorten_findings(value, shorten))
    if isinstance(value, tuple):
        whole = cast("tuple[object, ...]", value)
        items = [with_relative_paths(each, shorten) for each in whole]
        make: Callable[[Iterable[object]], object] = getattr(whole, "_make", tuple)
        return cast("Value", make(items))
    if is_dataclass(value) and not isinstance(value, (type, Rule)):
        made = cast("Any", value)
        parts = {each.name: with_relative_paths(getattr(made, each.name), shorten) for each in fields(made)}
        return replace(made, **parts)
    return value


def _shorten_findings(found: FileFindings, shorten: Shorten) -> FileFindings:
    names = {found.path, *(each.location.file for each in found.diagnostics)}
    texts = _RenamedTexts({shorten(each): each for each in names}, found.texts)
    diagnostics = with_relative_paths(found.diagnostics, shorten)
    return FileFindings(shorten(found.path), diagnostics, texts)


@dataclass(frozen=True, slots=True)
class _RenamedTexts:
    """The texts of files by their names in a report; `names` are those that they were read by."""

    names: Mapping[str, str]
    texts: FileTexts

    def line(self, file: str, number: int, /) -> str | None:
        return self.texts.line(self.names.get(file, file), number)

    def place(self, file: str, offset: int, /) -> tuple[int, int] | None:
        return self.texts.place(self.names.get(file, file), offset)
