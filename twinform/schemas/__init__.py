"""Facts tables of both formats, and what is made from them: readers, writers, XSDs and validators."""

from twinform.ir.versions import (
    DEFAULT_SDF_VERSION,
    Version,
    known_version,
    parse_version,
    print_version,
    version_read,
    versions_of,
)
from twinform.schemas.facts import Fact, Table, in_order, repeated_fields, rows_by_name, table
from twinform.schemas.messages import Context
from twinform.schemas.packaged import schema_text
from twinform.schemas.reader import SchemaReader, reader
from twinform.schemas.text_output import Item, WrittenParts, end_of_element, in_attribute
from twinform.schemas.text_writer import node_xml, parse_written, root_text
from twinform.schemas.validator import (
    Engine,
    SchemaError,
    is_valid_text,
    is_valid_without_unknown,
    libxml2_errors,
    refusals,
    validate,
    xmlschema_errors,
)
from twinform.schemas.value_readers import LAST_LINE, element_xml, node_class, read_element
from twinform.schemas.value_types import VALUE_TYPES, format_value, parse_value
from twinform.schemas.xml import (
    XmlElement,
    clark_name,
    declared_namespaces,
    has_prefixed_attributes,
    in_usual_namespaces,
    is_followed,
    path_of,
    undeclared_namespace,
    undeclared_prefix,
    usual_namespace,
)

__all__ = [
    "DEFAULT_SDF_VERSION",
    "LAST_LINE",
    "VALUE_TYPES",
    "Context",
    "Engine",
    "Fact",
    "Item",
    "SchemaError",
    "SchemaReader",
    "Table",
    "Version",
    "WrittenParts",
    "XmlElement",
    "clark_name",
    "declared_namespaces",
    "element_xml",
    "end_of_element",
    "format_value",
    "has_prefixed_attributes",
    "in_attribute",
    "in_order",
    "in_usual_namespaces",
    "is_followed",
    "is_valid_text",
    "is_valid_without_unknown",
    "known_version",
    "libxml2_errors",
    "node_class",
    "node_xml",
    "parse_value",
    "parse_version",
    "parse_written",
    "path_of",
    "print_version",
    "read_element",
    "reader",
    "refusals",
    "repeated_fields",
    "root_text",
    "rows_by_name",
    "schema_text",
    "table",
    "undeclared_namespace",
    "undeclared_prefix",
    "usual_namespace",
    "validate",
    "version_read",
    "versions_of",
    "xmlschema_errors",
]
