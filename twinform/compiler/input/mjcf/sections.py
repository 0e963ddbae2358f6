"""The sections of a canonical MJCF file, and which model an element outside of the bodies is about."""

from collections.abc import Iterable, Mapping, Sequence

from twinform.compiler.input.mjcf.pieces import Piece
from twinform.schemas.facts import named_kinds

_IN_TREES = frozenset({"body", "joint", "freejoint", "geom", "site", "camera", "light"})
"""What stands in a tree of bodies and may have a name."""
_OWNED = frozenset({*_IN_TREES, "tendon", "actuator"})
"""The kinds of parts that are in one tree, or about one."""
_BY_TYPE: Mapping[str, str] = {"objname": "objtype", "refname": "reftype"}
"""Attributes that name a part whose kind stands in another one."""


class Sections:
    """The children of the root by their tags; a section may stand there several times."""

    def __init__(self, root: Piece) -> None:
        self._by_tag: dict[str, list[Piece]] = {}
        for each in root.inside:
            self._by_tag.setdefault(each.tag, []).append(each)

    def of(self, tag: str) -> tuple[Piece, ...]:
        """Return the sections of a name."""
        return tuple(self._by_tag.get(tag, ()))

    def inside(self, tag: str) -> tuple[Piece, ...]:
        """Return what is in all sections of a name."""
        return tuple(each for section in self.of(tag) for each in section.inside)

    @property
    def tags(self) -> tuple[str, ...]:
        """The names of the sections."""
        return tuple(self._by_tag)

    @property
    def all(self) -> tuple[Piece, ...]:
        """All sections, those of one name together."""
        return tuple(each for found in self._by_tag.values() for each in found)


class Owners:
    """Which model each named part of a file is in, counted from 0; a model is made of one tree of bodies or more."""

    def __init__(self, models: Sequence[Sequence[Piece]], sections: Sections) -> None:
        self._models: dict[tuple[str, str], int] = {}
        self._sections = sections
        self._about: dict[str, dict[int | None, list[Piece]]] = {}
        for number, trees in enumerate(models):
            for each in (part for tree in trees for part in tree.walk()):
                if each.tag in _IN_TREES and each.name is not None:
                    kind = "joint" if each.tag == "freejoint" else each.tag
                    self._models.setdefault((kind, each.name), number)
        # tendons go over joints and sites, and actuators pull at tendons
        for kind in ("tendon", "actuator"):
            for each in sections.inside(kind):
                owner = self.of(each)
                if owner is not None and each.name is not None:
                    self._models.setdefault((kind, each.name), owner)

    def about(self, number: int, tag: str) -> Sequence[Piece]:
        """Return the elements of all sections of a name that are about one model alone."""
        if tag not in self._about:
            found = self._about[tag] = {}
            for each in self._sections.inside(tag):
                found.setdefault(self.of(each), []).append(each)
        return self._about[tag].get(number, ())

    def of_part(self, kind: str, name: str) -> int | None:
        """Return the model that a named part is in."""
        return self._models.get((kind, name))

    def of(self, piece: Piece) -> int | None:
        """Return the one model that all parts which an element names are in; None where there are none or several."""
        found = {model for each in piece.walk() for model in self._named(each)}
        return found.pop() if len(found) == 1 else None

    def _named(self, piece: Piece) -> Iterable[int]:
        kinds = named_kinds("mjcf")
        for attribute in piece.attributes:
            kind, name = kinds.get(attribute), piece.peek(attribute)
            if kind in _OWNED and name is not None:
                yield self._models.get((kind, name), -1)
        for attribute, type_ in _BY_TYPE.items():
            name, kind = piece.peek(attribute), piece.peek(type_)
            if name is not None and kind is not None:
                yield self._models.get((kind.removeprefix("x"), name), -1)
