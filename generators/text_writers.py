"""Generates the writers, `schemas/generated/FORMAT_text.py`: Python source that makes the text of a document.

There is a function for each element that is a node, one for each container that is none and holds several values, and
one for each leaf with attributes. They are put together from the templates below, one for each kind of row.
"""

from collections.abc import Iterable, Iterator
from string import Template
from typing import NamedTuple

from twinform.ir.versions import parse_version
from twinform.schemas.facts import Fact, Table, makes_many, rows_to_write

_MODULE = Template('''\
"""From nodes to the text of $format: generated from the facts tables by `make generate`, not to be edited."""

from typing import Any

$imports


$functions


write_root: Write = $root

WRITERS: dict[str, Write] = {
$writers
}
''')
_IMPORT = Template("from twinform.schemas.$module import (\n$names\n)")
_TYPES = ("TextOutput", "Write")
_HELPERS = {
    "text_output": "bool_attribute bool_text in_attribute in_text pose_numbers vector3",
    "value_types": "format_number format_numbers format_value",
}
"""The functions that code calls, by their modules."""
_KINDS = Template("$name: dict[str, Write] = {\n$writers\n}\n")

_NODE = Template('''\
def $name(node: Any, out: TextOutput, indent: str) -> str:
    """`<$tag>`."""
''')
_CONTAINER = Template('''\
def $name(node: Any, indent: str) -> str:
    """`<$tag>`, of fields of the node around it."""
''')
_INNER = '    inner = indent + "  "\n'
_BEFORE_ROOT = "    attributes += out.declarations\n"
_POSE = "    body = pose_numbers(node)\n"

_IF = Template("    if (value := node.$field) is not None:\n")
_IF_INSIDE = Template("    if (holder := node.$holder) is not None and (value := holder.$field) is not None:\n")
_IF_KIND = Template("    if (value := node.$field) is not None and (write := $kinds.get(value.kind)) is not None:\n")
_EACH = Template("    for value in node.$field:\n")

_ADD_ATTRIBUTE = Template("        attributes += f' $name=\"$value\"'\n")
_ADD_LEAF = Template('        body += f"{inner}<$name>$value</$name>"\n')
_ADD_WITH_ATTRIBUTE = Template("        body += f'{inner}<$name $attribute=\"$value\"/>'\n")
_ADD_NODE = Template("        body += $write(value, out, inner)\n")
_ADD_NODE_BY_VERSION = Template("        body += ($write if out.version >= $since else $older)(value, out, inner)\n")
_ADD_CONTAINER = Template("    body += $write(node, inner)\n")
_ADD_ALL = Template("    if node.$field:\n        body += out.children(node, inner, (node.$field, $write))\n")
_ADD_ALL_IN_ORDER = Template("    body += out.children(\n        node,\n        inner,\n$groups\n    )\n")
_GROUP = Template("        (node.$field, $write),")

_UNUSUAL = Template("    if $condition:\n        return out.unusual($arguments)\n")
_END = {
    "attributes body keep": Template("""\
    if body:
        return f"{indent}<$tag{attributes}>{body}{indent}</$tag>"
    return f"{indent}<$tag{attributes}/>"
"""),
    "attributes body": Template("""\
    if body:
        return f"{indent}<$tag{attributes}>{body}{indent}</$tag>"
    return f"{indent}<$tag{attributes}/>" if attributes else ""
"""),
    "attributes keep": Template('    return f"{indent}<$tag{attributes}/>"\n'),
    "attributes": Template('    return f"{indent}<$tag{attributes}/>" if attributes else ""\n'),
    "body keep": Template('    return f"{indent}<$tag>{body}{indent}</$tag>" if body else f"{indent}<$tag/>"\n'),
    "body": Template('    return f"{indent}<$tag>{body}{indent}</$tag>" if body else ""\n'),
    "keep": Template('    return f"{indent}<$tag/>"\n'),
}
"""How functions end, by what they may write and by whether an empty element is kept."""
_END_OF_TEXT = Template("""\
    if $text is None:
        return f"{indent}<$tag{attributes}/>" if attributes else ""
    return f"{indent}<$tag{attributes}>$shown</$tag>"
""")

_SHOWN = {
    "bool": "{bool$escape(node, $quote$field$quote)}",
    "string": "{in$escape(value)}",
    "double": "{format_number(value)}",
    "vector3": "{vector3(value)}",
    **dict.fromkeys(("vector2d", "quaternion", "color", "color4"), "{format_numbers(value)}"),
}
_SHOWN_ELSE = "{format_value(value)}"


class _WriterFunction(NamedTuple):
    """A generated function: the fact that it writes, the path to it from a definition, and the element's tag.

    `keep` says that the element is kept where it is empty.
    """

    fact: Fact
    path: str
    tag: str
    keep: bool


def generate_text_writer(facts: Table) -> str:
    """The module that writes a format."""
    return _WriterGenerator(facts).module()


