"""Renames that follow into companion files: only the bytes of the names change."""

import os
import re
from collections.abc import Collection, Iterable, Iterator, Mapping
from pathlib import Path
from typing import NamedTuple
from xml.sax.saxutils import escape

import yaml

from twinform.compiler.companions.check_companion import is_companion, is_yaml, may_be_companion
from twinform.compiler.companions.find_robots import files_around, find_robots, is_semantic
from twinform.compiler.companions.name_places import PART_OF, Leaf, Mention, Step, mentions
from twinform.compiler.companions.robot_parts import read_parts
from twinform.compiler.companions.yaml_leaves import YamlError, read_yaml
from twinform.compiler.input.include_graph import IncludeGraph
from twinform.compiler.input.load_options import LoadOptions
from twinform.diagnostics import Span, TextEdit
from twinform.ir import Document
from twinform.passes import Pipeline
from twinform.passes.structure.prefix_names import PrefixNames
from twinform.passes.structure.rename import Rename
from twinform.passes.structure.rename_parts import part_names
from twinform.text import ElementSpan, SourceText, UndecodableError, UnplacedError, apply, spans

_PLAIN = re.compile(r"[A-Za-z_][\w./-]*")


class Renames(NamedTuple):
    """The new names of links and joints by their old ones."""

    links: Mapping[str, str]
    joints: Mapping[str, str]

    def new(self, mention: Mention[Span]) -> str | None:
        """Return the new name of what a mention means; None where it stays."""
        part = PART_OF.get(mention.kind)
        return (self.links if part == "link" else self.joints).get(_bare_name(mention)) if part else None


class FollowedFile(NamedTuple):
    """A companion file before and after a rename, how many names followed, and those that could not."""

    path: Path
    before: bytes
    after: bytes
    changed: int = 0
    left: tuple[str, ...] = ()


def renames_of(document: Document, passes: Pipeline) -> Renames:
    """Return the names that passes give the links and joints of a document."""
    found: dict[str, dict[str, str]] = {"link": {}, "joint": {}}
    for part, name in part_names(document):
        if part in found:
            new = name
            for step in passes:
                new = step.new_name(part, new) if isinstance(step, Rename | PrefixNames) else new
            if new != name:
                found[part][name] = new
    return Renames(found["link"], found["joint"])


def follow_renames(robots: Collection[Path], renames: Renames, load_options: LoadOptions) -> Iterator[FollowedFile]:
    """Yield the companion files of robots that change with the names of their parts.

    A file that may be for another robot as well follows only if that has none of the names.
    """
    if not (renames.links or renames.joints):
        return
    known = {each.resolve() for each in robots}
    around = (each for robot in robots for each in files_around(robot, load_options.search, may_be_companion))
    wanted: dict[Path, None] = {}
    for path in dict.fromkeys(around):
        data = _content(path, load_options)
        if is_companion(path, data) and _is_for(path, data, known, renames, load_options):
            wanted.update(dict.fromkeys(with_included(path, load_options)))
    for path in wanted:
        followed = follow_in(path, _content(path, load_options), renames)
        if followed.changed or followed.left:
            yield followed


def with_included(path: Path, load_options: LoadOptions) -> Iterator[Path]:
    """Yield a companion file, and the files that SRDF includes."""
    yield path
    if is_semantic(path):
        included = {Path(file) for file, _ in IncludeGraph(load_options.search).closure(os.path.realpath(path))}
        yield from sorted(included - {Path(os.path.realpath(path))})


def _content(path: Path, load_options: LoadOptions) -> bytes:
    """Return the content of a file; nothing of one that cannot be read, or not as a whole."""
    size = load_options.limits.size
    try:
        data = load_options.search.readable(path).read(path, size)
    except (OSError, ValueError):
        return b""
    return data if len(data) <= size else b""


