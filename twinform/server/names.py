"""Names at their place in a text, and those of xacro: macros, parameters, properties, arguments, and references."""

from collections.abc import Iterator, Mapping
from typing import NamedTuple

from twinform.compiler.input.xacro_mistakes import MACRO_PARAMETER
from twinform.dataclass import dataclass
from twinform.diagnostics import Span
from twinform.lazy import lazy_pattern
from twinform.passes.structure.rename_parts import LOOKUP_ORDER
from twinform.server.model_text import ModelText
from twinform.server.schema import PREFIX
from twinform.server.tolerant_tree import TolerantNode


@dataclass(frozen=True, slots=True)
class Name:
    """A name at its place in a text, where it is defined or referred to.

    `kind` is the kind of thing that has the name, such as `link`, or the kind of reference. `scope` is the model in
    which the name counts; None if the format, or the kind, has a single scope.
    """

    text: str
    span: Span
    node: TolerantNode
    kind: str
    defines: bool
    scope: TolerantNode | None = None

    @property
    def kinds(self) -> tuple[str, ...]:
        """The kinds of things that the name may mean."""
        if self.defines or self.kind == "material":
            return (self.kind,)
        orders: Mapping[str, tuple[str, ...]] = {**LOOKUP_ORDER}
        return orders.get(self.kind, (self.kind,))


ELEMENTS: dict[str, tuple[tuple[str, ...], tuple[str, ...], str]] = {
    "macro": (("name", "params"), (), "A piece of the model with parameters, to be used by its name."),
    "property": (("name", "value"), ("default", "scope", "remove", "lazy_eval"), "A value, or a block, with a name."),
    "arg": (("name",), ("default",), "An argument of the file, which whoever reads it may give."),
    "include": (("filename",), ("ns", "optional"), "Another file, whose content stands here."),
    "if": (("value",), (), "What is in it stands here if the value is true."),
    "unless": (("value",), (), "What is in it stands here if the value is false."),
    "insert_block": (("name",), (), "The block that was given to the macro, or a property that holds one."),
    "call": (("macro",), (), "A macro whose name is known only when it is expanded."),
    "element": (("xacro:name",), (), "An element whose name is known only when it is expanded."),
    "attribute": (("name", "value"), (), "An attribute of the element around it, whose name may be an expression."),
}
"""The elements of xacro: required attributes, optional attributes, and meaning."""
XACRO_KINDS = frozenset({"macro", "property", "arg", "param"})
_DEFINES = {"xacro:macro": "macro", "xacro:property": "property", "xacro:arg": "arg"}
_EXPRESSION = lazy_pattern(r"\$\{(?P<expression>[^}]*)\}?|\$\(arg\s+(?P<arg>[^\s)]+)")
_WORD = lazy_pattern(r"""'[^']*'|"[^"]*"|(?<![\w.])(?P<word>[A-Za-z_]\w*)""")
_RESERVED = frozenset(["and", "or", "not", "if", "else", "for", "in", "is", "True", "False", "None", "lambda"])


def xacro_names(document: ModelText) -> Iterator[Name]:
    """Yield all names of xacro in a document."""
    if "xacro" not in document.text:
        return
    for node in document.tree.nodes:
        if node.tag.startswith(PREFIX):
            yield from _names_of_element(node)
        if "$" in node.start_tag.of(document.text):
            for attribute, span in node.attributes.items():
                yield from _names_in_expressions(node.values[attribute], span.value.start, node)
        if not node.children and not node.empty and node.closed:
            inside = node.content
            yield from _names_in_expressions(inside.of(document.text), inside.start, node)


class MacroParameter(NamedTuple):
    """A parameter of a macro: `needed` if it has no default; a `block` takes an element instead of a value."""

    name: str
    written: str
    needed: bool
    block: bool


def parameter_names(macro: TolerantNode) -> list[MacroParameter]:
    """Return the parameters of a macro, in their order."""
    return [
        MacroParameter(found["name"], found[0], "=" not in found[0] and found[0][0] != "*", found[0][0] == "*")
        for found in MACRO_PARAMETER.finditer(macro.get("params") or "")
    ]


def _names_of_element(node: TolerantNode) -> Iterator[Name]:
    kind = _DEFINES.get(node.tag)
    called = node.get("name")
    if kind is not None and called:
        yield Name(called, node.attributes["name"].value, node, kind, defines=True)
    if node.tag == "xacro:macro" and "params" in node.attributes:
        start = node.attributes["params"].value.start
        for found in MACRO_PARAMETER.finditer(node.values["params"]):
            span = Span(start + found.start("name"), start + found.end("name"))
            yield Name(found["name"], span, node, "param", defines=True, scope=node)
    if node.tag == "xacro:insert_block" and called:
        yield Name(called, node.attributes["name"].value, node, "property", defines=False)
    if node.tag == "xacro:call" and node.get("macro"):
        yield Name(node.values["macro"], node.attributes["macro"].value, node, "macro", defines=False)
    local = node.tag.removeprefix(PREFIX)
    if local and local not in ELEMENTS:
        yield from _names_of_call(node, local)


def _names_of_call(node: TolerantNode, macro: str) -> Iterator[Name]:
    yield Name(macro, Span(node.name.start + len(PREFIX), node.name.end), node, "macro", defines=False)
    if node.end_tag is not None:
        start = node.end_tag.start + len("</") + len(PREFIX)
        yield Name(macro, Span(start, start + len(macro)), node, "macro", defines=False)


def _names_in_expressions(text: str, start: int, node: TolerantNode) -> Iterator[Name]:
    for found in _EXPRESSION.finditer(text):
        if found["arg"]:
            yield Name(
                found["arg"], Span(start + found.start("arg"), start + found.end("arg")), node, "arg", defines=False
            )
            continue
        inside = start + found.start("expression")
        for word in _WORD.finditer(found["expression"]):
            if word["word"] and word["word"] not in _RESERVED:
                span = Span(inside + word.start("word"), inside + word.end("word"))
                yield Name(word["word"], span, node, "property", defines=False)
