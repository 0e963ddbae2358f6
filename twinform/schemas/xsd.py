"""The XSDs, generated from the facts tables: one self-contained schema for each version and each version of XSD.

XSD 1.1 is normative. Children stand in any order, as in every reader, and keep their counts: `xs:all` with repeats and
a wildcard, which XSD 1.0 does not have. The XSD 1.0 projection, for libxml2 and editors, takes the same children in a
repeated choice, without counts and without keys, so it accepts whatever the normative one accepts.

What other namespaces add is skipped rather than checked: a `robot` inside of a foreign element is not ours.
"""

from lxml import etree

from twinform.schemas.facts import Fact, Table, Version, print_version
from twinform.schemas.packaged import XsdVersion
from twinform.schemas.xml import XmlElement
from twinform.schemas.xsd_names import declare_names
from twinform.schemas.xsd_values import XS, Values, allow_attributes, xs

_MANY = {"minOccurs": "0", "maxOccurs": "unbounded"}
_FOREIGN = "foreign"
"""A group of nothing but foreign elements. Where it stood inline, xmlschema 4.3 would let text pass as well."""


def generate_schema(facts: Table, version: Version, xsd: XsdVersion) -> str:
    """The text of the schema of a version of the format."""
    schema = _Generator(facts, version, normative=xsd == "1.1").generate()
    etree.indent(schema)
    for annotation in schema.iter(XS + "annotation"):
        annotation.text = annotation[0].tail = None  # one line each
    return '<?xml version="1.0" encoding="UTF-8"?>\n' + etree.tostring(schema, encoding="unicode") + "\n"


class _Generator:
    """Makes one schema; definitions are declared as they are met."""

    def __init__(self, facts: Table, version: Version, *, normative: bool) -> None:
        self.table = facts
        self.version = version
        self.normative = normative
        self.values = Values(facts.format)
        self.schema = etree.Element(XS + "schema", {"version": print_version(version)}, nsmap={"xs": XS[1:-1]})
        self.wanted = [facts.root]

    def generate(self) -> XmlElement:
        """The whole schema."""
        root = xs(self.schema, "element", name=self.table.root, type=self.table.root)
        self._declare_names(root, self.table.definitions[self.table.root], self.table.root)
        for name in self.wanted:  # it grows on the way
            definition = self.table.definitions[name]
            self._fill(definition, xs(self.schema, "complexType", name=name), name)
        _allow_foreign(xs(xs(self.schema, "group", name=_FOREIGN), "sequence"), **_MANY)
        self.values.declare(self.schema)
        return self.schema

    def _fill(self, fact: Fact, complex_type: XmlElement, path: str) -> None:
        """Say in a complex type what an element holds. `path` tells apart the names of the keys on the way."""
        holder = complex_type
        if fact.type:
            holder = self.values.extension(fact, complex_type)
        elif fact.any:
            _allow_anything(fact, complex_type)
        else:
            self._children(fact, complex_type, path)
        self._attributes(fact, holder)

    def _attributes(self, fact: Fact, holder: XmlElement) -> None:
        for row in self._present(fact.attributes):
            attribute = xs(holder, "attribute", name=row.name[1:])
            if row.required:
                attribute.set("use", "required")
            _annotate(row, attribute)
            self.values.attribute(row, attribute)
        allow_attributes(holder, "##any" if fact.any else "##other")

    def _children(self, fact: Fact, complex_type: XmlElement, path: str) -> None:
        rows = self._present(fact.children)
        if not rows:
            xs(xs(complex_type, "sequence"), "group", ref=_FOREIGN)
        elif not self.normative:
            self._in_any_number(rows, complex_type, path)
        elif rows[0].kind:
            self._one_of(rows, complex_type, path)
        else:
            everything = xs(complex_type, "all")
            for row in rows:
                self._child(row, everything, path, counted=True)
            _allow_foreign(everything, **_MANY)

    def _in_any_number(self, rows: list[Fact], complex_type: XmlElement, path: str) -> None:
        choice = xs(complex_type, "choice", **_MANY)
        for row in rows:
            self._child(row, choice, path)
        _allow_foreign(choice)

    def _one_of(self, rows: list[Fact], complex_type: XmlElement, path: str) -> None:
        """At most one of several kinds, with foreign elements around it."""
        sequence = xs(complex_type, "sequence")
        xs(sequence, "group", ref=_FOREIGN)
        choice = xs(sequence, "choice", minOccurs="0")
        for row in rows:
            branch = xs(choice, "sequence")
            self._child(row, branch, path)
            if row.repeats:
                self._in_any_number([row], branch, path + ".more")
            else:
                xs(branch, "group", ref=_FOREIGN)

    def _child(self, row: Fact, group: XmlElement, path: str, *, counted: bool = False) -> None:
        element = xs(group, "element", name=row.name)
        if counted and not row.required:
            element.set("minOccurs", "0")
        if counted and row.repeats:
            element.set("maxOccurs", "unbounded")
        _annotate(row, element)
        path = f"{path}.{row.name}"
        if row.reference:
            self._refer(row.reference, element)
        elif row.type:
            extension = self.values.leaf(row, element)
            if extension is not None:
                self._attributes(row, extension)
        else:
            self._fill(row, xs(element, "complexType"), path)
        self._declare_names(element, self.table.resolve(row), path)

    def _refer(self, name: str, element: XmlElement) -> None:
        element.set("type", name)
        if name not in self.wanted:
            self.wanted.append(name)

    def _declare_names(self, element: XmlElement, fact: Fact, path: str) -> None:
        if self.normative:
            named = [row.name for row in self._present(fact.children) if row.repeats and self._is_named(row)]
            declare_names(self.table.format, element, named, path)

    def _is_named(self, row: Fact) -> bool:
        """Whether its name is what others call it by. A plugin's is not: one plugin may run twice."""
        fact = self.table.resolve(row)
        return not fact.any and any(row.name == "@name" and row.required for row in self._present(fact.attributes))

    def _present(self, rows: list[Fact]) -> list[Fact]:
        return [row for row in rows if row.exists_in(self.version) and row.dialect is None]


def _allow_foreign(group: XmlElement, **counts: str) -> None:
    xs(group, "any", namespace="##other", processContents="skip", **counts)


def _allow_anything(fact: Fact, complex_type: XmlElement) -> None:
    if fact.children:
        raise ValueError(f"{fact.name}: XSD 1.0 cannot tell known children from any others")
    complex_type.set("mixed", "true")
    xs(xs(complex_type, "sequence"), "any", namespace="##any", processContents="skip", **_MANY)


def _annotate(row: Fact, element: XmlElement) -> None:
    """Tell editors what XSD has no word for."""
    said = [f"{key}={value}" for key, value in (("default", row.default), ("unit", row.unit)) if value is not None]
    if row.deprecated:
        said.append("deprecated")
    if said:
        xs(xs(element, "annotation"), "documentation").text = ", ".join(said)
