"""XSDs for xacro files: the elements of xacro, and a format's lenient schema with `${...}` everywhere.

XSD has a schema document for each namespace: that of the format imports one for each name of xacro's. What xacro's
elements contain is validated as far as its elements mean the same wherever they stand in the format; a macro may be the
inside of anything.
"""

from collections import defaultdict
from collections.abc import Iterator
from typing import NamedTuple

from lxml import etree

from twinform.ir.versions import Version
from twinform.schemas.facts import Table, table
from twinform.schemas.meanings import rows_with_paths
from twinform.schemas.xml import XmlElement
from twinform.schemas.xsd_values import XS, annotate, xs

NAMESPACES = ("http://www.ros.org/wiki/xacro", "http://ros.org/wiki/xacro", "http://wiki.ros.org/xacro")
"""The names that real files give xacro's namespace, that of its documentation first. xacro takes any."""


class XacroAttribute(NamedTuple):
    """An attribute of a xacro element; `prefixed` ones are in xacro's namespace as well."""

    name: str
    meaning: str
    required: bool = False
    prefixed: bool = False


class XacroElement(NamedTuple):
    """An element of xacro; `holds_xml` means that it may contain elements of any kind."""

    name: str
    meaning: str
    attributes: tuple[XacroAttribute, ...]
    holds_xml: bool = False
    free: bool = False
    """Whether it takes any other attributes."""


_CONDITION = XacroAttribute("value", "True or false, 1 or 0, or an expression that gives one.", required=True)

ELEMENTS = (
    XacroElement(
        "arg",
        "An argument that is given on the command line or by whoever includes the file, for $(arg NAME).",
        (
            XacroAttribute("name", "What it is called.", required=True),
            XacroAttribute("default", "Its value where none is given.", required=True),
        ),
    ),
    XacroElement(
        "property",
        "A name for a value, or for the XML in it, for ${NAME} and insert_block.",
        (
            XacroAttribute("name", "What it is called. Names of blocks begin with * where they are inserted.", True),
            XacroAttribute("value", "Its value; without it, the XML in the element."),
            XacroAttribute("default", "Its value where it has none yet."),
            XacroAttribute(
                "scope", "Where it is known besides: in the calling macro (parent), or everywhere (global)."
            ),
            XacroAttribute("remove", "True takes the name away again."),
            XacroAttribute("lazy_eval", "False evaluates the value here, and not where it is used."),
        ),
        holds_xml=True,
    ),
    XacroElement(
        "macro",
        "A piece of XML with parameters; <xacro:NAME .../> is replaced by it.",
        (
            XacroAttribute("name", "What it is called.", required=True),
            XacroAttribute(
                "params",
                "Its parameters, with blanks between them: NAME, NAME:=DEFAULT, NAME:=^ for that of the caller, "
                "*NAME for a block, **NAME for what a block contains.",
            ),
        ),
        holds_xml=True,
    ),
    XacroElement(
        "include",
        "The content of another xacro file stands here.",
        (
            XacroAttribute("filename", "The file; $(find PACKAGE) leads into a package.", required=True),
            XacroAttribute("ns", "Puts its macros and properties into a namespace: NS.NAME."),
            XacroAttribute("optional", "True lets the file be missing."),
        ),
    ),
    XacroElement("if", "What is in it stands here if the value is true.", (_CONDITION,), holds_xml=True),
    XacroElement("unless", "What is in it stands here if the value is false.", (_CONDITION,), holds_xml=True),
    XacroElement(
        "insert_block",
        "The XML of a block parameter or a block property stands here.",
        (XacroAttribute("name", "The name of the block.", required=True),),
    ),
    XacroElement(
        "call",
        "A macro whose name is an expression.",
        (XacroAttribute("macro", "The name of the macro.", required=True),),
        holds_xml=True,
        free=True,
    ),
    XacroElement(
        "element",
        "An element whose name is an expression.",
        (XacroAttribute("name", "The name.", required=True, prefixed=True),),
        holds_xml=True,
        free=True,
    ),
    XacroElement(
        "attribute",
        "An attribute of the element around it, whose name and value are expressions.",
        (
            XacroAttribute("name", "The name.", required=True),
            XacroAttribute("value", "The value.", required=True),
        ),
    ),
)
"""By the source of xacro 2.1; every element but these is the call of a macro."""