class _WriterGenerator:
    """Makes the module of a format; each function stands after the ones that it calls."""

    def __init__(self, facts: Table) -> None:
        self.table = facts
        self.older = {id(row): older for row, older in _changed(facts)}
        self.names: dict[tuple[int, str, bool], str] = {}
        self.alike: dict[str, str] = {}
        """The names of functions by their code: of containers that are written alike, one is enough."""
        self.pieces: list[str] = []

    def module(self) -> str:
        """The text of the module."""
        root = self.table.root
        name = self._node(_WriterFunction(self.table.definitions[root], root, root, keep=True), root)
        functions = "\n\n".join(self.pieces).rstrip()
        names = {"format": self.table.format.upper(), "imports": _imports(functions), "root": name}
        return _MODULE.substitute(names, functions=functions, writers=self._writers())

    def _writers(self) -> str:
        """The functions of the elements that have a definition, by its name."""
        found = {
            tag: name for (fact, tag, _), name in self.names.items() if id(self.table.definitions.get(tag)) == fact
        }
        return "\n".join([f'    "{tag}": {name},' for tag, name in found.items()])

    def _node(self, part: _WriterFunction, longer_path: str) -> str:
        """Return the name of the function that writes a node; `longer_path` tells two of one path apart."""
        key = id(part.fact), part.tag, part.keep
        if key not in self.names:
            name = self.names[key] = self._new_name(part.path, longer_path)
            self.names[key] = self._function(name, part.path, _NODE, part.tag, self._code_of_node(part))
        return self.names[key]

    def _container(self, row: Fact, path: str) -> str:
        """The name of the function that writes a container that is no node, or a leaf with attributes."""
        code = self._code_of_leaf(row) if row.type else self._code_of_container(row, path)
        return self._function(self._new_name(path), path, _CONTAINER, row.name, code)

    def _new_name(self, *paths: str) -> str:
        names = ["write_" + path.replace("/", "_") for path in paths]
        return next(name for name in names if name not in self.names.values())

    def _function(self, name: str, path: str, head: Template, tag: str, code: str) -> str:
        """Return the name of the function with this code, and add it if there is none."""
        initial = " = ".join(_written(code))
        code = (f'    {initial} = ""\n' if initial else "") + code
        code = (_INNER if "inner" in code else "") + code
        like = code.replace(f'"{path}"', "")
        if like not in self.alike:
            self.alike[like] = name
            self.pieces.append(head.substitute(name=name, tag=tag) + code)
        return self.alike[like]

    def _code_of_node(self, part: _WriterFunction) -> str:
        rows = self._rows(part.fact.rows)
        code = _BEFORE_ROOT if part.path == self.table.root else ""
        code += "".join([self._row(row, part.path) for row in rows if not row.kind and not makes_many(row)])
        code += self._kinds([row for row in rows if row.kind], part.path)
        code += self._all_in_order([row for row in rows if makes_many(row)], part.path)
        if part.fact.type != "pose":
            return code + _unusual(part, _written(code)) + _end_of_function(code, part.tag, keep=part.keep)
        end = _END_OF_TEXT.substitute(tag=part.tag, text="body", shown="{body}")
        return code + _POSE + _unusual(part, [*_written(code), "body"]) + end

    def _code_of_container(self, row: Fact, path: str) -> str:
        code = "".join([self._row(inner, path) for inner in self._rows(row.rows)])
        return code + _end_of_function(code, row.name, keep=False)

    def _code_of_leaf(self, row: Fact) -> str:
        code = "".join([self._row(inner, "") for inner in self._rows(row.attributes)])
        text = f"(value := node.{row.place})"
        return code + _END_OF_TEXT.substitute(tag=row.name, text=text, shown=_shown(row, "_text"))

    def _row(self, row: Fact, path: str) -> str:
        """The code for a row whose field is written once."""
        if row.is_attribute:
            return _if(row) + _ADD_ATTRIBUTE.substitute(name=row.name[1:], value=_shown(row, "_attribute"))
        if row.type is None:
            return self._row_of_container(row, path) if row.place == "." else self._row_of_node(row, path)
        if self._rows(row.attributes):
            return _ADD_CONTAINER.substitute(write=self._container(row, f"{path}/{row.name}"))
        start = _EACH.substitute(field=row.place) if row.fills_tuple else _if(row)
        return start + _ADD_LEAF.substitute(name=row.name, value=_shown(row, "_text"))

    def _row_of_container(self, row: Fact, path: str) -> str:
        rows = self._rows(row.rows)
        if len(rows) > 1 or not rows[0].is_attribute:
            return _ADD_CONTAINER.substitute(write=self._container(row, f"{path}/{row.name}"))
        value = _shown(rows[0], "_attribute")
        return _if(rows[0]) + _ADD_WITH_ATTRIBUTE.substitute(name=row.name, attribute=rows[0].name[1:], value=value)

    def _row_of_node(self, row: Fact, path: str) -> str:
        older = self.older.get(id(row))
        names = {"write": self._child(row, path, keep=False)}
        if older is None:
            return _if(row) + _ADD_NODE.substitute(names)
        names["older"] = self._child(older, path, keep=False)
        return _if(row) + _ADD_NODE_BY_VERSION.substitute(names, since=row.since)

    def _kinds(self, rows: list[Fact], path: str) -> str:
        """Return the code for rows that share a field."""
        if not rows:
            return ""
        name = f"{path}_{rows[0].place}s".replace("/", "_").upper()
        writers = [f'    "{row.kind}": {self._child(row, path, keep=True)},' for row in rows]
        self.pieces.append(_KINDS.substitute(name=name, writers="\n".join(writers)))
        return _IF_KIND.substitute(field=rows[0].place, kinds=name) + _ADD_NODE.substitute(write="write")

    def _all_in_order(self, rows: list[Fact], path: str) -> str:
        """Return the code for rows that may be repeated."""
        fields = [{"field": row.place, "write": self._child(row, path, keep=True)} for row in rows]
        if len(fields) < 2:
            return "".join([_ADD_ALL.substitute(field) for field in fields])
        return _ADD_ALL_IN_ORDER.substitute(groups="\n".join([_GROUP.substitute(field) for field in fields]))

    def _child(self, row: Fact, path: str, *, keep: bool) -> str:
        """The name of the function that writes the node of a row."""
        longer = f"{path}/{row.name}"
        path = row.name if row.reference == row.name else longer
        return self._node(_WriterFunction(self.table.resolve(row), path, row.name, keep), longer)

    def _rows(self, rows: Iterable[Fact]) -> list[Fact]:
        return rows_to_write(rows, self.table.newest)


