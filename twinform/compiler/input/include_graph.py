"""What files of xacro and MJCF include, define and ask for, as far as that can be said without expanding them."""

import os
from collections import defaultdict
from collections.abc import Collection, Iterable, Iterator
from dataclasses import field
from fnmatch import fnmatchcase
from itertools import islice
from pathlib import Path
from typing import Literal, NamedTuple
from xml.parsers import expat

from twinform.compiler.input.load_options import XACRO
from twinform.compiler.input.root_names import is_mjcf
from twinform.compiler.input.size_limits import LARGEST
from twinform.compiler.resolve_uris import SearchPath, UriError
from twinform.dataclass import dataclass
from twinform.file_access import Readable
from twinform.lazy import lazy_pattern
from twinform.text import Lines, SourceText, UndecodableError
from twinform.text.tokens import masked

_DEFINITIONS = frozenset({"arg", "include", "macro", "property", "insert_block"})
"""Elements of xacro that are no part of a robot by themselves."""
_SHARED = frozenset({"material", "xacro:if", "xacro:unless"})
"""Elements that files with definitions for others have as well."""
_MJCF = frozenset({"mujoco", "mujocoinclude"})
"""The usual roots of MJCF files, and of those that they include."""
_SEMANTICS = frozenset({"disable_collisions", "end_effector", "group", "group_state", "passive_joint", "virtual_joint"})
"""Elements of SRDF, which has the same root and is about a robot in another file."""
_ASKED = lazy_pattern(r"\$\(\s*(?P<what>arg|find)\s+(?P<name>[\w.-]+)\s*\)")


class Mention(NamedTuple):
    """A name or address that a file mentions, and its line."""

    text: str
    line: int


@dataclass(frozen=True, slots=True)
class Outline:
    """The parts of a file that connect it with others; `arguments` are those declared, with their defaults.

    It `has_semantics` if elements of SRDF stand in its root.
    """

    root: str = ""
    is_robot: bool = False
    includes: tuple[Mention, ...] = ()
    arguments: dict[str, str | None] = field(default_factory=dict[str, str | None])
    asked: tuple[Mention, ...] = ()
    packages: tuple[Mention, ...] = ()
    has_semantics: bool = False


_MOST_TAGS = 100_000
"""A file with more is taken for a robot; the largest file of macros that is known has 3,000."""
UNKNOWN = Outline(is_robot=True)
"""The outline of what has none: reading it as a robot says why."""


def outline(data: bytes, *, plain: bool = False) -> Outline:
    """Return the outline of a file of xacro or MJCF, or of a `plain` URDF file, which other files may include.

    A plain file without a name for its robot that has elements of xacro, or no link, is a part of others, and so is
    one that has nothing but materials and definitions of xacro.
    """
    if data.count(b"<") > _MOST_TAGS:
        return UNKNOWN
    if plain and b"xacro" not in data and b"<link" in data:
        return UNKNOWN
    try:
        text = SourceText.of(data).text
        tags = _Tags(text)
    except (UndecodableError, expat.ExpatError):
        return UNKNOWN
    asked = _find_requests(text) if "$(" in text else {}
    return Outline(
        tags.root,
        tags.makes_plain_robot() if plain else tags.makes_robot(),
        tuple(tags.includes),
        tags.arguments,
        tuple(asked.get("arg", ())),
        tuple(asked.get("find", ())),
        not _SEMANTICS.isdisjoint(tags.children),
    )


def is_mjcf_model(path: Path) -> bool:
    """Whether a file is MJCF with bodies or includes, and not only a part with assets or the like for others."""
    if not is_mjcf(path):
        return False
    try:
        return outline(Readable.of(path).read(path, LARGEST)).is_robot
    except (OSError, ValueError):
        return True  # reading it reports why


def _find_requests(text: str) -> dict[str, list[Mention]]:
    """Find the arguments and packages that a text asks for outside of comments, by the word that asks."""
    lines = Lines(text)
    found = defaultdict[str, list[Mention]](list)
    for each in _ASKED.finditer(masked(text)):
        found[each["what"]].append(Mention(each["name"], lines.place(each.start()).line))
    return found