TARGET_NAMESPACE = XacroAttribute("targetNamespace", "The default namespace of the result.", prefixed=True)
"""An attribute of the root."""


def xacro_schema_name(namespace: str) -> str:
    """The file of the schema of xacro's own elements under one of its names: `xacro-ros.org.xsd`."""
    return f"xacro-{namespace.partition('://')[2].partition('/')[0]}.xsd"


def xacro_schema_text(namespace: str = NAMESPACES[0]) -> str:
    """The schema of xacro's own elements, under one of the names of its namespace."""
    schema = etree.Element(
        XS + "schema", {"targetNamespace": namespace, "elementFormDefault": "qualified"}, nsmap={"xs": XS[1:-1]}
    )
    for attribute in _prefixed_attributes():
        annotate(attribute.meaning, xs(schema, "attribute", name=attribute.name, type="xs:string"))
    for element in ELEMENTS:
        declared = xs(schema, "element", name=element.name)
        annotate(element.meaning, declared)
        _fill(element, xs(declared, "complexType"), schema)
    etree.indent(schema)
    return '<?xml version="1.0" encoding="UTF-8"?>\n' + etree.tostring(schema, encoding="unicode") + "\n"


def import_xacro(schema: XmlElement) -> None:
    """Import the schemas of xacro's elements into the schema of a format."""
    # xacro's namespace has three names in real files, and a schema document has one.
    for namespace in NAMESPACES:
        xs(schema, "import", namespace=namespace, schemaLocation=xacro_schema_name(namespace))


def unambiguous(facts: Table, version: Version) -> Iterator[tuple[str, str]]:
    """Return the elements that mean the same wherever they stand: their names with their definitions.

    A macro of URDF may be the inside of a `<gazebo>`, which holds SDF: only links are no less likely to be URDF's.
    """
    # Of 320 xacro files of the corpus whose root is `robot` or `sdf`, 303 are taken. Of the 17
    # others 14 are mistakes (<box> without a size, a <visual> with text), two are from before xacro
    # needed a prefix, and one is a test of xacro itself.
    foreign = (
        {path[-1] for path, _ in rows_with_paths(table("sdf"))} - {"link"} if facts.format == "urdf" else set[str]()
    )
    references = defaultdict[str, set[str | None]](set)
    for path, row in rows_with_paths(facts):
        if len(path) > 1 and not row.is_attribute and row.name not in foreign and row.exists_in(version):
            references[row.name].add(row.reference)
    for name, found in sorted(references.items()):
        reference, *others = found
        if reference and not others and not facts.definitions[reference].any:
            yield name, reference


def imported_schemas() -> dict[str, str]:
    """The schemas of xacro's own elements under all names of their namespace, by the names of their files."""
    return {xacro_schema_name(each): xacro_schema_text(each) for each in NAMESPACES}


def _prefixed_attributes() -> list[XacroAttribute]:
    return [TARGET_NAMESPACE, *(each for element in ELEMENTS for each in element.attributes if each.prefixed)]


def _fill(element: XacroElement, complex_type: XmlElement, schema: XmlElement) -> None:
    if element.holds_xml:
        complex_type.set("mixed", "true")
        anything = {"minOccurs": "0", "maxOccurs": "unbounded", "processContents": "lax"}
        xs(xs(complex_type, "sequence"), "any", namespace="##any", **anything)
    for attribute in element.attributes:
        use = {"use": "required"} if attribute.required else {}
        if attribute.prefixed:
            prefix = {"x": str(schema.get("targetNamespace"))}
            complex_type.append(etree.Element(XS + "attribute", {"ref": f"x:{attribute.name}", **use}, nsmap=prefix))
        else:
            annotate(attribute.meaning, xs(complex_type, "attribute", name=attribute.name, type="xs:string", **use))
    if element.free:
        xs(complex_type, "anyAttribute", namespace="##any", processContents="skip")
