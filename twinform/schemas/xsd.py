"""The XSDs, generated from the facts tables: one self-contained schema for each version and each version of XSD.

XSD 1.1 is normative. Children stand in any order, as in every reader, and keep their counts: `xs:all` with repeats and
a wildcard, which XSD 1.0 does not have. The XSD 1.0 projection, for libxml2 and editors, takes the same children in a
repeated choice, without counts and without keys, so it accepts whatever the normative one accepts.

What other namespaces add is skipped rather than checked: a `robot` inside of a foreign element is not ours.

A lenient schema, for editors of real files, also takes the syntax of other versions and of dialects, and any attribute;
in XSD 1.1 any other element too, which XSD 1.0 cannot tell from those that it knows. One for xacro files also takes
expressions instead of values, and looks into xacro's elements (`xacro_xsd.py`).

Assertions and keys of XSD 1.1 say what readers refuse and no type or count can express. The reader and the rules on
models report the same, so validation checks them no more than keys.
"""

from collections.abc import Iterator
from typing import NamedTuple

from lxml import etree

from twinform.ir.versions import Version, print_version
from twinform.schemas.facts import Fact, Table, rows_by_name, table
from twinform.schemas.meanings import Documentation, Path
from twinform.schemas.packaged import XsdVersion
from twinform.schemas.xacro_xsd import import_xacro, unambiguous
from twinform.schemas.xml import XmlElement
from twinform.schemas.xsd_values import XS, Values, allow_attributes, annotate, xs

# XSD 1.0 has no way to take any element beside those that it knows; 1.1 has. Of 1,374 accepted
# corpus files the strict XSD 1.0 refuses 275, the lenient one 80, and the lenient 1.1 20, for text
# between elements and two numbers in transmissions.
_MANY = {"minOccurs": "0", "maxOccurs": "unbounded"}
_FOREIGN = "foreign"
"""A group of nothing but foreign elements. Where it stood inline, xmlschema 4.3 would let text pass as well."""


def generate_schema(
    facts: Table, version: Version, xsd: XsdVersion, *, lenient: bool = False, xacro: bool = False
) -> str:
    """Generate the schema of a version of the format; the one for xacro files is lenient."""
    schema = _XsdGenerator(facts, version, xsd, lenient=lenient or xacro, xacro=xacro).generate()
    etree.indent(schema)
    for annotation in schema.iter(XS + "annotation"):
        annotation.text = annotation[0].tail = None  # one line each
    return '<?xml version="1.0" encoding="UTF-8"?>\n' + etree.tostring(schema, encoding="unicode") + "\n"


def lenient_schema_text(format: str, version: Version, xsd: XsdVersion = "1.0") -> str:
    """Generate the lenient schema of a format's version on demand."""
    return generate_schema(table(format), version, xsd, lenient=True)


