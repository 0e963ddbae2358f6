"""YAML of companion files: its values with their places, in a time that is linear in the size of the file.

No tag makes anything, an alias is followed only as long as there are not too many values, and comments are kept apart.
"""

import re
from collections import Counter
from collections.abc import Iterator
from dataclasses import field
from typing import NamedTuple, cast

import yaml

from twinform.compiler.companions.name_places import Leaf, Step, telling_keys
from twinform.dataclass import dataclass
from twinform.diagnostics import Span
from twinform.diagnostics.suppressions import Suppressions, is_meant, parse_suppressions
from twinform.text import Lines, SourceText, UndecodableError

LARGEST = 2**19
"""In bytes: libyaml takes a second for as many. The largest real file of parameters that we know has 40,000."""
_MOST_LEAVES = 100_000
_DEEPEST = 40
"""The most steps to a value: a file may have an alias inside of what it stands for."""
_PARAMETERS = "ros__parameters"
_LOADER = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
_KEY = re.compile(rb"(?<![\w.-])(?:%s)[\"']?[ \t]*:" % b"|".join(map(re.escape, (k.encode() for k in telling_keys()))))
_SURE = re.compile(
    rb"(?<![\w.-])(?:ros__parameters|kinematics_solver|joint_limits|robot_base_frame|controller_names)[ \t]*:"
)
_BEFORE = re.compile(r"\s*(?:[&!]\S*\s+)*")
"""What stands before the text of a scalar: its anchor and tag."""
_TEMPLATE = re.compile(rb"\{\{|\{%")


class YamlError(ValueError):
    """A text is no YAML, or has too many values; `line` and `column` count from 1."""

    def __init__(self, message: str, line: int = 1, column: int = 0) -> None:
        super().__init__(message)
        self.line, self.column = line, column


class RepeatedKey(NamedTuple):
    """A key that its mapping has before, and where that stands."""

    text: str
    place: Span
    first: Span


@dataclass(frozen=True, slots=True)
class YamlText:
    """The values of a YAML file; `has_own_tags` is true of data with units, which xacro reads and ROS does not."""

    text: str
    leaves: tuple[Leaf[Span], ...]
    repeated: tuple[RepeatedKey, ...] = ()
    has_own_tags: bool = False
    scalars: tuple[Span, ...] = field(default=(), repr=False)

    def comments(self) -> Iterator[tuple[str, int, int, int]]:
        """Yield each comment that is for us, its line, and the lines that it is about.

        Behind something it is about its line, and otherwise about the next line with all that is indented below it.
        """
        lines = self.text.splitlines()
        counted = Lines(self.text)
        inside = iter(sorted(self.scalars))
        scalar = next(inside, None)
        for found in re.finditer(r"(?:^|(?<=[ \t]))#(?P<text>[^\r\n]*)", self.text, re.MULTILINE):
            while scalar is not None and scalar.end <= found.start():
                scalar = next(inside, None)
            if (scalar is not None and scalar.start <= found.start()) or not is_meant(found["text"]):
                continue
            line = counted.place(found.start()).line
            first, last = _about(lines, line)
            yield found["text"], line, first, last

    def suppressions(self) -> Suppressions:
        """Return what the comments of the file allow."""
        return parse_suppressions(self.comments())


def _about(lines: list[str], line: int) -> tuple[int, int]:
    """Return the first and last line that a comment is about; zeros where none follows."""
    if lines[line - 1].lstrip()[:1] != "#":
        return line, line
    first = next((n for n in range(line, len(lines)) if lines[n].strip() and lines[n].lstrip()[0] != "#"), None)
    if first is None:
        return 0, 0
    depth = _indent(lines[first])
    last = first
    while last + 1 < len(lines) and lines[last + 1].strip() and _indent(lines[last + 1]) > depth:
        last += 1
    return first + 1, last + 1


def _indent(line: str) -> int:
    return len(line) - len(line.lstrip())


def may_name_parts(data: bytes) -> bool:
    """Whether a YAML file may have names of a robot's parts, by its keys; templates of it have not."""
    return len(data) <= LARGEST and _KEY.search(data) is not None and not _TEMPLATE.search(data)


def is_surely_meant(data: bytes) -> bool:
    """Whether a file that is no YAML was meant to be parameters of ROS."""
    return _SURE.search(data) is not None


