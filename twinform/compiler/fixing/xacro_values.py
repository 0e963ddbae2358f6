"""Where the values of an expanded xacro file were written: in their place, in a property, an argument or a call.

A value is followed from name to name while it is nothing but a name, such as `${mass}`, up to the text that is one.
What is made by an expression has no such text. Names are looked up as xacro does: in the macro that is being expanded,
in those from which it was called, and then among all.
"""

from collections import defaultdict
from collections.abc import Iterable, Iterator
from dataclasses import field
from functools import cached_property
from pathlib import PurePath
from typing import NamedTuple

from twinform.compiler.input.expansion import Expansion, MacroCall
from twinform.compiler.input.parsing import parse
from twinform.compiler.input.size_limits import LIFTED_LIMITS
from twinform.compiler.input.xacro_mistakes import EXPRESSION, MACRO_PARAMETER, WORD, xacro_kind
from twinform.dataclass import dataclass
from twinform.diagnostics import DiagnosticSink, Span
from twinform.lazy import lazy_pattern
from twinform.schemas import XmlElement
from twinform.text import ElementSpan, Lines, SourceText, TextSurroundings, spans

_NAME = lazy_pattern(r"\s*\$\{\s*(?P<name>[A-Za-z_]\w*)\s*\}\s*|\s*\$\(arg\s+(?P<argument>[\w.-]+)\s*\)\s*")
_DEFAULT = lazy_pattern(r"""\s*:?=\s*(?P<quote>["']?)(?P<value>[^"'^|]*)(?P=quote)$""")
"""The default of a parameter of a macro, behind its name."""
_MOST_STEPS = 100
"""So many names are followed, which may lead back to the first."""
_PLAIN = frozenset({"name", "value"})
_OF_XACRO = frozenset(
    {"arg", "attribute", "call", "element", "if", "include", "insert_block", "macro", "property", "unless"}
)
MADE = "xacro makes it"
"""Why there is no fix for what stands in no file."""
_ARGUMENTS = "$(arg)"
"""The scope of the arguments of a file."""


class ComputedError(Exception):
    """A value, or the name of an element, is not written anywhere as it is; the message says what makes it."""


class Slot(NamedTuple):
    """A place of a value: an attribute of an element, numbered in its file, or its text where `attribute` is empty.

    It may be the default of one `parameter` in the attribute of a macro that has them all.
    """

    file: str
    number: int
    attribute: str = ""
    parameter: str = ""


class Name(NamedTuple):
    """The name of a property, parameter or argument, and the macro that it is known in, or empty."""

    scope: str
    name: str


class Written(NamedTuple):
    """Where a value is written, and the names that lead there."""

    slot: Slot
    names: tuple[Name, ...] = ()


@dataclass(frozen=True)  # no slots: the surroundings are kept in the dictionary
class XacroSource:
    """The text of a xacro file with its elements and their places, by number."""

    source: SourceText
    elements: list[XmlElement] = field(repr=False)
    places: list[ElementSpan] = field(repr=False)

    @classmethod
    def of(cls, data: bytes) -> "XacroSource":
        """Read a file that xacro has read."""
        source = SourceText.of(data)
        root = parse(data, DiagnosticSink(), LIFTED_LIMITS)
        return cls(source, [*root.iter("*")], [*spans(source.text).walk()])

    @cached_property
    def around(self) -> TextSurroundings:
        """The text, with its layout."""
        return TextSurroundings.of(self.source, self.places[0])

    @cached_property
    def lines(self) -> Lines:
        """The lines of the text."""
        return Lines(self.source.text)


class _Macro(NamedTuple):
    """A definition of a macro, its parameters, and where these are written."""

    name: str
    parameters: frozenset[str]
    slot: Slot


