"""Checks files that others include, of xacro and MJCF, which are no models by themselves."""

import re
from collections.abc import Iterator
from pathlib import Path
from xml.sax.saxutils import unescape

from twinform.compiler.input.load_options import LoadOptions, LoadResult
from twinform.compiler.input.loading import bytes_of
from twinform.compiler.input.parsing import UnreadableError, parse, read_bytes
from twinform.compiler.input.xacro.budget import ExcessError
from twinform.compiler.input.xacro.expression_values import ExpressionRefusedError
from twinform.compiler.input.xacro.interpreter import parse as syntax_of
from twinform.diagnostics import DiagnosticSink, Location, rules
from twinform.text import Lines, SourceText, UndecodableError, UnplacedError, spans
from twinform.text.positions import ElementSpan

_REQUIRED = {"xacro:include": "filename", "xacro:macro": "name", "xacro:property": "name", "xacro:arg": "name"}
"""Elements of xacro, and the attribute that each needs."""
_QUOTES = {"&quot;": '"', "&apos;": "'"}
_EXPRESSION = re.compile(r"(?<!\$)\$\{(?P<expression>[^}]*)(?P<end>\}?)")


def check_part(path: Path, load_options: LoadOptions) -> LoadResult:
    """Check a file of macros; nothing in it is expanded, since only a robot that includes it gives it its values."""
    search = load_options.search
    sink = DiagnosticSink(str(path), load_options.strict)
    search.seen.add(path)
    unsaved = search.unsaved_of(path)
    try:
        data = read_bytes(path, sink, load_options.limits, search.readable(path)) if unsaved is None else unsaved
    except UnreadableError:
        return LoadResult(sink.file, None, tuple(sink.diagnostics), unreadable=True)
    allowances = load_options.allowances(sink.file)
    allowances.read(data, sink)
    for message, where in _faults(data):
        sink.report(rules.XACRO_ERROR, message, where)
    allowances.checked = True
    allowances.settle(sink)
    return LoadResult(sink.file, None, tuple(sink.diagnostics), content=data, allowed=tuple(sink.allowed))


def _faults(data: bytes) -> Iterator[tuple[str, Location]]:
    """Yield what is wrong in a file, and where."""
    try:
        text = SourceText.of(data).text
        root = spans(text)
    except UndecodableError as error:
        yield f"not well-formed XML: {error}", Location(line=1)
        return
    except UnplacedError as error:
        yield f"not well-formed XML: {error}", Location("", error.line, "", error.column)
        return
    lines = Lines(text)
    for element in root.walk():
        for message, offset in _faults_of(element, text):
            place = lines.place(offset)
            yield message, Location("", place.line, "", place.column)


def _faults_of(element: ElementSpan, text: str) -> Iterator[tuple[str, int]]:
    for span in (*(each.value for each in element.own_attributes), *element.texts()):
        if "${" in span.of(text):
            for found in _EXPRESSION.finditer(text, span.start, span.end):
                if message := _fault_of_expression(found):
                    yield message, found.start()
    name = element.name.of(text)
    required = _REQUIRED.get(name)
    if required and required not in element.attributes:
        yield f"<{name}> has no attribute {required!r}", element.name.start
    if name == "xacro:macro" and "name" in element.attributes:
        macro = element.attributes["name"].value.of(text)
        if macro == "call" or "." in macro:
            yield f"a macro cannot be called {macro!r}", element.attributes["name"].value.start


def _fault_of_expression(found: re.Match[str]) -> str | None:
    """Say what is wrong with an expression; one that is made of others is left to the robots that use it."""
    expression = " ".join(unescape(found["expression"], _QUOTES).split())
    if not found["end"]:
        return f"the expression '${{{expression}' has no closing brace"
    if "$" in expression or "{" in expression:
        return None
    try:
        syntax_of(expression)
    except SyntaxError as error:
        return f"{expression!r} is no expression: {error.msg}"
    except ExpressionRefusedError as error:
        return f"{error} (in {expression!r})"
    except (ExcessError, ValueError) as error:
        return str(error)
    return None


def check_mjcf_part(path: Path, load_options: LoadOptions) -> LoadResult:
    """Check that a file which others include is well-formed XML."""
    sink = DiagnosticSink(str(path), load_options.strict)
    load_options.search.seen.add(path)
    allowances = load_options.allowances(sink.file)
    data: bytes | None = None
    try:
        data = bytes_of(path, sink, load_options)
        allowances.read(data, sink)
        parse(data, sink, load_options.limits)
    except UnreadableError:
        return LoadResult(sink.file, None, tuple(sink.diagnostics), unreadable=True, content=data)
    allowances.checked = True
    allowances.settle(sink)
    return LoadResult(sink.file, None, tuple(sink.diagnostics), content=data, allowed=tuple(sink.allowed))