def _is_for(path: Path, data: bytes, known: set[Path], renames: Renames, load_options: LoadOptions) -> bool:
    robots = find_robots(path, data, load_options).robots
    graph = IncludeGraph(load_options.search)
    others = [each for each in robots if known.isdisjoint(_files_of(each, graph))]
    return len(others) < len(robots) and not any(_has_names(each, renames, load_options) for each in others)


def _files_of(robot: Path, graph: IncludeGraph) -> set[Path]:
    """Return the files that a robot is made of."""
    return {Path(file) for file, _ in graph.closure(os.path.realpath(robot))}


def _has_names(robot: Path, renames: Renames, load_options: LoadOptions) -> bool:
    parts = read_parts(robot, load_options)
    return (
        parts is None
        or any(name in parts.links for name in renames.links)
        or any(name in parts.joints for name in renames.joints)
    )


def follow_in(path: Path, data: bytes, renames: Renames) -> FollowedFile:
    """Return a companion file with new names; what cannot be changed in its text stays."""
    try:
        source = SourceText.of(data)
        found = list(mentions(leaves_in(path, data)))
    except (UndecodableError, UnplacedError, YamlError):
        return FollowedFile(path, data, data)
    edits: list[TextEdit] = []
    left: list[str] = []
    for each in found:
        new = renames.new(each)
        edit = edit_of(each, new, source.text, is_xml=not is_yaml(path)) if new is not None else None
        if edit is not None:
            edits.append(edit)
        elif new is not None:
            left.append(each.text)
    return FollowedFile(path, data, source.with_text(apply(source.text, edits)).data, len(edits), tuple(left))


def leaves_in(path: Path, data: bytes) -> Iterable[Leaf[Span]]:
    """Return the values of a companion file, with their places in its text.

    Raises:
        UndecodableError, UnplacedError, YamlError: it cannot be read.
    """
    if is_yaml(path):
        return read_yaml(data).leaves
    text = SourceText.of(data).text
    return _leaves_of_xml(spans(text), text)


def _leaves_of_xml(root: ElementSpan, text: str) -> Iterator[Leaf[Span]]:
    pending: list[tuple[ElementSpan, tuple[Step[Span], ...]]] = [(each, ()) for each in root.children]
    while pending:
        element, above = pending.pop()
        here = (*above, Step(element.name.of(text), element.name))
        for name, attribute in element.attributes.items():
            value = attribute.value
            yield Leaf((*here, Step(f"@{name}", attribute.name)), Step(value.of(text), value))
        pending += [(each, here) for each in element.children]


def edit_of(mention: Mention[Span], new: str, text: str, *, is_xml: bool) -> TextEdit | None:
    """Return the edit that gives a mention a new name; None where its text is not the name itself."""
    place = mention.place
    if place.of(text) != mention.text:
        return None
    bare = _bare_name(mention)
    start = place.end - len(bare) if mention.kind != "interface" else place.start
    span = Span(start, start + len(bare))
    if is_xml:
        return TextEdit(span, escape(new, {'"': "&quot;", "'": "&apos;"}))
    quote = text[place.start - 1 : place.start]
    if quote in {'"', "'"} and text[place.end : place.end + 1] == quote:
        return TextEdit(span, new.replace("'", "''") if quote == "'" else new.replace("\\", "\\\\").replace('"', '\\"'))
    if "." in {text[place.start - 1 : place.start], text[place.end : place.end + 1]}:
        return TextEdit(span, new) if _is_plain(new) and "." not in new else None  # a step of `gains.joint_1.p`
    if _is_plain(new):
        return TextEdit(span, new)
    whole = text[place.start : span.start] + new + text[span.end : place.end]
    return TextEdit(place, "'{}'".format(whole.replace("'", "''")))


def _bare_name(mention: Mention[Span]) -> str:
    """Return the name of the part alone: TF had a slash before frames once."""
    return mention.name.removeprefix("/")


def _is_plain(name: str) -> bool:
    """Whether a name may stand in YAML without quotes, and is read as a text then."""
    return _PLAIN.fullmatch(name) is not None and isinstance(yaml.safe_load(name), str)