class _Tags:
    """The start tags of a text: the root, the names of the elements directly in it, and what includes and declares.

    Raises:
        expat.ExpatError: the text is not well-formed, or has a document type declaration.
    """

    def __init__(self, text: str) -> None:
        self.root = ""
        self.attributes: dict[str, str] = {}
        self.children: set[str] = set()
        self.includes: list[Mention] = []
        self.arguments: dict[str, str | None] = {}
        self._depth = 0
        self._parser = parser = expat.ParserCreate("utf-8")
        parser.StartElementHandler, parser.EndElementHandler = self._start, self._end
        parser.StartDoctypeDeclHandler = _refuse_doctype
        try:
            parser.Parse(text.encode("utf-8", "surrogatepass"), True)
        finally:
            del self._parser  # it holds this object by its handlers

    def _start(self, name: str, attributes: dict[str, str]) -> None:
        if not self._depth:
            self.root, self.attributes = name, attributes
        elif self._depth == 1:
            self.children.add(name)
        self._depth += 1
        if name == "xacro:include" and "filename" in attributes:
            self.includes.append(Mention(attributes["filename"], self._parser.CurrentLineNumber))
        elif name == "include" and self.root in _MJCF and "file" in attributes:
            self.includes.append(Mention(attributes["file"], self._parser.CurrentLineNumber))
        elif name == "xacro:arg" and "name" in attributes:
            self.arguments[attributes["name"]] = attributes.get("default")

    def _end(self, _: str) -> None:
        self._depth -= 1

    def makes_plain_robot(self) -> bool:
        """Whether a file that nothing expands is a robot."""
        is_named = self.root != "robot" or "name" in self.attributes
        return is_named and ("xmlns:xacro" not in self.attributes or self.makes_robot())

    def makes_robot(self) -> bool:
        """Whether a file makes a robot, and does not only define macros for others.

        A robot has a name, and has parts in it, or includes and no macros. In MJCF it has bodies, or includes.
        """
        # Tried on 386 files of public repositories: it finds all that expand to a robot, and no others.
        if self.root == "sdf":
            return True
        if self.root in _MJCF:
            return self.root == "mujoco" and not self.children.isdisjoint({"worldbody", "include"})
        names = self.children - _SEMANTICS
        parts = {name for name in names if name.removeprefix("xacro:") not in _DEFINITIONS}
        assembles = "xacro:include" in names and "xacro:macro" not in names
        return self.root == "robot" and "name" in self.attributes and (assembles or not parts <= _SHARED)


def _refuse_doctype(*_: object) -> None:
    raise expat.ExpatError("the document has a DOCTYPE")


Role = Literal["robot", "part", "either", "companion"]
"""Whether a file is checked as a robot, as a part of others, as a part if it is no robot by itself, or as SRDF."""
_FIND = lazy_pattern(r"\$\(\s*find\s+(?P<package>[\w.-]+)\s*\)/*")
_PACKAGE = lazy_pattern(r"package://(?P<package>[\w.-]+)/*")
_DIRNAME = lazy_pattern(r"\$\(\s*dirname\s*\)/*")
_SUBSTITUTION = lazy_pattern(r"\$\([^)]*\)|\$\{[^}]*\}")
_WILD = lazy_pattern(r"[*?[]")
# Each distinct address with expressions is compared with all files.
_LONGEST = 4096
"""Characters of a pattern, as long as a path may be: an expression of a million takes seconds to compile."""
_MOST_PATTERNS = 200
_MOST_AROUND = 3
"""The most folders around that of an included file of MJCF in which the main file may lie."""
_MOST_INCLUDED = 1000
"""The most files that the includes of one file lead to, and that one file is asked for."""


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
            plain = path.lower().endswith(".urdf") and not path.lower().endswith(XACRO)
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
            asked = self.outline(path, beside).includes[:_MOST_INCLUDED]
            there = (self._target(each.text, path) for each in asked if len(each.text) <= _LONGEST)
            self._targets[path] = tuple(dict.fromkeys(map(os.path.realpath, filter(None, there))))
        return self._targets[path]

    def _target(self, uri: str, path: str) -> Path | None:
        """Return the file that is there for an address in a file; None where its address does not tell."""
        address = self._address(uri, path)
        if address.folder is None or not address.is_literal:
            return None
        folders = (address.folder, *self._folders_around(path))
        return next(filter(None, (self._existing(folder / address.rest) for folder in folders)), None)

    def _folders_around(self, path: str) -> tuple[Path, ...]:
        """Return folders in which the main file of one of MJCF may lie: what parts include is meant from there."""
        return tuple(islice(Path(path).parent.parents, _MOST_AROUND)) if self.outline(path).root in _MJCF else ()

    def _existing(self, path: Path) -> Path | None:
        """Return a file that is there, or that the build of its package will put there; None for others."""
        return path if os.path.isfile(path) else self.search.source_of(path)  # noqa: PTH113 - is_file raises for a long name

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
        paths = {each: os.path.realpath(each) for each in files}  # several links may lead to one file
        known = {path: name for name, path in paths.items()}
        for path, name in known.items():
            self.outline(path, name)  # the name decides whether a link is followed
        named = self._named_by_expressions(known)
        roots = self._roots(list(known))
        included = {target for path in known for target in self.included(path) if target != path}

        def role(path: str) -> Role:
            if _is_semantic(path):
                outline = self.outline(path)
                return "companion" if path not in included and (outline.is_robot or outline.has_semantics) else "part"
            return "part" if path not in roots else "either" if path in named else "robot"

        return {name: role(path) for name, path in paths.items()}

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
