"""Which xacro files include which others, as far as that can be said without expanding them."""

import os
import re
from collections import defaultdict
from collections.abc import Collection, Iterable, Iterator
from fnmatch import fnmatchcase
from pathlib import Path
from typing import Literal, NamedTuple

from twinform.compiler.input.size_limits import LARGEST
from twinform.compiler.input.xacro_outline import Outline, outline
from twinform.compiler.resolve_uris import SearchPath, UriError

Role = Literal["robot", "part", "either"]
"""Whether a file is checked as a robot, as a part of others, or as a part if it is no robot by itself."""
_FIND = re.compile(r"\$\(\s*find\s+(?P<package>[\w.-]+)\s*\)/*")
_PACKAGE = re.compile(r"package://(?P<package>[\w.-]+)/*")
_DIRNAME = re.compile(r"\$\(\s*dirname\s*\)/*")
_SUBSTITUTION = re.compile(r"\$\([^)]*\)|\$\{[^}]*\}")
_WILD = re.compile(r"[*?[]")
# Each distinct address with expressions is compared with all files.
_LONGEST = 4096
"""Characters of a pattern, as long as a path may be: an expression of a million takes seconds to compile."""
_MOST_PATTERNS = 200
_MOST_INCLUDED = 1000
"""The most files that the includes of one file lead to."""


class _Address(NamedTuple):
    """The folder and the rest of an include; the folder is None where its package is not found."""

    folder: Path | None
    rest: str

    @property
    def is_literal(self) -> bool:
        return not _WILD.search(self.rest)


class IncludeGraph:
    """The outlines of files by their real paths, and their includes; outlines of other files are read on demand."""

    def __init__(self, search: SearchPath) -> None:
        self.search = search
        self._outlines: dict[str, Outline] = {}
        self._targets: dict[str, tuple[str, ...]] = {}

    def outline(self, path: str, beside: str = "") -> Outline:
        """Return the outline of a file, which may be read because `beside` leads to it; an empty one if it has none."""
        if path not in self._outlines:
            plain = path.lower().endswith(".urdf")
            self._outlines[path] = outline(self._content(path, beside or path), plain=plain)
        return self._outlines[path]

    def _content(self, path: str, beside: str) -> bytes:
        unsaved = self.search.unsaved_of(path)
        if unsaved is not None:
            return unsaved
        try:
            data = self.search.readable(Path(beside)).read(path, LARGEST)
        except (OSError, ValueError):
            return b""
        return data if len(data) <= LARGEST else b""

    def included(self, path: str, beside: str = "") -> tuple[str, ...]:
        """Return the files that a file includes by addresses without expressions, and that are there."""
        if path not in self._targets:
            addresses = (self._address(each.text, path) for each in self.outline(path, beside).includes)
            files = (each.folder / each.rest for each in addresses if each.folder is not None and each.is_literal)
            there = (each for each in files if os.path.isfile(each))  # noqa: PTH113 - is_file raises for a long name
            self._targets[path] = tuple(dict.fromkeys(map(os.path.realpath, there)))
        return self._targets[path]

    def closure(self, path: str) -> Iterator[tuple[str, Outline]]:
        """Yield a file and all that it includes, each once, with their outlines."""
        found, waiting = {path}, [path]
        while waiting and len(found) <= _MOST_INCLUDED:
            here = waiting.pop()
            yield here, self.outline(here, path)
            new = [each for each in self.included(here, path) if each not in found]
            found.update(new)
            waiting.extend(reversed(new))

    def roles(self, files: Iterable[str]) -> dict[str, Role]:
        """Tell which of some files are robots, and which are only parts of others."""
        known = {os.path.realpath(each): each for each in files}
        for path, name in known.items():
            self.outline(path, name)  # the name decides whether a link is followed
        named = self._named_by_expressions(known)
        roots = self._roots(list(known))
        return {
            name: "part" if path not in roots or _is_semantic(path) else "either" if path in named else "robot"
            for path, name in known.items()
        }

    def _roots(self, paths: list[str]) -> set[str]:
        """Return the robots from which the others are reached; one of each circle that nothing else leads to."""
        included = {target for path in paths for target in self.included(path) if target != path}
        robots = [path for path in paths if self.outline(path).is_robot]
        roots: set[str] = set()
        reached: set[str] = set()
        known = set(paths)
        for path in (*(each for each in paths if each not in included), *robots):
            if path in reached:
                continue
            roots.add(path)
            waiting = [path]
            while waiting:
                here = waiting.pop()
                if here not in reached:
                    reached.add(here)
                    waiting.extend(known.intersection(self.included(here)))
        return roots.intersection(robots)

    def _named_by_expressions(self, paths: Collection[str]) -> set[str]:
        """Return the files that an include may mean whose address has expressions, or an unknown package."""
        by_name: dict[str, list[str]] = defaultdict(list)
        for path in paths:
            by_name[os.path.basename(path)].append(path)  # noqa: PTH119 - many strings
        found: set[str] = set()
        patterns: set[str] = set()
        for path in list(self._outlines):
            for each in self._outlines[path].includes:
                address = self._address(each.text, path)
                if address.is_literal and address.folder is not None:
                    continue
                place = "*" if address.folder is None else os.path.realpath(address.folder)
                pattern = f"{place}/{address.rest}"
                if address.is_literal:
                    found.update(file for file in by_name[Path(address.rest).name] if fnmatchcase(file, pattern))
                elif _is_telling(address) and len(patterns) < _MOST_PATTERNS and len(pattern) <= _LONGEST:
                    patterns.add(pattern)
        found.update(path for path in paths for pattern in patterns if fnmatchcase(path, pattern))
        return found

    def _address(self, uri: str, path: str) -> _Address:
        uri = uri.strip()
        package = _FIND.match(uri) or _PACKAGE.match(uri)
        if package is not None:
            try:
                folder = self.search.package(package["package"], Path(path))
            except UriError:
                folder = None
            return _Address(folder, _SUBSTITUTION.sub("*", uri[package.end() :]))
        rest = _SUBSTITUTION.sub("*", _DIRNAME.sub("", uri))
        return _Address(None, rest.lstrip("*/")) if rest.startswith("*") else _Address(Path(path).parent, rest)


def _is_semantic(path: str) -> bool:
    """Whether a file is SRDF by its name: its macros do not show what they make."""
    return path.lower().endswith(".srdf.xacro")


def _is_telling(address: _Address) -> bool:
    """Whether an address with expressions says more than an ending: `$(arg model).urdf.xacro` may be any file."""
    stem = Path(address.rest).name.partition(".")[0]
    return address.folder is not None or bool(_WILD.sub("", stem))
