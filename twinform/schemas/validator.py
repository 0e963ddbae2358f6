"""XSD validation, with libxml2 or xmlschema.

The reader has read the document before and reported whatever is wrong with it. The schema's verdict is asked
for as well because the two are independent readings of the same facts: where they differ, one of them is wrong.
"""

from collections.abc import Collection, Generator
from contextlib import contextmanager
from functools import cache
from itertools import islice
from threading import local
from typing import TYPE_CHECKING, Literal, NamedTuple, cast

from lxml import etree

from twinform.diagnostics import Location, rules
from twinform.ir.versions import Version, print_version
from twinform.schemas.facts import table
from twinform.schemas.messages import Context
from twinform.schemas.packaged import schema_text
from twinform.schemas.xml import XmlElement

if TYPE_CHECKING:
    from lxml.etree import ParserTarget
    from xmlschema import XMLSchema11

Engine = Literal["libxml2", "xmlschema"]

MOST = 100
"""The errors of an engine that are kept: a document can hold any number of them."""

_FAULTS = frozenset(
    {
        rules.INVALID_VALUE.name,
        rules.MISSING_ATTRIBUTE.name,
        rules.MISSING_ELEMENT.name,
        rules.MISSING_PART.name,
        rules.DIALECT.name,
    }
)
"""Findings of the reader that leave nothing to take out of the document, and that the schema refuses as well; a
dialect does where it is a value in a list."""


_CROWDED = etree.XPath("descendant::*[4001] and (*[2001] or descendant::*/*[2001])")
"""Whether an element has more than 2,000 children; small documents are checked at once."""


class SchemaError(NamedTuple):
    """An error that an XSD engine reports."""

    line: int
    message: str


def validate(
    root: XmlElement, context: Context, engine: Engine = "libxml2", errors: list[SchemaError] | None = None
) -> None:
    """Report what the schema refuses and the reader, which has filled the context, did not report.

    `errors` are those of the engine for the tree, where it was asked already. Duplicate and dangling names, and what
    only assertions find, which the normative schema alone looks for, are left to later checks.
    """
    if errors is None:
        errors = refusals(root, context, engine)
    # Nearly half of the URDF files of the corpus are refused for parts that the reader
    # reports and keeps, so the XSD is asked again without them. Asking only about the refused
    # elements, or explaining each error by its line, would be quicker and would no longer show
    # where the two disagree.
    if errors and (context.tolerated or context.replaced):
        with _without(context.tolerated, context.replaced):
            errors = refusals(root, context, engine)
    explained = _lines_with_faults(context) if errors else set[int]()
    for error in errors:
        if error.line not in explained and not context.sink.left_out:
            message = f"the XSD of {context.format.upper()} {print_version(context.version)} refuses: {error.message}"
            context.sink.report(rules.SCHEMA_DISAGREEMENT, message, Location(context.file, error.line, "/"))


def libxml2_errors(root: XmlElement, format: str, version: Version) -> list[SchemaError]:
    """Return the errors of libxml2 by the XSD 1.0 projection.

    lxml finds a path for each error, and counts siblings for that. So where there are many, a parser is asked first
    whether there is any error; then they are counted, and if they are many too, they have no lines.
    """
    schema = _libxml2_schema(format, version)
    # For each error lxml makes the path of its element, and counts siblings for that: 40,000
    # unknown attributes in one robot took two minutes. A valid robot of that size takes a few
    # percent longer this way.
    if _CROWDED(root):
        text = etree.tostring(root)
        if is_valid_text(text, format, version):
            return []
        found = _errors_without_places(text, schema)
        if not found or len(found) == MOST:
            return found
    if schema.validate(root):
        return []
    return [SchemaError(entry.line, entry.message) for entry in islice(schema.error_log, MOST)]


def _errors_without_places(text: bytes, schema: etree.XMLSchema) -> list[SchemaError]:
    """Return the errors that a validating parser finds in a text, without their places."""
    parser = etree.XMLParser(schema=schema, resolve_entities=False, no_network=True, collect_ids=False)
    try:
        etree.fromstring(text, parser)
    except etree.XMLSyntaxError as error:
        return [SchemaError(0, entry.message) for entry in islice(error.error_log, MOST)]
    return []


def is_valid_text(text: str | bytes, format: str, version: Version) -> bool:
    """Tell whether libxml2 parses the text of a file and accepts it by the XSD 1.0 projection.

    A parser whose target has no methods for elements makes no tree, and validates as it parses.
    """
    # Two thirds of the time that it takes to parse a tree and to validate it.
    parser = _validating_parser(format, version)
    try:
        etree.fromstring(text, parser)
    except etree.XMLSyntaxError:
        return False
    return not len(parser.error_log)


class _Nothing:
    """A parser target that builds nothing."""

    def close(self) -> None:
        """End the parse without a result."""


