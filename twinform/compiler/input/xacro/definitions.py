"""What the expansion of a file has met: where properties and macros are defined, and which are being used."""

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from twinform.compiler.input.xacro.places import FileLine, place_of


class Call(NamedTuple):
    """A macro that is being expanded, and where it is called."""

    macro: str
    place: FileLine


class Definitions:
    """The definitions so far; `files` returns those that are being read, the outermost first."""

    def __init__(self, files: Callable[[], Sequence[str]]) -> None:
        self.here: FileLine | None = None
        self.properties: dict[str, FileLine | None] = {}
        self.macros: dict[str, FileLine | None] = {}
        self.calls: list[Call] = []
        self.files = files

    def note(self, function: str, node: Any) -> None:
        """Note the element, and the definition, that a function of xacro is about to read."""
        self.here = place_of(node)
        known = {"grab_property": self.properties, "grab_macro": self.macros}.get(function)
        if known is not None:
            known[node.getAttribute("name").removeprefix("xacro:")] = self.here

    def begin_call(self, node: Any) -> bool:
        """Note a call, if the element is one."""
        place = place_of(node)
        if place is None or not node.tagName.startswith("xacro:"):
            return False
        self.calls.append(Call(node.tagName.removeprefix("xacro:"), place))
        return True

    def around(self) -> str:
        """Say which macro is being expanded, and where it is called."""
        # The parameters of a call are evaluated outside of the macro.
        inside = [call for call in self.calls if call.macro in self.macros and call.place != self.here]
        if not inside:
            return ""
        macro, (file, line) = inside[-1]
        return f" (in macro {macro!r}, called at {Path(file).name}:{line})"

    def circle(self) -> str:
        """Say which files include each other, or which macros call each other; empty where none do."""
        files = _circle([Path(file).name for file in self.files()])
        if files:
            return f"{files[0]} includes {', which includes '.join(files[1:])}"
        macros = [repr(name) for name in _circle([call.macro for call in self.calls])]
        if len(macros) == 2:
            return f"macro {macros[0]} calls itself without an end"
        return f"macro {macros[0]} calls {', which calls '.join(macros[1:])}, without an end" if macros else ""


def _circle(names: Sequence[str]) -> list[str]:
    """Return the names from one to where it comes again, beginning with the outermost of them."""
    last = {name: i for i, name in enumerate(names)}
    start = next((i for i, name in enumerate(names) if last[name] > i), None)
    if start is None:
        return []
    return [*names[start : names.index(names[start], start + 1)], names[start]]
