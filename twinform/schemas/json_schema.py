"""Makes the JSON Schema of documents as JSON (`--to json`) from the facts tables of both formats.

A document is an object with the fields that the facts name as places in the IR. So each format has its own objects:
what it cannot express has no place in its JSON either. Beside its fields, an object may have `opaque` (parts without a
typed field), `spelling` (how values were written that have several spellings), and where parts of several kinds may
stand mixed, `order`.
"""

import json
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from itertools import groupby
from typing import Any

from twinform.schemas.facts import Fact, Table, parse_version, table
from twinform.schemas.json_values import IDENTIFIER, SHARED, value_schema
from twinform.schemas.meanings import Documentation, Path
from twinform.schemas.written_rows import repeated_fields

Json = dict[str, Any]

_TITLE = "A robot model or world of URDF or SDF, as twinform reads and writes it in JSON"
_ABOUT = (
    "Lengths are in meters, angles in radians, masses in kilograms. A field that is missing was not written; the "
    "default of the format is meant then. Arrays keep the order of the file."
)
_OPAQUE = "Parts that have no field of their own, each with where it stood."
_SPELLING = "How truth values were written, where not as true and false. One that does not fit the value is ignored."
_KINDS = "One of several kinds."
_ORDER = (
    "In which order the parts of several kinds stand in the file: the name of an array for each part. Without it they "
    "stand kind after kind. It changes nothing but the order."
)


def generate_json_schema() -> str:
    """The text of the schema."""
    definitions = dict(SHARED)
    branches = [_Format(table(name)).add_to(definitions) for name in ("urdf", "sdf")]
    schema = {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "$id": IDENTIFIER,
        "title": _TITLE,
        "description": _ABOUT,
        "oneOf": branches,
        "$defs": definitions,
    }
    return json.dumps(schema, indent=1) + "\n"


@dataclass(slots=True)
class _Object:
    """An object of the schema while it is put together; `inner` are objects in it that several rows fill.

    `keeps` is whether it may hold parts without a field.
    """

    text: str = ""
    fields: dict[str, Json] = field(default_factory=dict[str, Json])
    needed: list[str] = field(default_factory=list[str])
    bools: list[str] = field(default_factory=list[str])
    kinds: dict[str, list[Json]] = field(default_factory=dict[str, list[Json]])
    inner: "dict[str, _Object]" = field(default_factory=dict[str, "_Object"])
    order: tuple[str, ...] = ()
    keeps: bool = True

    def within(self, name: str) -> "_Object":
        """The object that a place leads through."""
        return self.inner.setdefault(name, _Object(keeps=False)) if name else self

    def add(self, name: str, schema: Json, *, needed: bool) -> None:
        self.fields[name] = schema
        if needed:
            self.needed.append(name)

    def schema(self) -> Json:
        fields = self.fields | {
            name: {"description": _KINDS, "oneOf": branches} for name, branches in self.kinds.items()
        }
        fields |= {name: made.schema() for name, made in self.inner.items()}
        if self.keeps:
            fields["opaque"] = {"description": _OPAQUE, "type": "array", "items": {"$ref": "#/$defs/opaque"}}
        if self.bools:
            spelt = {name: {"description": "As it was written.", "$ref": "#/$defs/text"} for name in self.bools}
            fields["spelling"] = _closed(_SPELLING, spelt)
        if len(self.order) > 1:
            fields["order"] = {"description": _ORDER, "type": "array", "items": {"enum": list(self.order)}}
        return _closed(self.text, fields, self.needed)


def _closed(text: str, fields: Mapping[str, Json], needed: Iterable[str] = ()) -> Json:
    """An object of these fields and no others."""
    required = sorted(set(needed))
    return {
        **({"description": text} if text else {}),
        "type": "object",
        "properties": dict(fields),
        **({"required": required} if required else {}),
        "additionalProperties": False,
    }