class _XsdGenerator:
    """Makes one schema; definitions are declared as they are met."""

    def __init__(self, facts: Table, version: Version, xsd: XsdVersion, *, lenient: bool, xacro: bool) -> None:
        self.table = facts
        self.version = version
        self.normative = xsd == "1.1" and not lenient
        self.lenient = lenient
        self.xacro = xacro
        self.others = {"notQName": "##definedSibling", "namespace": "##any"} if lenient and xsd == "1.1" else {}
        self.documentation = Documentation(facts)
        self.values = Values(facts.format, lenient=lenient, expressions=xacro)
        self.schema = etree.Element(XS + "schema", {"version": print_version(version)}, nsmap={"xs": XS[1:-1]})
        self.wanted = [facts.root]

    def generate(self) -> XmlElement:
        """The whole schema."""
        xs(xs(self.schema, "annotation"), "documentation").text = self._about()
        if self.xacro:
            import_xacro(self.schema)
        root = xs(self.schema, "element", name=self.table.root, type=self.table.root)
        self._declare_names(root, self.table.definitions[self.table.root], (self.table.root,))
        for name, definition in unambiguous(self.table, self.version) if self.xacro else ():
            self._refer(definition, xs(self.schema, "element", name=name))
        for name in self.wanted:  # it grows on the way
            definition = self.table.definitions[name]
            complex_type = xs(self.schema, "complexType", name=name)
            annotate(self.documentation.of_definition(name), complex_type)
            self._fill(definition, complex_type, (name,))
        self._allow_foreign(xs(xs(self.schema, "group", name=_FOREIGN), "sequence"), **_MANY)
        self.values.declare(self.schema)
        return self.schema

    def _about(self) -> str:
        """Write the comment that tells a reader what the schema is."""
        name = f"{self.table.format.upper()} {print_version(self.version)}"
        if self.xacro:
            return f"{name} in xacro files: expressions may stand for values, and xacro's elements anywhere."
        if self.lenient:
            return f"{name}, with the syntax of other versions and of dialects, and any attribute."
        strict = f"{name}, strict: what is no word of this version is refused, unless it is in a namespace."
        return strict if self.normative else f"{strict} How often elements may stand is checked by the XSD 1.1 alone."

    def _fill(self, fact: Fact, complex_type: XmlElement, path: Path) -> None:
        """Declare the content of an element in a complex type; `path` keeps the names of nested keys apart."""
        holder = complex_type
        if fact.type:
            holder = self.values.extension(fact, complex_type)
        elif fact.any:
            _allow_anything(fact, complex_type)
        else:
            self._children(fact, complex_type, path)
        self._attributes(fact, holder, path)
        if self.normative and not fact.type:
            declare_assertions(self.table, self.version, fact, complex_type, path)

    def _attributes(self, fact: Fact, holder: XmlElement, path: Path) -> None:
        for row in self._present(fact.attributes):
            attribute = xs(holder, "attribute", name=row.name[1:])
            if row.required and not (self.lenient and row.dialect) and not (self.xacro and path == (self.table.root,)):
                attribute.set("use", "required")
            annotate(self._words(row, fact, (*path, row.name)), attribute)
            self.values.attribute(row, attribute)
        allow_attributes(holder, "##any" if fact.any or self.lenient else "##other")

    def _words(self, row: Fact, holder: Fact, path: Path) -> str:
        """The documentation of a row."""
        return self.documentation.of(path, row, [each for each in holder.rows if each.name == row.name])

    def _children(self, fact: Fact, complex_type: XmlElement, path: Path) -> None:
        rows = self._present(fact.children)
        if not rows:
            xs(xs(complex_type, "sequence"), "group", ref=_FOREIGN)
        elif not self.normative:
            self._in_any_number(rows, fact, complex_type, path)
        elif rows[0].kind:
            self._one_of(rows, fact, complex_type, path)
        else:
            everything = xs(complex_type, "all")
            for row in rows:
                self._child(row, fact, everything, path, counted=True)
            self._allow_foreign(everything, **_MANY)

    def _in_any_number(self, rows: list[Fact], holder: Fact, complex_type: XmlElement, path: Path) -> None:
        choice = xs(complex_type, "choice", **_MANY)
        for row in rows:
            self._child(row, holder, choice, path)
        self._allow_foreign(choice)

    def _one_of(self, rows: list[Fact], holder: Fact, complex_type: XmlElement, path: Path) -> None:
        """Declare a choice of at most one of several kinds, with foreign elements around it."""
        sequence = xs(complex_type, "sequence")
        xs(sequence, "group", ref=_FOREIGN)
        choice = xs(sequence, "choice", minOccurs="0")
        for row in rows:
            branch = xs(choice, "sequence")
            self._child(row, holder, branch, path)
            if row.repeats:
                self._in_any_number([row], holder, branch, path)
            else:
                xs(branch, "group", ref=_FOREIGN)

    def _child(self, row: Fact, holder: Fact, group: XmlElement, path: Path, *, counted: bool = False) -> None:
        element = xs(group, "element", name=row.name)
        if counted and not row.required:
            element.set("minOccurs", "0")
        if counted and row.repeats:
            element.set("maxOccurs", "unbounded")
        path = (*path, row.name)
        annotate(self._words(row, holder, path), element)
        if row.reference:
            self._refer(row.reference, element)
        elif row.type:
            extension = self.values.leaf(row, element)
            if extension is not None:
                self._attributes(row, extension, path)
        else:
            self._fill(row, xs(element, "complexType"), path)
        self._declare_names(element, self.table.resolve(row), path)

    def _refer(self, name: str, element: XmlElement) -> None:
        element.set("type", name)
        if name not in self.wanted:
            self.wanted.append(name)

    def _declare_names(self, element: XmlElement, fact: Fact, path: Path) -> None:
        if self.normative:
            named = [row.name for row in self._present(fact.children) if row.repeats and self._is_named(row)]
            declare_names(self.table.format, element, named, ".".join(path))

    def _is_named(self, row: Fact) -> bool:
        """Tell whether others refer to an element by its name; a plugin's does not count, since one may run twice."""
        fact = self.table.resolve(row)
        return not fact.any and any(row.name == "@name" and row.required for row in self._present(fact.attributes))

    def _present(self, rows: list[Fact]) -> list[Fact]:
        if self.lenient:
            return list(rows_by_name(rows, self.version).values())
        return [row for row in rows if row.exists_in(self.version) and row.dialect is None]

    def _allow_foreign(self, group: XmlElement, **counts: str) -> None:
        process = "lax" if self.xacro else "skip"
        xs(group, "any", **{"namespace": "##other", **self.others}, processContents=process, **counts)


def _allow_anything(fact: Fact, complex_type: XmlElement) -> None:
    if fact.children:
        raise ValueError(f"{fact.name}: XSD 1.0 cannot tell known children from any others")
    complex_type.set("mixed", "true")
    xs(xs(complex_type, "sequence"), "any", namespace="##any", processContents="skip", **_MANY)


