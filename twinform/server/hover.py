"""Hover: meaning, unit, default, versions, and the counterpart in the other format, as Markdown."""

from collections.abc import Iterator
from functools import cache

from lsprotocol import types

from twinform.diagnostics import Diagnostic, Span
from twinform.diagnostics.rule_registry import RuleRegistryError, find_rule
from twinform.ir import Format
from twinform.lazy import lazy_pattern
from twinform.passes.plugins.catalog import systems
from twinform.passes.plugins.catalog_types import PluginKind
from twinform.schemas import table
from twinform.schemas.meanings import Documentation
from twinform.schemas.value_types import type_name
from twinform.server.diagnostics import span_of
from twinform.server.document_names import name_at
from twinform.server.documents import Cursor, CursorKind, TextDocument, cursor_at
from twinform.server.mapping import FORMATS, FormatName, MappingRow, destination, rows
from twinform.server.names import ELEMENTS, Name
from twinform.server.navigation import Found, resolve, search_of
from twinform.server.schema import PREFIX, described, kind_of, parameter_of
from twinform.server.session import Session
from twinform.server.tolerant_tree import TolerantNode

_LONGEST = 200


def hover(session: Session, document: TextDocument, offset: int) -> types.Hover | None:
    """Describe the part of a document at an offset, with the pages of the rules that found something there."""
    cursor = cursor_at(document, offset)
    parts = list(_describe(session, document, cursor, offset)) if cursor else []
    parts += _rule_pages(session, document, offset)
    if not parts:
        return None
    piece = cursor.piece if cursor else Span(offset, offset)
    content = types.MarkupContent(types.MarkupKind.Markdown, "\n\n---\n\n".join(parts))
    return types.Hover(content, document.positions.range(piece))


def warm_up() -> None:
    """Read all tables before they are needed."""
    for format in FORMATS:
        text_of_row(rows(format)[-1])
    systems()


def text_of_row(row: MappingRow) -> str:
    """Describe a row: its documentation, its type, and its counterpart in the other format."""
    fact = row.fact
    documentation = _documentation(row.format)
    text = documentation.of((row.definition, *row.steps.split("/")), fact)
    if not text and fact.reference:
        text = documentation.of_definition(fact.reference)
    lines = [text, *_describe_type(row)]
    goes, fates = destination(row)
    if goes or fates:
        lines.append(f"In {Format(row.format).counterpart.upper()}: {', '.join(filter(None, (goes, fates)))}.")
    return "\n\n".join(filter(None, lines))


def _describe_type(row: MappingRow) -> Iterator[str]:
    fact = row.fact
    words = [*(["required"] if fact.required else []), *(["may be repeated"] if fact.repeats else [])]
    words += [type_name(fact.type)] if fact.type else []
    words += [f"of the dialect of {fact.dialect}"] if fact.dialect else []
    if words:
        yield f"*{', '.join(words)}*"
    values = [*fact.enum, *(f"{value} ({dialect})" for value, dialect in fact.also)]
    if values:
        yield f"One of {', '.join(f'`{value}`' for value in values)}."


@cache
def _documentation(format: FormatName) -> Documentation:
    return Documentation(table(format))


def _describe(session: Session, document: TextDocument, cursor: Cursor, offset: int) -> Iterator[str]:
    name = name_at(document, offset)
    if name is not None:
        yield from _describe_name(session, document, name)
    node = cursor.node
    if node is None:
        return
    if node.tag.startswith(PREFIX):
        yield from _describe_xacro(node, cursor)
    attribute = cursor.attribute if cursor.kind in {CursorKind.ATTRIBUTE, CursorKind.VALUE} else None
    if attribute is None and cursor.kind is CursorKind.ATTRIBUTE:
        return
    yield from _describe_plugin(node, cursor)
    row = document.schema.row(node, attribute)
    if row is not None:
        shown = f"`@{attribute}`" if attribute else f"`<{node.tag}>`"
        yield f"**{shown}** in {row.format.upper()} `{row.definition}`\n\n{text_of_row(row)}"


def _describe_name(session: Session, document: TextDocument, name: Name) -> Iterator[str]:
    """Say where a name is defined."""
    if name.defines:
        return
    group = session.neighbors.included(document, search_of(session, document))
    for found in resolve(Found(document, name), group, session)[:1]:
        line = found.document.positions.position(found.name.span.start).line + 1
        where = "" if found.document.path == document.path else f" of {code(found.document.path.name)}"
        tag = found.name.node.start_tag.of(found.document.text)[:_LONGEST]
        yield f"{found.name.kind} {code(found.name.text[:_LONGEST])}, line {line}{where}\n\n{code_block(tag, 'xml')}"


def _describe_xacro(node: TolerantNode, cursor: Cursor) -> Iterator[str]:
    known = ELEMENTS.get(node.tag.removeprefix(PREFIX))
    if known is not None and cursor.kind in {CursorKind.TAG, CursorKind.END_TAG}:
        needed, others, text = known
        attributes = [f"`{each}`" for each in needed] + [f"`{each}` (optional)" for each in others]
        yield f"**`<{node.tag}>`**\n\n{text}\n\nAttributes: {', '.join(attributes)}."


def _describe_plugin(node: TolerantNode, cursor: Cursor) -> Iterator[str]:
    parameter = parameter_of(node)
    if parameter is not None and cursor.kind is not CursorKind.ATTRIBUTE:
        yield f"**`<{node.tag}>`** of the plugin\n\n{described(parameter)}"
    elif node.tag == "plugin" and cursor.kind in {CursorKind.TAG, CursorKind.VALUE}:
        kind = kind_of(node)
        if kind is not None:
            yield _describe_system(kind)


def _describe_system(kind: PluginKind) -> str:
    needed = [f"`<{each.name}>`" for each in kind.parameters if each.is_required]
    lines = [f"**{kind.name}**: `{kind.file}`, class `{kind.class_name}`", f"Stands in: {', '.join(kind.scopes)}."]
    lines += [f"Required: {', '.join(needed)}."] if needed else []
    lines += [f"In {', '.join(sorted(kind.releases))}."] if kind.releases else []
    return "\n\n".join(lines)


def _rule_pages(session: Session, document: TextDocument, offset: int) -> list[str]:
    """Return the pages of the rules that found something at an offset."""
    pages: dict[str, str] = {}
    for found in session.findings(document):
        here = span_of(found.location, document)
        if here.start <= offset <= here.end and found.rule.name not in pages:
            pages[found.rule.name] = _rule_page(found)
    return list(pages.values())


def _rule_page(found: Diagnostic) -> str:
    try:
        known = find_rule(found.rule.name)
    except RuleRegistryError:
        known = None
    rule = known.rule if known is not None else found.rule
    return f"**{rule.name}**: {rule.finds}\n\n{rule.matters}\n\nBetter:\n\n{rule.better}"


_TICKS = lazy_pattern("`+")


def code(text: str) -> str:
    """Write a text as inline code, with no link, picture or command in it."""
    line = " ".join(text.split())
    ticks = "`" * (_longest_run(line) + 1)
    # blanks keep ticks at the ends apart, and are not shown
    return f"{ticks} {line} {ticks}" if "`" in line else f"{ticks}{line}{ticks}"


def code_block(text: str, language: str) -> str:
    """Write a text as a code block in a language."""
    fence = "`" * max(3, _longest_run(text) + 1)
    return f"{fence}{language}\n{text}\n{fence}"


def _longest_run(text: str) -> int:
    return max((len(run) for run in _TICKS.findall(text)), default=0)
