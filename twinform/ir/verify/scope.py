"""The names that a place in a model or world can refer to."""

from collections.abc import Iterable, Iterator
from typing import Literal

from twinform.ir.model import Include, Model
from twinform.ir.node import Node
from twinform.ir.verify.verify_names import name_of
from twinform.ir.world import World

Found = Literal["link", "joint", "frame", "model", "unread", "twice"]
"""What a name stands for; `unread` where only the file of an include knows, `twice` where it means two things."""


class VerifiedScope:
    """One model or world. Names of what is in a nested model are written `model::name`, and so on inwards."""

    def __init__(self, holder: Model | World) -> None:
        self._kinds: dict[str, Found] = {}
        links = holder.links if isinstance(holder, Model) else ()
        self._add("link", links)
        self._add("joint", holder.joints)
        self._add("frame", holder.frames)
        self._add("model", holder.models)
        self._models = {model.name: model for model in holder.models}
        self._inner: dict[str, VerifiedScope] = {}
        self._unread = self._include(holder.includes)
        self._longest = max((len(name or "") for name in self._kinds), default=0)

    def _add(self, kind: Found, nodes: Iterable[Node]) -> None:
        for node in nodes:
            name = name_of(node)
            self._kinds[name] = "twice" if name in self._kinds else kind

    def _include(self, includes: Iterable[Include]) -> bool:
        """Enter the includes that say their name; whether there are others, whose names only their files know."""
        unread = False
        for include in includes:
            if include.name is None or include.merge:
                unread = True
            else:
                self._kinds.setdefault(include.name, "model")
        return unread

    def names(self, *kinds: Found) -> Iterator[str]:
        """The names of these kinds, or of all, without those in nested models."""
        return (name for name, kind in self._kinds.items() if not kinds or kind in kinds)

    def find(self, name: str) -> Found | None:
        """What a name stands for, as seen from here; None for nothing."""
        here = self._kinds.get(name)
        if here is not None:
            return here
        outer, colons, inner = name.partition("::")
        while colons and len(outer) <= self._longest:
            found = self._find_in(outer, inner)
            if found is not None:
                return found
            more, colons, inner = inner.partition("::")  # before 1.8 names may have `::` in them
            outer = f"{outer}::{more}"
        return "unread" if self._unread else None

    def _find_in(self, outer: str, inner: str) -> Found | None:
        if outer not in self._models:
            return "unread" if self._kinds.get(outer) == "model" else None
        if inner == "__model__":
            return "model"
        if outer not in self._inner:
            self._inner[outer] = VerifiedScope(self._models[outer])
        return self._inner[outer].find(inner)