class _Format:
    """The objects of one format; definitions are made as they are met."""

    def __init__(self, facts: Table) -> None:
        self.table = facts
        self.documentation = Documentation(facts)
        self.header: dict[str, Json] = {}
        self.wanted: list[str] = []

    def add_to(self, definitions: dict[str, Json]) -> Json:
        """Add all objects to the definitions of the schema; gives a reference to the document."""
        root = self._node(self.table.definitions[self.table.root], (self.table.root,))
        definitions[self.table.format] = self._document(root)
        for name in self.wanted:  # it grows on the way
            definitions[f"{self.table.format}.{name}"] = self._node(self.table.definitions[name], (name,)).schema()
        if self.table.format == "urdf":
            definitions[f"urdf.{self.table.root}"] = root.schema()
        return {"$ref": f"#/$defs/{self.table.format}"}

    def _document(self, root: _Object) -> Json:
        """The document: in SDF the root's own node, in URDF the one around that of its robot."""
        made = _Object(text=self.documentation.of_definition(self.table.root))
        if self.table.format == "urdf":
            robot = {"$ref": f"#/$defs/urdf.{self.table.root}"}
            made.fields = {**self.header, "models": _array(robot, "The robot.") | {"minItems": 1, "maxItems": 1}}
            made.needed, made.keeps = ["models"], False
        else:
            made = root
        head = {
            "$schema": {"description": "The version of this schema.", "const": IDENTIFIER},
            "format": {"description": "The format that the document is in.", "const": self.table.format},
            "namespaces": _array({"$ref": "#/$defs/namespace"}, "The prefixes of names, each with its namespace."),
        }
        made.fields = {**head, **made.fields}
        # Made from the facts tables and not from the classes of the IR, since only they know which
        # field belongs to which format, and what it means.
        made.needed = ["format", *made.needed]
        return made.schema()

    def _node(self, fact: Fact, path: Path, text: str = "") -> _Object:
        """The object of an element that is a node of its own."""
        made = _Object(text=text or self.documentation.of_definition(path[0]))
        if len(path) == 1:
            made.order = repeated_fields(self.table.format, path[0])
        self._fill(made, fact, path)
        return made

    def _fill(self, made: _Object, fact: Fact, path: Path, *, needed: bool = True) -> None:
        if fact.any and fact.place:
            made.add(fact.place, _array({"$ref": "#/$defs/element"}, "All that is in it."), needed=False)
        if fact.type == "pose":
            for name, kind, text in _POSE:
                made.add(name, {"description": text, "$ref": f"#/$defs/{kind}"}, needed=False)
        for name, rows in groupby(sorted(fact.rows, key=lambda row: _first(fact, row)), key=lambda row: row.name):
            every = list(rows)
            if any(row.place for row in every):
                self._rows(made, every, (*path, name), needed=needed and self._is_needed(every))

    def _rows(self, made: _Object, rows: list[Fact], path: Path, *, needed: bool) -> None:
        """The field of all rows of one name."""
        row = next(row for row in reversed(rows) if row.place)
        outer, _, name = (row.place or "").rpartition(".")
        text = self.documentation.of(path, row, rows)
        if row.type is None and row.place == ".":
            self._fill(made, row, path, needed=needed)
        elif name.startswith("/"):
            self.header[name[1:]] = {"description": text} | value_schema(self.table.format, rows)
        elif row.kind:
            made.kinds.setdefault(name, []).append(self._kind(row, path, text))
        elif row.type is not None:
            schema = {"description": text} | value_schema(self.table.format, rows)
            many = any(each.fills_tuple for each in rows)
            made.within(outer).add(name, _array(schema, text) if many else schema, needed=needed and not outer)
            if row.type == "bool":
                made.within(outer).bools.append(name)
            self._fill(made.within(outer), row, path, needed=needed)
        else:
            self._child(made.within(outer), name, rows, path, needed=needed and not outer)
        if outer:  # such as <axis>, of whose object several elements are parts
            made.within(outer).text = self.documentation.texts.get((*path[:1], outer), "")

    def _child(self, made: _Object, name: str, rows: list[Fact], path: Path, *, needed: bool) -> None:
        row = max(rows, key=lambda row: len(self.table.resolve(row).rows))
        text = self.documentation.of(path, rows[-1], rows)
        schema = {"description": text} | self._reference(row, path, text)
        if any(each.fills_tuple for each in rows):
            made.add(name, _array(schema, text) | ({"minItems": 1} if needed else {}), needed=needed)
        else:  # one that is there and empty, such as <geometry/>, is a part without a field
            made.add(name, schema, needed=False)

    def _reference(self, row: Fact, path: Path, text: str) -> Json:
        if row.reference is None:
            return self._node(row, path, text).schema()
        if row.reference not in self.wanted:
            self.wanted.append(row.reference)
        return {"$ref": f"#/$defs/{self.table.format}.{row.reference}"}

    def _kind(self, row: Fact, path: Path, text: str) -> Json:
        """One of several kinds of node that share a field."""
        path = (row.reference,) if row.reference else path
        made = self._node(self.table.resolve(row), path, text)
        made.fields = {"kind": {"description": "Which kind it is.", "const": row.kind}, **made.fields}
        made.needed = ["kind", *made.needed]
        return made.schema()

    def _is_needed(self, rows: list[Fact]) -> bool:
        """Whether every version asks for it. A leaf that is there and blank has no value, so none is asked for."""
        return not (rows[-1].type and not rows[-1].is_attribute) and all(
            any(row.required and row.exists_in(parse_version(version)) for row in rows)
            for version in self.table.versions
        )


_POSE = (
    ("xyz", "vector3", "The translation. Unit: m."),
    ("rpy", "vector3", "Roll, pitch and yaw about fixed axes. Unit: rad, or degrees where they are asked for."),
    ("quat_xyzw", "quaternion", "The rotation as a quaternion x, y, z, w, instead of rpy."),
)  # fmt: skip


def _first(fact: Fact, row: Fact) -> int:
    """The place of the first row of a name, so that all of them stand together."""
    return next(place for place, each in enumerate(fact.rows) if each.name == row.name)


def _array(items: Json, text: str) -> Json:
    return {"description": text, "type": "array", "items": {key: items[key] for key in items if key != "description"}}
