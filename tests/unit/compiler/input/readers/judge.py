"""Compares what a generated reader makes of a tree with what the schema reader and Pydantic make of it."""

from collections.abc import Callable, Iterator, Mapping
from typing import Any, cast
from unittest.mock import patch

from pydantic import ValidationError

from twinform.compiler.input import sdf, urdf
from twinform.compiler.input.loading import declared_version
from twinform.diagnostics import DiagnosticSink, Source
from twinform.ir import Document
from twinform.ir.sourced import Sourced
from twinform.schemas import Context, XmlElement, has_prefixed_attributes, reader, refusals
from twinform.schemas.fast_path import UsualElement

Parts = tuple[object, ...]
Lower = Callable[[XmlElement, Context], Mapping[str, Any]]


def differences(root: XmlElement, *, strict: bool = False) -> list[str]:
    """What is not the same."""
    format_, lower, build = _FRONT_ENDS[str(root.tag)]
    judge, mine = (_context(root, format_, strict=strict) for _ in range(2))
    with patch.object(UsualElement, "holds", return_value=False):  # nothing is taken for usual
        data = lower(root, judge)
    document = build(root, mine)
    found = [*_differences_of_contexts(judge, mine), *_differences_of_documents(data, document)]
    if document is None and not mine.sink.has_errors:
        found.append("a document without errors is broken")
    return found


def _context(root: XmlElement, format_: str, *, strict: bool) -> Context:
    sink = DiagnosticSink(file="file", strict=strict)
    context = Context(sink, "file", format_, declared_version(root, format_, sink))
    context.clean = not refusals(root, context, "libxml2")
    context.simple = context.clean and not has_prefixed_attributes(root)
    return context


def _differences_of_contexts(one: Context, other: Context) -> Iterator[str]:
    for name in ("tolerated", "replaced", "structural", "aside", "outside", "header"):
        mine, theirs = getattr(one, name), getattr(other, name)
        if mine != theirs:
            yield f"context.{name}: {mine} and {theirs}"
    findings, others = one.sink.diagnostics, other.sink.diagnostics
    if findings != others:
        yield f"findings: {findings} and {others}"


def _differences_of_documents(data: Any, document: Document | None) -> Iterator[str]:
    try:
        expected = Document.model_validate(data)
    except ValidationError as error:
        if document is not None:
            yield f"a document although there is none: {error}"
        return
    if document is None:
        yield "no document"
        return
    yield from differences_of_parts(expected, document, "document")


def differences_of_parts(one: object, other: object, where: str) -> Iterator[str]:
    """What differs between two values, down to where they were read."""
    if type(one) is not type(other):
        yield f"{where}: {one!r} and {other!r}"
    elif isinstance(one, Sourced) and isinstance(other, Sourced):
        for name in one.field_names:
            yield from differences_of_parts(getattr(one, name), getattr(other, name), f"{where}.{name}")
    elif isinstance(one, tuple) and not isinstance(one, Source):
        yield from _differences_of_tuples(cast("Parts", one), cast("Parts", other), where)
    elif repr(one) != repr(other):  # -0 is not 0, and NaN is NaN
        yield f"{where}: {one!r} and {other!r}"


def _differences_of_tuples(one: Parts, other: Parts, where: str) -> Iterator[str]:
    if len(one) != len(other):
        yield f"{where}: {one} and {other}"
    for place, (mine, theirs) in enumerate(zip(one, other, strict=False)):
        yield from differences_of_parts(mine, theirs, f"{where}[{place}]")


def _lower_urdf(root: XmlElement, context: Context) -> Mapping[str, Any]:
    """The data of the document that a `<robot>` makes, by the schema reader alone."""
    model = reader("urdf", context.version).read(root, context)
    children: dict[str, str] = {}
    for joint in model.get("joints", ()):
        if "parent" in joint:
            joint.setdefault("pose", {})["relative_to"] = joint["parent"]
        if "child" in joint and "name" in joint:
            children.setdefault(joint["child"], joint["name"])
    for link in model.get("links", ()):
        joint = children.get(link.get("name"))
        if joint is not None:
            link["pose"] = {"relative_to": joint}
    return {"format": "urdf", "models": (model,), "source": model["source"], **context.header}


def _lower_sdf(root: XmlElement, context: Context) -> Mapping[str, Any]:
    """The data of the document that an `<sdf>` makes, by the schema reader alone."""
    return {"format": "sdf", **reader("sdf", context.version).read(root, context)}


_FRONT_ENDS: dict[str, tuple[str, Lower, Callable[[XmlElement, Context], Document | None]]] = {
    "robot": ("urdf", _lower_urdf, urdf.build),
    "sdf": ("sdf", _lower_sdf, sdf.build),
}
