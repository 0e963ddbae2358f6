"""The text of a model, whatever its state: its tree, its format, and what is made of it once."""

from collections.abc import Callable
from functools import cached_property
from typing import Any, Self, TypeVar

from twinform.dataclass import dataclass
from twinform.server.schema import FormatName, Schema, format_of
from twinform.server.tolerant_tree import Tree, parse

Made = TypeVar("Made")


@dataclass(frozen=True)  # no slots: what is made of the text is kept in the dictionary
class ModelText:
    """One state of a text, which need not be well-formed; its name or URI tells the format if its root does not."""

    uri: str
    text: str
    version: int | None = None
    language: str = ""

    @property
    def is_parsed(self) -> bool:
        """Whether its tree was made."""
        return "tree" in self.__dict__

    @cached_property
    def tree(self) -> Tree:
        """Its elements, even if it is not well-formed."""
        return parse(self.text)

    def once(self, make: "Callable[[Self], Made]") -> "Made":
        """Call a function with the text once, and return the same result every time."""
        known: dict[object, Any] = self.__dict__.setdefault("made", {})
        if make not in known:
            known[make] = make(self)
        return known[make]

    def release(self) -> None:
        """Release the tree, whose elements refer to each other: the garbage collector takes longer to find them."""
        if self.is_parsed:
            self.tree.release()

    @cached_property
    def schema(self) -> Schema:
        """The rows of the facts tables for its elements."""
        return Schema(self.tree, self.format)

    @property
    def format(self) -> FormatName | None:
        """Its format, by the root element or else by the name."""
        return format_of(self.tree, self.uri, self.language)
