"""XSDs for xacro files: the lenient schema of a format with `${...}` everywhere, and one of xacro's own elements.

XSD has a schema document for each namespace: that of the format imports one for each name of xacro's. What xacro's
elements contain is validated as far as its elements mean the same wherever they stand in the format; a macro may be the
inside of anything.
"""

from collections import defaultdict
from collections.abc import Iterator

from lxml import etree

from twinform.schemas.facts import Table, Version, table
from twinform.schemas.meanings import rows_with_paths
from twinform.schemas.xacro_elements import ELEMENTS, NAMESPACES, TARGET_NAMESPACE, XacroAttribute, XacroElement
from twinform.schemas.xml import XmlElement
from twinform.schemas.xsd_values import XS, annotate, xs


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
    """Let the schema of a format know xacro's elements."""
    # xacro's namespace has three names in real files, and a schema document has one.
    for namespace in NAMESPACES:
        xs(schema, "import", namespace=namespace, schemaLocation=xacro_schema_name(namespace))


def unambiguous(facts: Table, version: Version) -> Iterator[tuple[str, str]]:
    """The elements that mean the same wherever they stand: their names, and those of their definitions.

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
