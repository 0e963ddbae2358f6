"""Finds includes with words that an older SDF version does not have, and that are something else without them."""

from collections.abc import Iterator

from twinform.ir import Document, Include, bits_of, census_of
from twinform.ir.scopes import nested_includes, outer_models
from twinform.schemas import Version, parse_version, version_read

_PLACEMENT_FRAMES = (1, 8)
_MERGING = (1, 9)
_MERGING_INTO_WORLDS = (1, 10)
"""The versions of SDF that brought `<placement_frame>`, and `merge` in models and in worlds."""


def newer_includes(document: Document, version: str) -> frozenset[int]:
    """The identities of the includes that have to be expanded before a document goes to an older version.

    A file that has newer words than its version stays as it is: libsdformat goes by the words.
    """
    if not census_of(document) & bits_of(Include):
        return frozenset()
    target = parse_version(version)
    own = version_read("sdf", document.version)
    return frozenset(id(include) for include, since in _with_versions(document) if target < min(since, own))


def _with_versions(document: Document) -> Iterator[tuple[Include, Version]]:
    """Each include with the first version that has all of its words."""
    for world in document.worlds:
        yield from ((include, _since(include, _MERGING_INTO_WORLDS)) for include in world.includes)
    inside = (include for model in outer_models(document) for include in nested_includes(model))
    yield from ((include, _since(include, _MERGING)) for include in (*document.includes, *inside))


def _since(include: Include, merging: Version) -> Version:
    if include.merge:
        return merging
    return _PLACEMENT_FRAMES if include.placement_frame is not None else (0, 0)