class XacroValues:
    """Finds where values of an expansion were written."""

    def __init__(self, expansion: Expansion) -> None:
        """Read all files of an expansion.

        Raises:
            UnreadableError, ValueError: one of them cannot be read as XML.
        """
        self.calls = expansion.calls
        self.sources = {name: XacroSource.of(data) for name, data in expansion.texts.items() if _is_xml(data)}
        self._macros: defaultdict[str, list[_Macro]] = defaultdict(list)
        self._definitions: defaultdict[Name, list[Slot]] = defaultdict(list)
        self._names = frozenset(self._read_definitions())

    def value(self, slot: Slot) -> str:
        """Return what stands in a slot.

        Raises:
            ComputedError: there is nothing, or an element.
        """
        element = self.sources[slot.file].elements[slot.number]
        found = element.get(slot.attribute) if slot.attribute else None if len(element) else element.text or ""
        if found is not None and slot.parameter:
            default = default_of(slot.parameter, found)
            found = default and default.of(found)
        if found is None:
            raise ComputedError(MADE)
        return found

    def place(self, slot: Slot) -> str:
        """Return the file and line of a slot in words."""
        return f"{PurePath(slot.file).name}:{self.sources[slot.file].elements[slot.number].sourceline}"

    def written(self, slot: Slot, call: int) -> Written:
        """Return where the value of a slot is written, in the expansion of a call or, for 0, outside of all.

        Raises:
            ComputedError: nowhere, or in a place that is not certain.
        """
        names: list[Name] = []
        for _ in range(_MOST_STEPS):
            value = self.value(slot)
            if "$" not in value:
                return Written(slot, tuple(names))
            found = _NAME.fullmatch(value)
            if found is None:
                raise ComputedError(f"the value comes from {value.strip()}")
            slot, call, name = self._definition(slot, found["name"], found["argument"], call)
            names.append(name)
        raise ComputedError("the value comes from names that lead in a circle")

    def is_tangled(self, name: Name) -> bool:
        """Tell whether a name is used in an expression with others, or by xacro itself."""
        return not self._tangled.isdisjoint({name, Name("", name.name)})

    def _definition(self, slot: Slot, name: str | None, argument: str | None, call: int) -> tuple[Slot, int, Name]:
        """Return the slot that a name stands for, the call in which that is evaluated, and the name in its scope."""
        if name is None:
            key = Name(_ARGUMENTS, argument or "")
            return self._only(key), 0, key
        macro = self._macro_around(slot)
        while macro:
            call = self._call_of(macro, call)
            around = self.calls[call - 1]
            key = Name(macro, name)
            if name in self._macro(macro).parameters:
                return self._passed(around, macro, name), around.around, key
            if key in self._definitions:
                return self._only(key), call, key
            call = around.around
            macro = self._called(self.calls[call - 1]) if call else ""
        key = Name("", name)
        return self._only(key), 0, key

    def _only(self, key: Name) -> Slot:
        found = self._definitions.get(key, ())
        if len(found) != 1:
            count = f"is defined {len(found)} times" if found else "is not defined by a value"
            raise ComputedError(f"the value comes from {key.name!r}, which {count}")
        return found[0]

    def _passed(self, call: MacroCall, macro: str, name: str) -> Slot:
        """Return the slot of a parameter in a call, or that of its default."""
        if name in self.sources[call.file].elements[call.number].attrib:
            return Slot(call.file, call.number, name)
        return self._macro(macro).slot._replace(parameter=name)

    def _macro(self, name: str) -> _Macro:
        found = self._macros.get(name, ())
        if len(found) != 1:
            raise ComputedError(f"the value comes from the macro {name!r}, which is not defined once")
        return found[0]

    def _call_of(self, macro: str, call: int) -> int:
        """Return the innermost call of a macro, from a call outwards."""
        while call and self._called(self.calls[call - 1]) != macro:
            call = self.calls[call - 1].around
        if not call:
            raise ComputedError(f"the value comes from the macro {macro!r}")
        return call

    def _called(self, call: MacroCall) -> str:
        return xacro_kind(self.sources[call.file].elements[call.number]).rpartition(".")[2]

    def _macro_around(self, slot: Slot) -> str:
        """Return the name of the macro around a slot; empty where there is none."""
        return _macro_around(self.sources[slot.file].elements[slot.number])

    def _read_definitions(self) -> Iterator[Name]:
        """Note all definitions, and yield the names of those in macros."""
        for file, source in self.sources.items():
            for number, element in enumerate(source.elements):
                kind, name = xacro_kind(element), element.get("name", "").removeprefix("xacro:")
                if kind == "macro":
                    parameters = {one["name"] for one in MACRO_PARAMETER.finditer(element.get("params", ""))}
                    self._macros[name].append(_Macro(name, frozenset(parameters), Slot(file, number, "params")))
                    yield from (Name(name, each) for each in parameters)
                if kind == "arg":
                    self._definitions[Name(_ARGUMENTS, name)].append(Slot(file, number, "default"))
                if kind == "property":
                    scope = Name(_macro_around(element), name)
                    # a default, or a value for another scope, may or may not count
                    counts = 1 if _PLAIN.issuperset(map(str, element.keys())) else 2
                    self._definitions[scope] += [Slot(file, number, "value")] * counts
                    yield scope

    @cached_property
    def _tangled(self) -> frozenset[Name]:
        """The names in expressions with others, or in conditions, and those whose value goes to such a name."""
        found: set[Name] = set()
        sources_of: defaultdict[Name, set[Name]] = defaultdict(set)
        for source in self.sources.values():
            for element in source.elements:
                for attribute, value in _values(element):
                    if "$" not in value:
                        continue
                    names = {*self._names_in(element, value)}
                    goal = self._goal(element, attribute) if _NAME.fullmatch(value) else None
                    if goal:
                        sources_of[goal] |= names
                    elif goal is None:
                        found |= names
        pending = list(found)
        while pending:
            name = pending.pop()
            pending += sources_of[name] - found
            found |= sources_of[name]
        return frozenset(found)

    def _names_in(self, element: XmlElement, value: str) -> Iterator[Name]:
        macro = _macro_around(element)
        for expression in EXPRESSION.findall(value):
            for word in WORD.findall(expression):
                own = Name(macro, word)
                yield own if own in self._names else Name("", word)
                yield Name(_ARGUMENTS, word)

    def _goal(self, element: XmlElement, attribute: str) -> Name | tuple[()] | None:
        """Return the name that takes a value which is a single name: nothing where a part of the robot takes it."""
        kind = xacro_kind(element)
        if not kind:
            return ()
        if kind == "property" and attribute == "value":
            return Name(_macro_around(element), element.get("name", ""))
        return Name(kind.rpartition(".")[2], attribute) if kind not in _OF_XACRO and attribute else None


def default_of(parameter: str, written: str) -> Span | None:
    """Return where the default of a parameter stands among all of a macro, without quotes; None where it has none."""
    found = next((each for each in MACRO_PARAMETER.finditer(written) if each["name"] == parameter), None)
    default = _DEFAULT.match(written, found.end("name"), found.end()) if found else None
    return Span(*default.span("value")) if default else None


def _macro_around(element: XmlElement) -> str:
    around = (each for each in element.iterancestors("*") if xacro_kind(each) == "macro")
    macro = next(around, None)
    return "" if macro is None else macro.get("name", "").removeprefix("xacro:")


def _values(element: XmlElement) -> Iterable[tuple[str, str]]:
    """Return the attributes of an element with their names, and the texts in it and behind it."""
    return (
        *((str(key), str(value)) for key, value in element.items()),
        ("", element.text or ""),
        ("", element.tail or ""),
    )


def _is_xml(data: bytes) -> bool:
    return data.lstrip(b"\xef\xbb\xbf \t\r\n")[:1] == b"<"