_NO_RESERVED_NAME = "not(@name = 'world' or matches(@name, '^__.*__$'))"
_NO_SCOPED_NAME = "not(contains(@name, '::'))"
_RESERVED_SINCE = (1, 7)
_SCOPED_SINCE = (1, 8)
_NAMED = frozenset({"world", "model", "link", "joint", "frame", "visual", "collision", "sensor", "light"})
"""Definitions of SDF whose names libsdformat checks."""

_MOVED = (
    "joint or actuator or passive_joint or leftActuator or rightActuator or flexJoint or rollJoint or gap_joint or "
    "simulated_actuated_joint"
)
# What a schema should refuse was asked of libsdformat 12 and urdfdom. Both take negative sizes, and
# a box or sphere without any; physics engines do not. A sphere without a radius is in a world of
# gz-sim, so only boxes must have their size.
_TESTS: dict[tuple[str, str], tuple[str, ...]] = {
    ("urdf", "joint"): ("not(@type = ('revolute', 'prismatic')) or limit",),
    ("urdf", "geometry"): ("*",),
    ("urdf", "transmission"): (f"(@type or type) and ({_MOVED})",),
    ("sdf", "box_shape"): ("size",),
}
"""By format and definition. Other shapes than boxes are simulated without their sizes, in worlds of gz-sim too."""

_SHAPES = ("geometry", "_shape")
"""How the names of definitions of shapes end; nothing in them is less than zero."""


def declare_assertions(facts: Table, version: Version, fact: Fact, complex_type: XmlElement, path: Path) -> None:
    """Add to the end of a complex type what must hold for the element of a row."""
    for test in _tests(facts, version, fact, path):
        xs(complex_type, "assert", test=test)


def without_assertions(schema: str) -> str:
    """The same schema without its assertions."""
    root = etree.fromstring(schema.encode())
    etree.strip_elements(root, XS + "assert", with_tail=False)
    return etree.tostring(root, encoding="unicode")


def _tests(facts: Table, version: Version, fact: Fact, path: Path) -> Iterator[str]:
    if len(path) == 1:
        yield from _TESTS.get((facts.format, path[0]), ())
    if facts.format == "sdf" and len(path) == 1 and path[0] in _NAMED:
        yield from [_NO_RESERVED_NAME] if version >= _RESERVED_SINCE else []
        yield from [_NO_SCOPED_NAME] if version >= _SCOPED_SINCE else []
    rows = [row for row in fact.rows if row.exists_in(version) and row.dialect is None]
    if path == ("origin",) and any(row.name == "@quat_xyzw" for row in rows):
        yield "not(@rpy and @quat_xyzw)"
    if path[0].endswith(_SHAPES):
        yield from (_in_bounds(row) for row in rows if 0 in (row.min, row.above) and (row.is_attribute or row.type))
    if facts.format == "sdf":  # libsdformat takes no default for an attribute that the format asks for
        yield from (row.name for row in rows if row.is_attribute and row.expected)


def _in_bounds(row: Fact) -> str:
    below = "lt 0" if row.above is None else "le 0"
    if row.type == "double":
        return f"not(number({row.name}) {below})"
    numbers = f"tokenize(normalize-space(string({row.name})), ' ')"
    return f"every $number in {numbers} satisfies not(number($number) {below})"


class _Reference(NamedTuple):
    """An attribute that holds a name of a key."""

    name: str
    key: str
    selector: str
    field: str


_REFERENCES = {
    "urdf": (
        _Reference("parent", "link", "joint/parent", "@link"),
        _Reference("child", "link", "joint/child", "@link"),
        _Reference("mimic", "joint", "joint/mimic", "@joint"),
    ),
    "sdf": (),  # its names have scopes, which no key can follow
    "mjcf": (),
}


# Keys are in the normative XSD 1.1 only, which no run asks: they cost about as much as all other
# checks together, give messages without a path, and cannot follow SDF's scopes. `ir/verify` checks
# the same and more.
def declare_names(format: str, element: XmlElement, named: list[str], path: str) -> None:
    """Declare that each kind of the named children has its names once; where others refer to them, as a key."""
    references = [reference for reference in _REFERENCES[format] if reference.key in named]
    keys = {reference.key for reference in references}
    for name in named:
        unique = xs(element, "key" if name in keys else "unique", name=f"{path}.{name}")
        _select(unique, name, "@name")
    for reference in references:
        keyref = xs(element, "keyref", name=f"{path}.{reference.name}", refer=f"{path}.{reference.key}")
        _select(keyref, reference.selector, reference.field)


def without_names(schema: str) -> str:
    """The same schema without its keys."""
    root = etree.fromstring(schema.encode())
    etree.strip_elements(root, XS + "key", XS + "keyref", XS + "unique", with_tail=False)
    return etree.tostring(root, encoding="unicode")


def _select(constraint: XmlElement, selector: str, field: str) -> None:
    xs(constraint, "selector", xpath=selector)
    xs(constraint, "field", xpath=field)