def _imports(code: str) -> str:
    """The lines that import what some code calls."""
    called = {module: [name for name in names.split() if f"{name}(" in code] for module, names in _HELPERS.items()}
    called["text_output"] = [*_TYPES, *called["text_output"]]
    lines = {module: "\n".join([f"    {name}," for name in names]) for module, names in called.items() if names}
    return "\n".join([_IMPORT.substitute(module=module, names=names) for module, names in lines.items()])


def _changed(facts: Table) -> Iterator[tuple[Fact, Fact]]:
    """Return the rows that are written differently than in older versions, each with its older row.

    Raises:
        ValueError: the generator has no template for such a change.
    """
    for fact in _facts(facts.definitions.values()):
        newest = {row.name: row for row in rows_to_write(fact.rows, facts.newest)}
        for version in map(parse_version, facts.versions):
            for row in rows_to_write(fact.rows, version):
                if _way_of(row) == _way_of(newest[row.name]):
                    continue
                if not row.reference or not newest[row.name].reference:
                    raise ValueError(f"{fact.name}: {row.name} is written in two ways")
                yield newest[row.name], row


def _facts(rows: Iterable[Fact]) -> Iterator[Fact]:
    for row in rows:
        yield row
        yield from _facts(row.rows)


def _way_of(row: Fact) -> tuple[object, ...]:
    """Return what decides how a row is written; two containers are only equal if they are the same."""
    return row.place, row.kind, row.type, row.reference, row.fills_tuple, id(row) if row.rows else None


def _if(row: Fact) -> str:
    """Return the line that asks whether the field of a row has a value."""
    holder, _, field = (row.place or "").rpartition(".")
    return _IF_INSIDE.substitute(holder=holder, field=field) if holder else _IF.substitute(field=field)


def _shown(row: Fact, escape: str) -> str:
    """Return the code for the value of a row inside of an f-string."""
    quote = '"' if escape == "_attribute" else "'"
    return Template(_SHOWN.get(row.type or "", _SHOWN_ELSE)).substitute(escape=escape, quote=quote, field=row.place)


def _written(code: str) -> list[str]:
    """What of an element some code writes."""
    return [each for each in ("attributes", "body") if f"{each} +=" in code]


def _unusual(part: _WriterFunction, written: Iterable[str]) -> str:
    """The code for parts of a node that have no typed field, and for nodes whose place in the text is asked for."""
    content = f"node.{part.fact.place}" if part.fact.any and part.fact.place else ""
    condition = " or ".join([*[content] * bool(content), "node.opaque", "out.parts is not None"])
    arguments = ["node", f'"{part.tag}"', "indent", *(f"{each}={each}" for each in written)]
    arguments += [f"content={content}"] * bool(content) + ["keep=True"] * part.keep
    return _UNUSUAL.substitute(condition=condition, arguments=", ".join(arguments))


def _end_of_function(code: str, tag: str, *, keep: bool) -> str:
    """The end of a function."""
    return _END[" ".join([*_written(code), *["keep"] * keep])].substitute(tag=tag)
