"""Companion files in the editor: names in SRDF and YAML lead to the robot, and follow when its parts are renamed."""

import os
from collections.abc import Collection, Iterator
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

from lsprotocol import types

from twinform.compiler.companions.check_companion import is_companion, is_yaml, may_be_companion
from twinform.compiler.companions.find_robots import files_around, find_robots
from twinform.compiler.companions.follow_renames import Renames, edit_of, leaves_in, with_included
from twinform.compiler.companions.name_places import PART_OF, Mention, mentions
from twinform.compiler.companions.yaml_leaves import YamlError
from twinform.compiler.input.include_graph import IncludeGraph
from twinform.compiler.input.load_options import LoadOptions
from twinform.compiler.ros_packages import PackageIndex
from twinform.diagnostics import Span
from twinform.server.document_names import defined_anywhere, definitions_in
from twinform.server.documents import TextDocument
from twinform.server.names import Name
from twinform.server.session import Session
from twinform.text import UndecodableError, UnplacedError


class Definition(NamedTuple):
    """The part of a robot that a companion file names: its name, and the document that has it."""

    document: TextDocument
    name: Name


class CompanionEdit(NamedTuple):
    """An edit of a companion file."""

    document: TextDocument
    edit: types.TextEdit


def mention_at(document: TextDocument, offset: int) -> Mention[Span] | None:
    """Return the name of a robot's part at an offset of a companion file; None in other files."""
    if not may_be_companion(document.path) or not is_companion(document.path, document.data):
        return None
    around = (each for each in _mentions_in(document) if each.place.start <= offset <= each.place.end)
    return next((each for each in around if each.kind in PART_OF), None)


def definition_of(session: Session, document: TextDocument, mention: Mention[Span]) -> Definition | None:
    """Find the part that a companion file names, in the files of the robots that it may be for; only if it is one."""
    options = _options_of(session, document.path)
    found: dict[object, Definition] = {}
    for robot in find_robots(document.path, document.data, options).robots:
        for file in _files_of(robot, options):
            other = session.files.document(Path(file))
            for name in defined_anywhere(other, mention.name, PART_OF[mention.kind]) if other is not None else ():
                if other is not None:
                    found[file, name.span] = Definition(other, name)
    return next(iter(found.values())) if len(found) == 1 else None


def parts_of_robots(session: Session, document: TextDocument, kind: str) -> list[str]:
    """List the names of the links or joints of the robots that a companion file may be for."""
    options = _options_of(session, document.path)
    robots = find_robots(document.path, document.data, options).robots
    others = (session.files.document(Path(file)) for robot in robots for file in sorted(_files_of(robot, options)))
    names = (name for other in others if other is not None for name in definitions_in(other))
    # what an expression makes is not known here
    return list(dict.fromkeys(name.text for name in names if name.kind == kind and "$" not in name.text))


def followed_edits(session: Session, what: Collection[Definition], new: str) -> Iterator[CompanionEdit]:
    """Yield the edits by which companion files follow the new name of a part that is defined somewhere."""
    first = next(iter(what))
    kind, old = first.name.kind, first.name.text
    if kind not in {"link", "joint"} or first.document.schema.format != "urdf":
        return
    renames = Renames({old: new}, {}) if kind == "link" else Renames({}, {old: new})
    options = _options_of(session, first.document.path)
    own = {os.path.realpath(each.document.path) for each in what}
    files: dict[Path, None] = {}
    for path in files_around(first.document.path.absolute(), options.search, may_be_companion):
        document = session.files.document(path)
        if document is not None and is_companion(path, document.data) and _is_for(document, own, options):
            files.update(dict.fromkeys(with_included(path, options)))
    for document in filter(None, map(session.files.document, files)):
        for mention in _mentions_in(document) if old in document.text else ():
            is_xml = not is_yaml(document.path)
            edit = edit_of(mention, new, document.text, is_xml=is_xml) if renames.new(mention) else None
            if edit is not None:
                yield CompanionEdit(document, types.TextEdit(document.positions.range(edit.span), edit.new))


def _is_for(document: TextDocument, own: set[str], options: LoadOptions) -> bool:
    """Whether every robot that a file may be for has one of some files."""
    robots = find_robots(document.path, document.data, options).robots
    return bool(robots) and all(not own.isdisjoint(_files_of(each, options)) for each in robots)


def _files_of(robot: Path, options: LoadOptions) -> set[str]:
    return {file for file, _ in IncludeGraph(options.search).closure(os.path.realpath(robot))}


def _options_of(session: Session, path: Path) -> LoadOptions:
    """Return the options for a file, with what lies in the workspace as it is now."""
    options = session.settings(path).load_options
    return replace(options, search=replace(options.search, index=PackageIndex()))


def _mentions_in(document: TextDocument) -> list[Mention[Span]]:
    try:
        return list(mentions(leaves_in(document.path, document.data)))
    except (UndecodableError, UnplacedError, YamlError):
        return []
