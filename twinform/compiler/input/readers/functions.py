"""Writes generated readers: which functions there are, and what is in each, from the facts and the IR's classes."""

import re
from collections.abc import Iterator
from dataclasses import MISSING, dataclass, field
from typing import Any

from twinform.compiler.input.readers import templates, values
from twinform.compiler.input.readers.branches import (
    Branch,
    chain,
    guard,
    indented,
    merged,
    set_of,
    store,
    value_conditions,
)
from twinform.ir import Document, Model, Node
from twinform.ir.record import fields_of
from twinform.ir.tree import classes_in
from twinform.schemas import Fact, Table, Version, parse_version

_HUMP = re.compile(r"(?<=[a-z])(?=[A-Z])")
_FORMAT = "format"


@dataclass(frozen=True, slots=True)
class Part:
    """An element that makes a node of a class or, where `at` is its path from the element of the node, fills one."""

    fact: Fact
    path: str
    node: type[Node]
    at: str = ""
    kind: str | None = None

    @property
    def function(self) -> str:
        """The name of its function."""
        return f"{'fill' if self.at else 'read'}_{self.path.replace('/', '_')}"

    @property
    def at_argument(self) -> str:
        """The argument of a call for `at`."""
        return f", {self.at!r}" if self.at else ""

    def is_like(self, other: "Part") -> bool:
        """Whether one function does for both."""
        mine, theirs = (self.node, self.at, self.kind), (other.node, other.at, other.kind)
        return mine == theirs and self.fact.rows == other.fact.rows and self.fact.type == other.fact.type


@dataclass(slots=True)
class ModuleWriter:
    """Writes the module of one format, from the root's function to those that it calls."""

    facts: Table
    parts: list[Part] = field(default_factory=list[Part])

    @property
    def versions(self) -> tuple[Version, ...]:
        """Those of the format."""
        return tuple(map(parse_version, self.facts.versions))

    def text(self) -> str:
        """The module, not yet formatted."""
        root = self.facts.definitions[self.facts.root]
        self.part(Part(root, root.name, Document if self.facts.format == "sdf" else Model))
        functions = [FunctionWriter(self, part).text() for part in self.parts]  # grows while it is walked
        text = "\n\n".join(functions)
        names, called = set(re.findall(r"\w+", text)), set(re.findall(r"\b(\w++)(?:\.get)?\(", text))
        nodes = {maker_name(each): each.__name__ for each in _classes(self.parts)}
        makers = sorted(name for name in nodes if f"make_{name}" in names or nodes[name] == self.parts[0].node.__name__)
        return templates.MODULE.format(
            format=self.facts.format.upper(),
            parsers=", ".join(sorted(called.intersection(values.__all__) - {"text_of"})),  # which is a local
            classes=", ".join(sorted({nodes[name] for name in makers} | (names & {"Format"}))),
            makers="\n".join(templates.MAKER.format(name=name, node=nodes[name]) for name in makers),
            functions=text,
        )

    def part(self, part: Part) -> Part:
        """The part itself, or one like it that is written already."""
        for known in self.parts:
            if known.is_like(part):
                return known
        if any(known.function == part.function for known in self.parts):
            raise ValueError(f"two functions would be called {part.function}")
        self.parts.append(part)
        return part


def maker_name(node: type[Node]) -> str:
    """How what makes nodes of a class is called, behind `make_`."""
    return _HUMP.sub("_", node.__name__).lower()


def _classes(parts: list[Part]) -> set[type[Node]]:
    found = {part.node for part in parts}
    return found | {inner for node in found for name in fields_of(node) for inner in classes_in(node, name)}