def xmlschema_errors(
    root: XmlElement,
    format: str,
    version: Version,
    *,
    names: bool = True,
    assertions: bool = False,
) -> list[SchemaError]:
    """Return the errors of xmlschema by the normative XSD 1.1, with or without its keys and assertions."""
    errors = islice(_xmlschema_schema(format, version, names=names, assertions=assertions).iter_errors(root), MOST)
    try:
        return [SchemaError(error.sourceline or 0, error.reason or error.message) for error in errors]
    except KeyError as error:  # xmlschema 4.3 does not catch its own when xsi:type names a type that there is not
        return [SchemaError(root.sourceline or 0, str(error))]


_parsers = local()  # as schemas are


def _validating_parser(format_: str, version: Version) -> etree.XMLParser:
    """Make a parser that validates and builds no tree, which would take longer than parsing a small file."""
    built = cast("dict[tuple[str, Version], etree.XMLParser]", _parsers.__dict__)
    if (format_, version) not in built:
        target = cast("ParserTarget[None]", _Nothing())  # lxml calls those of the methods that there are
        schema = _libxml2_schema(format_, version)
        made = etree.XMLParser(schema=schema, target=target, resolve_entities=False, no_network=True, collect_ids=False)
        built[format_, version] = cast("etree.XMLParser", made)
    return built[format_, version]


_schemas = local()  # threads that share a schema of libxml2 share its error log as well


def _libxml2_schema(format_: str, version: Version) -> etree.XMLSchema:
    built = cast("dict[tuple[str, Version], etree.XMLSchema]", _schemas.__dict__)
    schema = built.get((format_, version))
    if schema is None:
        text = schema_text(format_, version, "1.0").encode()
        schema = built[format_, version] = etree.XMLSchema(etree.fromstring(text))
    return schema


@cache
def _xmlschema_schema(format_: str, version: Version, *, names: bool, assertions: bool) -> "XMLSchema11":
    from xmlschema import XMLSchema11  # noqa: PLC0415 - a tenth of a second

    from twinform.schemas.xsd import without_assertions, without_names  # noqa: PLC0415 - only this engine knows them

    text = schema_text(format_, version, "1.1")
    text = text if names else without_names(text)
    return XMLSchema11(text if assertions else without_assertions(text), allow="none")


def refusals(root: XmlElement, context: Context, engine: Engine) -> list[SchemaError]:
    """Return the errors of an engine for a tree."""
    if engine == "xmlschema":
        return xmlschema_errors(root, context.format, context.version, names=False)
    return libxml2_errors(root, context.format, context.version)


def _lines_with_faults(context: Context) -> set[int]:
    """Return the lines of the elements in which the reader found a fault."""
    lines = {found.location.line for found in context.sink.diagnostics if found.rule.name in _FAULTS}
    # where there are faults, an error without a line may be one of them
    return lines | {0} if lines else lines


def is_valid_without_unknown(root: XmlElement, format_: str, version: Version) -> bool:
    """Tell whether libxml2 accepts a tree without the elements whose names no version of the format has."""
    known = _element_names(format_)
    unknown: list[tuple[XmlElement, str | None]] = [(each, None) for each in root.iter() if each.tag not in known]
    if not unknown:
        return False
    with _without(unknown, ()):
        return not libxml2_errors(root, format_, version)


@cache
def _element_names(format_: str) -> frozenset[str]:
    facts = table(format_)
    holders = [*facts.definitions.values()]
    for holder in holders:  # grows while it is walked
        holders += holder.children
    return frozenset(each.name for each in holders)


@contextmanager
def _without(
    tolerated: Collection[tuple[XmlElement, str | None]], replaced: Collection[tuple[XmlElement, str, str]]
) -> Generator[None]:
    """Take parts out of a tree, or replace them, for as long as the block lasts; they are those of a `Context`."""
    gone = {element for element, part in tolerated if part is None}
    # Children are taken out and put back all at once for each parent: a hostile file has a hundred
    # thousand of them. A copy of the tree took longer than the validation itself.
    parents = {parent for element in gone if (parent := element.getparent()) is not None}
    whole = [(parent, list(parent)) for parent in parents]
    changed = {element for element, _, _ in replaced}
    changed.update(element for element, part in tolerated if part is not None)
    before = [(element, element.items(), element.text, element.tail) for element in changed]
    for element, part, word in replaced:
        _replace(element, part, word)
    for element, part in tolerated:
        _replace(element, part, None)
    for parent, children in whole:
        parent[:] = [child for child in children if child not in gone]
    try:
        yield
    finally:
        for parent, children in whole:
            parent[:] = children
        for element, attributes, text, tail in before:
            element.attrib.clear()
            element.attrib.update(attributes)
            element.text, element.tail = text, tail


def _replace(element: XmlElement, part: str | None, word: str | None) -> None:
    """Set an attribute or a text to another value, or to none."""
    if part == "#text":
        element.text = word
    elif part == "#tail":
        element.tail = word
    elif part is not None and word is not None:
        element.set(part, word)
    elif part is not None:
        element.attrib.pop(part, None)
