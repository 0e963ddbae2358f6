"""Facts tables of both formats, and what is made from them: readers, writers, XSDs and validators."""

from twinform.schemas.facts import Fact, Table, Version, parse_version, print_version, rows_by_name, table
from twinform.schemas.messages import Context
from twinform.schemas.packaged import json_schema_text, schema_text
from twinform.schemas.reader import Reader, reader
from twinform.schemas.untyped_parts import element_data
from twinform.schemas.validator import Engine, SchemaError, libxml2_errors, refusals, validate, xmlschema_errors
from twinform.schemas.values import format_value, parse_value
from twinform.schemas.writer import LAST_LINE, Writer, element_xml, in_order, writer
from twinform.schemas.xml import XmlElement, declared_namespaces, path_of, undeclared_namespace, undeclared_prefix

__all__ = [
    "LAST_LINE",
    "Context",
    "Engine",
    "Fact",
    "Reader",
    "SchemaError",
    "Table",
    "Version",
    "Writer",
    "XmlElement",
    "declared_namespaces",
    "element_data",
    "element_xml",
    "format_value",
    "in_order",
    "json_schema_text",
    "libxml2_errors",
    "parse_value",
    "parse_version",
    "path_of",
    "print_version",
    "reader",
    "refusals",
    "rows_by_name",
    "schema_text",
    "table",
    "undeclared_namespace",
    "undeclared_prefix",
    "validate",
    "writer",
    "xmlschema_errors",
]
