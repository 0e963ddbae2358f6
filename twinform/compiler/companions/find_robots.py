"""Which robots a companion file is for, and which SRDF files lie beside it, as far as files say so."""

import os
import re
from collections.abc import Callable, Iterable, Iterator
from itertools import islice, takewhile
from pathlib import Path
from typing import Literal, NamedTuple, cast

from twinform.compiler.companions.yaml_leaves import read_yaml
from twinform.compiler.input.include_graph import IncludeGraph
from twinform.compiler.input.load_options import LoadOptions
from twinform.compiler.input.xacro_needs import launch_files_of
from twinform.compiler.resolve_uris import SearchPath, UriError
from twinform.file_access import PACKAGE, find_root, has_any, own_folder, package_around, read_regular, walk_folders

MOST_ROBOTS = 12
"""So many robots are read for a file that may be for any of them."""
_MOST_FOLDERS = 2000
_MOST_FILES = 500
_HEAD = 2**14
_LARGEST = 2**22
_ROOT_NAME = re.compile(rb"<robot\b[^>]*?\sname\s*=\s*[\"']([^\"'$]*)[\"']")
_FILE_NAME = re.compile(r"[\w.-]+\.(?:urdf|xacro|srdf|ya?ml)\b")
_ASSISTANT = ".setup_assistant"
"""What MoveIt's Setup Assistant writes into its package, YAML that names the robot."""
SRDF = (".srdf", ".srdf.xacro")


class Candidates(NamedTuple):
    """The robots that a file may be for, and what says so: a name in a file, their package, or that they are near."""

    robots: tuple[Path, ...]
    by: Literal["name", "package", "place"]


def find_robots(path: Path, data: bytes, load_options: LoadOptions) -> Candidates:
    """Find the robots that a file may be for, by the first of these that says so.

    The user; the name in an SRDF file; the package, if it has one robot; the Setup Assistant; a launch file that names
    one together with the file; the package; a package whose name begins alike, such as `arm_description` for
    `arm_moveit_config`; and what else lies in the repository.
    """
    search = load_options.search
    if load_options.robot:
        return Candidates((Path(load_options.robot),), "name")
    package = package_around(path)
    known = robots_around(path, search)
    name = _root_name(data) if is_semantic(path) else ""
    alike = [each for each in known if name and _name_of(each, search) == name]
    if alike:
        return Candidates(_nearest(alike, package).robots, "name")
    own = [each for each in known if package is not None and package_around(each) == package]
    if len(own) == 1:  # it has the `<ros2_control>` that the one of the Setup Assistant lacks
        return Candidates((own[0],), "package")
    chosen = _of_setup_assistant(package, search, path) if package is not None else None
    if chosen is not None:
        return Candidates((chosen,), "name")
    near = _nearest(known, package)
    if len(near.robots) > 1:
        launched = _launched(path, known, search)
        if len(launched) == 1:
            return Candidates(launched, "name")
    return near


def is_semantic(path: Path) -> bool:
    """Whether a file is SRDF, by its name."""
    return path.name.lower().endswith(SRDF)


def robots_around(path: Path, search: SearchPath) -> tuple[Path, ...]:
    """Return all robots in the repository of a file, or in the folder that was asked for."""
    root = _root(path, search)
    return search.index.robots.get(root, lambda: tuple(_robots_below(root, search)))


def semantics_around(path: Path, search: SearchPath) -> tuple[Path, ...]:
    """Return the SRDF files in the package of a file, or else in all of its repository; parts of others left out."""
    for top in (package_around(path) or own_folder(path), _root(path, search)):
        found = search.index.robots.get(top / _ASSISTANT, lambda top=top: tuple(_semantics_below(top, search)))
        if found:
            return found[:MOST_ROBOTS]
    return ()


def files_around(path: Path, search: SearchPath, kind: Callable[[Path], bool]) -> Iterator[Path]:
    """Yield the files of a kind in the repository of a file, or in the folder that was asked for."""
    return _files_below(_root(path, search), kind)


def _root(path: Path, search: SearchPath) -> Path:
    asked = (each.absolute() for each in search.asked if own_folder(path).is_relative_to(each.absolute()))
    root = min((find_root(path), *asked), key=lambda each: len(each.parts))
    # packages lie beside each other in a workspace without a repository
    around = search.surroundings(path).neighbors
    return around if around is not None and has_any(root, PACKAGE) else root