@dataclass(slots=True)
class FunctionWriter:
    """Writes the function of one part."""

    module: ModuleWriter
    part: Part

    def text(self) -> str:
        """The function.

        Raises:
            ValueError: a row says something that no reader can do, such as to fill a field that there is not.
        """
        part = self.part
        for row in () if part.at else self._placed(part.fact):
            self._require_field(row)
        # Values go into a dict, which a part that is unusual is added to. As local variables they
        # would make a node in 0.9 instead of 1.2 us, but what the schema reader adds would have to
        # be merged at the end.
        steps = [self._attributes(), self._missing_attributes(), self._text(), self._children()]
        if not part.at:
            steps += self._finish()
        return (templates.FILL if part.at else templates.READ).format(
            function=part.function,
            node=part.node.__name__,
            path=part.path,
            constants=self._constants(),
            body=indented("".join(filter(None, steps)).replace("\n\n", "\n")),
        )

    def _format(self, template: str, **values: Any) -> str:
        return template.format(**{"path": self.part.path, "at": self.part.at_argument, **values})

    def _constants(self) -> str:
        if self.part.node is Document:
            return f", {_FORMAT!r}: Format.{self.module.facts.format.upper()}"
        return f", 'kind': {self.part.kind!r}" if self.part.kind else ""

    def _versions(self, row: Fact) -> frozenset[Version]:
        return frozenset(version for version in self.module.versions if row.exists_in(version))

    # attributes

    def _attributes(self) -> str:
        branches = merged(branch for row in self.part.fact.attributes for branch in self._attribute(row))
        if not branches:
            return self._format(templates.NO_ATTRIBUTES)
        text = chain(branches, self.module.versions).replace("\n", "\n    ")
        return self._format(templates.ATTRIBUTES, branches=text)

    def _attribute(self, row: Fact) -> Iterator[Branch]:
        if not _is_usual_value(row):
            return
        conditions, value = value_conditions(row, self.module.facts.format, "text", "text")
        body = store(row, "element", value)
        yield Branch((f"name == {row.name[1:]!r}", *conditions), body, self._versions(row))

    def _missing_attributes(self) -> str:
        asked = [row for row in self.part.fact.attributes if row.required or row.expected]
        conditions = dict.fromkeys(map(self._is_missing, asked))
        return self._format(templates.MISSING_ATTRIBUTES, condition=" or ".join(conditions)) if asked else ""

    def _is_missing(self, row: Fact) -> str:
        if row.place and "." not in row.place and not self.part.at:
            return f"{row.place!r} not in node"
        return f"element.get({row.name[1:]!r}) is None"

    # text

    def _text(self) -> str:
        match self.part.fact.type:
            case None:
                return self._format(templates.FREE_TEXT if self.part.fact.any else templates.NO_TEXT)
            case "pose":
                return self._format(templates.POSE)
            case other:
                raise ValueError(f"{self.part.path}: a node with a text of the type {other}")

    # children

    def _children(self) -> str:
        fact = self.part.fact
        if fact.any:
            if fact.children or not fact.place or self.part.at:
                raise ValueError(f"{self.part.path}: free content beside known children, or without a field")
            return self._format(templates.CONTENT, field=fact.place)
        if not fact.children:
            return self._format(templates.NO_CHILDREN)
        branches = [branch for rows in _by_name(fact.children) for branch in self._child_branches(rows)]
        if not branches:
            raise ValueError(f"{self.part.path}: no child has a field")
        text = chain(branches, self.module.versions).replace("\n", "\n    ")
        text_of = templates.TEXT_OF if "text_of(" in text else ""
        return text_of + self._format(templates.CHILDREN, branches=text) + self._missing_children()

    def _missing_children(self) -> str:
        needed = dict.fromkeys(row.name for row in self.part.fact.children if row.required)
        conditions = [f"{name!r} not in counts" for name in needed]
        if any(row.kind for row in self.part.fact.children):
            conditions.append("len(counts) > 1")
        return self._format(templates.MISSING_CHILDREN, condition=" or ".join(conditions)) if conditions else ""

    def _child_branches(self, rows: list[Fact]) -> list[Branch]:
        """The branches of one name."""
        if all(row.type is None and row.place for row in rows):
            return self._node_branches(rows)
        return merged(branch for row in rows for branch in self._leaf(row))

    def _leaf(self, row: Fact) -> Iterator[Branch]:
        if not _is_usual_value(row) or row.type is None:
            return
        text = "only_text(child)" if row.attributes else "text_of(child)"
        conditions, value = value_conditions(row, self.module.facts.format, text, f"stripped({text})")
        yield Branch((*_tag(row), *conditions), store(row, "child", value), self._versions(row))

    def _node_branches(self, rows: list[Fact]) -> list[Branch]:
        """Where a version has none of the rows, the last is the one to read it by, after a finding."""
        branches = merged(self._node_branch(row) for row in rows)
        covered = frozenset[Version]().union(*(branch.versions for branch in branches))
        others = [version for version in self.module.versions if version not in covered]
        if others:
            last = branches[-1]
            note = self._format(templates.OTHER_VERSION, guard=guard(others, self.module.versions))
            branches[-1] = Branch(last.conditions, note.lstrip("\n") + last.body, last.versions.union(others))
        return branches

    def _node_branch(self, row: Fact) -> Branch:
        if row.deprecated or row.dialect or row.aside:
            raise ValueError(f"{self.part.path}/{row.name}: a node with a finding of its own")
        body = self._fill_from(row) if row.place == "." else self._read_from(row)
        conditions = _tag(row)
        if row.kind:
            conditions = (*conditions, f"{row.place!r} not in node")
        elif row.place == ".":  # where nothing is in it, it is kept as it is
            conditions = (*conditions, "child.keys()" if self._fact(row).attributes else "len(child)")
        return Branch(conditions, body.strip("\n"), self._versions(row))

    def _fill_from(self, row: Fact) -> str:
        at = "/".join(filter(None, (self.part.at, row.name)))
        part = self.module.part(Part(self._fact(row), self._path(row), self.part.node, at))
        return templates.FILL_FROM.format(function=part.function)

    def _read_from(self, row: Fact) -> str:
        outer, _, name = str(row.place).rpartition(".")
        holder = self._inner(outer) if outer else self.part.node
        (node,) = (each for each in classes_in(holder, name) if not row.kind or _kind(each) == row.kind)
        part = self.module.part(Part(self._fact(row), self._path(row), node, kind=row.kind))
        return self._format(
            _template_of(row),
            function=part.function,
            above="node['source']" if self.part.at else "source",
            step="/".join(filter(None, (self.part.at, row.name))),
            key=_key(row, part.fact),
            field=name,
            outer=outer,
            maker=maker_name(node),
        )

    def _fact(self, row: Fact) -> Fact:
        return self.module.facts.resolve(row)

    def _path(self, row: Fact) -> str:
        return row.reference or f"{self.part.path}/{row.name}"

    # the end

    def _finish(self) -> Iterator[str]:
        rows = list(self._placed(self.part.fact))
        for name in dict.fromkeys(outer for row in rows if (outer := str(row.place).rpartition(".")[0])):
            yield self._format(templates.MAKE_INNER, field=name, maker=maker_name(self._inner(name)))
        for name in dict.fromkeys(str(row.place) for row in rows if row.fills_tuple):
            yield self._format(templates.MAKE_TUPLE, field=name)
        yield self._format(templates.MAKE_TUPLE, field="opaque")
        conditions = list(self._broken())
        if conditions:
            yield self._format(templates.BREAK, condition=" or ".join(conditions))

    def _require_field(self, row: Fact) -> None:
        place = str(row.place)
        holder = Document if place.startswith("/") else self.part.node
        for step in place.removeprefix("/").split("."):
            if step not in fields_of(holder):
                raise ValueError(f"{self.part.path}/{row.name}: {holder.__name__} has no field {step!r}")
            holder = next(iter(classes_in(holder, step)), holder)

    def _inner(self, field: str) -> type[Node]:
        """The class of the node in a field, which has no element of its own."""
        (node,) = classes_in(self.part.node, field)
        return node

    def _placed(self, fact: Fact) -> Iterator[Fact]:
        """The rows that fill fields of the node, also those of containers that make none."""
        for row in fact.rows:
            if row.place == "." and row.type is None:
                yield from self._placed(self._fact(row))
            elif row.place:
                yield row

    def _broken(self) -> Iterator[str]:
        """The conditions under which a node lacks what its class needs."""
        for name, each in fields_of(self.part.node).items():
            if each.default is MISSING and name != _FORMAT:
                listed = getattr(each.type, "__args__", ())
                yield f"node.get({name!r}) not in {set_of(listed)}" if listed else f"{name!r} not in node"


def _is_usual_value(row: Fact) -> bool:
    place = row.place
    return bool(place) and not str(place).startswith("/") and not (row.dialect or row.deprecated or row.aside)


def _tag(row: Fact) -> tuple[str, ...]:
    name = f"tag == {row.name!r}"
    return (name,) if row.repeats else (name, "place == 1")


def _kind(node: type[Node]) -> object:
    return fields_of(node)["kind"].default


def _key(row: Fact, fact: Fact) -> str:
    own = ["child.get('name')"] if any(each.name == "@name" for each in fact.rows) else []
    return " or ".join([*own, "place"] if row.repeats else [*own, "None"])


def _template_of(row: Fact) -> str:
    if row.kind:
        return templates.SET_KIND
    if row.fills_tuple:
        return templates.APPEND_NODE
    return templates.SET_INNER_NODE if "." in str(row.place) else templates.SET_NODE


def _by_name(rows: list[Fact]) -> Iterator[list[Fact]]:
    """Rows of one name together, in the order in which the names come."""
    for name in dict.fromkeys(row.name for row in rows):
        yield [row for row in rows if row.name == name]