def read_yaml(data: bytes) -> YamlText:
    """Read the values of a file.

    Raises:
        YamlError: it is no YAML, or has too many values.
    """
    try:
        text = SourceText.of(data).text
    except UndecodableError as error:
        raise YamlError(f"the file is not in UTF-8: {error}") from error
    try:
        documents = list(yaml.compose_all(text, Loader=_LOADER))
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        place = (mark.line + 1, mark.column + 1) if mark else (1, 0)
        raise YamlError(f"this is no YAML: {error.problem or error.context}", *place) from error
    except (yaml.YAMLError, UnicodeError) as error:
        raise YamlError(f"this is no YAML: {' '.join(str(error).split())[:200]}") from error
    except RecursionError as error:
        raise YamlError("this YAML is nested too deeply") from error
    return _Reading(text).run(documents)


class _Reading:
    """A walk through the nodes of a file."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.leaves: list[Leaf[Span]] = []
        self.repeated: dict[Span, RepeatedKey] = {}
        self.scalars: dict[Span, None] = {}
        self.own_tags = False

    def run(self, documents: list[yaml.Node]) -> YamlText:
        pending: list[tuple[yaml.Node, tuple[Step[Span], ...], tuple[str, ...]]]
        pending = [(each, (), ()) for each in reversed(documents)]
        while pending:
            node, path, beside = pending.pop()
            if len(self.leaves) + len(pending) > _MOST_LEAVES or len(path) > _DEEPEST:
                raise YamlError("aliases make more values of this file than any robot needs")
            self.own_tags |= node.tag.startswith("!")
            if isinstance(node, yaml.ScalarNode):
                self.leaves.append(Leaf(path, self._step(node), beside))
            elif isinstance(node, yaml.SequenceNode):
                items = cast("list[yaml.Node]", node.value)
                # an item counts as a step to bound the depth of lists in each other, which have no keys
                pending += [
                    (each, path if not _is_list(each) else (*path, Step("", _span(node))), beside)
                    for each in reversed(items)
                ]
            elif isinstance(node, yaml.MappingNode):
                pending += reversed(list(self._inside(node, path)))
        return YamlText(
            self.text, tuple(self.leaves), tuple(self.repeated.values()), self.own_tags, tuple(self.scalars)
        )

    def _inside(
        self, node: yaml.MappingNode, path: tuple[Step[Span], ...]
    ) -> Iterator[tuple[yaml.Node, tuple[Step[Span], ...], tuple[str, ...]]]:
        pairs = cast("list[tuple[yaml.Node, yaml.Node]]", node.value)
        keys = [(self._step(key), value) for key, value in pairs if isinstance(key, yaml.ScalarNode)]
        beside = tuple(key.text for key, _ in keys)
        # rcl joins the mappings of a node that stands there twice
        self._note_repeated([key for key, value in keys if not isinstance(value, yaml.MappingNode)], Counter(beside))
        for key, value in keys:
            yield value, path if key.text == "<<" else (*path, *self._split(key, path)), beside

    def _note_repeated(self, keys: list[Step[Span]], counts: Counter[str]) -> None:
        first: dict[str, Span] = {}
        for key in keys:
            if counts[key.text] > 1 and key.text != "<<" and first.setdefault(key.text, key.place) != key.place:
                self.repeated[key.place] = RepeatedKey(key.text, key.place, first[key.text])

    def _split(self, key: Step[Span], path: tuple[Step[Span], ...]) -> Iterator[Step[Span]]:
        """Split a parameter `gains.joint_1.p` into the steps that it stands for."""
        if "." not in key.text or key.place.of(self.text) != key.text or _PARAMETERS not in {e.text for e in path}:
            yield key
            return
        start = key.place.start
        for part in key.text.split("."):
            yield Step(part, Span(start, start + len(part)))
            start += len(part) + 1

    def _step(self, node: yaml.ScalarNode) -> Step[Span]:
        """Return a scalar and the place of its text, without quotes."""
        span = _span(node)
        self.scalars[span] = None
        written = span.of(self.text)
        before = _BEFORE.match(written)
        start = span.start + (before.end() if before else 0)
        end = span.end
        if node.style in {"'", '"'}:
            start, end = start + 1, end - 1
        value = str(node.value)
        # libyaml ends a plain scalar where the next token begins
        return Step(
            value, Span(start, start + len(value) if self.text.startswith(value, start) and not node.style else end)
        )


def _span(node: yaml.Node) -> Span:
    return Span(node.start_mark.index, node.end_mark.index)


def _is_list(node: yaml.Node) -> bool:
    return isinstance(node, yaml.SequenceNode)