def _robots_below(root: Path, search: SearchPath) -> Iterator[Path]:
    files = [str(each) for each in _files_below(root, _may_be_robot)]
    roles = IncludeGraph(search).roles(files)
    yield from (Path(file) for file in files if roles[file] == "robot" and _is_robot(Path(file), root, search))


def _is_robot(file: Path, root: Path, search: SearchPath) -> bool:
    return b"<robot" in _head(file, root / "any", search)


def _semantics_below(top: Path, search: SearchPath) -> Iterator[Path]:
    files = [os.path.realpath(each) for each in _files_below(top, is_semantic)]
    graph = IncludeGraph(search)
    included = {target for each in files for target in graph.included(each)}
    yield from (Path(each) for each in files if each not in included)


def _may_be_robot(file: Path) -> bool:
    return file.name.lower().endswith((".urdf", ".xacro")) and not is_semantic(file)


def _files_below(root: Path, kind: Callable[[Path], bool]) -> Iterator[Path]:
    return islice(_all_below(root, kind), _MOST_FILES)


def _all_below(root: Path, kind: Callable[[Path], bool]) -> Iterator[Path]:
    for place, names in islice(walk_folders(root), _MOST_FOLDERS):
        files = (Path(place, name) for name in sorted(names) if not name.startswith("."))
        yield from filter(kind, files)


def _head(file: Path, beside: Path, search: SearchPath) -> bytes:
    try:
        return search.readable(beside).read(file, _HEAD)
    except (OSError, ValueError):
        return b""


def _root_name(data: bytes) -> str:
    """Return the name of the robot in a text; empty if it is made by an expression."""
    found = _ROOT_NAME.search(data[:_HEAD])
    return found[1].decode(errors="replace") if found else ""


def _of_setup_assistant(package: Path, search: SearchPath, path: Path) -> Path | None:
    file = package / _ASSISTANT
    try:
        # It is hidden, and what lies in a folder that may be read; a link of this name could lead anywhere.
        search.readable(path).require(package)
        if file.is_symlink():
            return None
        leaves = read_yaml(read_regular(file, _HEAD)[:_HEAD]).leaves
    except (OSError, ValueError):
        return None
    values = {"/".join(step.text for step in leaf.path[-2:]): leaf.value.text for leaf in leaves}
    name, place = values.get("URDF/package"), values.get("URDF/relative_path")
    try:
        found = search.find(f"package://{name}/{place}", path) if name and place else None
    except UriError:
        return None
    return found if found is not None and found.is_file() else None


def _name_of(robot: Path, search: SearchPath) -> object:
    return search.index.parts.get(("name", robot), lambda: _root_name(_head(robot, robot, search)))


def _launched(path: Path, known: Iterable[Path], search: SearchPath) -> tuple[Path, ...]:
    """Return the robots whose file names stand in a launch file together with that of the file."""
    named = [names for names in _named_in_launch_files(path, search) if path.name in names]
    return tuple(each for each in known if any(each.name in names for names in named))


def _named_in_launch_files(path: Path, search: SearchPath) -> tuple[frozenset[str], ...]:
    """Return the names of files in each launch file beside a file; they are kept for others in its folder."""

    def read() -> object:
        texts = launch_files_of(path, search.readable(path))
        return tuple(frozenset(_FILE_NAME.findall(text)) for _, text in texts)

    return cast("tuple[frozenset[str], ...]", search.index.parts.get(("launch", path.parent), read))


def _nearest(robots: Iterable[Path], package: Path | None) -> Candidates:
    """Return the robots of a package, or of those whose names begin most like its name; all where none does."""
    alike = {each: 0 if package is None else _count_alike(package, each) for each in robots}
    most = max(alike.values(), default=0)
    return Candidates(tuple(each for each in alike if alike[each] == most), "package" if most else "place")


def _count_alike(package: Path, robot: Path) -> int:
    """Count the words with which the names of two packages begin; the package itself is most like it."""
    other = package_around(robot)
    if other is None or other == package:
        return 0 if other is None else len(str(package))
    words = zip(package.name.split("_"), other.name.split("_"), strict=False)
    return sum(1 for _ in takewhile(lambda pair: pair[0] == pair[1], words))
