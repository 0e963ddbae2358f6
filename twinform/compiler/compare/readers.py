"""Which parts of a file each reader sees, and how the comparisons for several readers become one.

Only twinform reads *carriers*, and only Gazebo and twinform read links, joints and frames in the `<gazebo>` elements of
URDF. They are removed here, so the comparison itself does not depend on the reader.
"""

from collections.abc import Callable, Hashable, Iterable
from dataclasses import replace
from enum import StrEnum
from typing import Any, TypeVar

from twinform.compiler.compare.comparison import Difference, DifferenceSeverity
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Document, Opaque
from twinform.passes.carriers.carriers import (
    is_carrier,
    is_ours,
    without_bodies_for_gazebo,
    without_ours,
    without_parts,
)
from twinform.passes.sdf_versions.replace_shapes import fold_capsules


class ComparingReader(StrEnum):
    """A reader of a file. Each one sees everything that the readers listed before it see, and more."""

    ANY = "any"
    GAZEBO = "gazebo"
    TWINFORM = "twinform"


_ALONE = {ComparingReader.GAZEBO: "only Gazebo and twinform read", ComparingReader.TWINFORM: "only twinform reads"}


def as_read_by(
    document: Document, readers: Iterable[ComparingReader], *, of_mjcf: bool = False
) -> dict[ComparingReader, Document]:
    """Return the document without the parts that each reader skips; readers that see the same share one object.

    What only MJCF says is a carrier elsewhere, and in a file `of_mjcf` it is there for all readers.
    """
    if (wanted := [*readers]) == [ComparingReader.TWINFORM]:
        return {ComparingReader.TWINFORM: document}
    # A plane that a URDF holds in a carrier is there for twinform alone: RViz, Drake and MuJoCo
    # see no collision. What a reader skips is taken away here, before anything is compared. The
    # parts of a capsule are what the capsule is, for everybody.
    folded = fold_capsules(document, DiagnosticSink())
    bare = without_parts(folded, _is_ours_in_mjcf) if of_mjcf else without_ours(folded)
    seen = {
        ComparingReader.ANY: without_bodies_for_gazebo(bare),
        ComparingReader.GAZEBO: bare,
        ComparingReader.TWINFORM: document,
    }
    return {reader: seen[reader] for reader in wanted}


def _is_ours_in_mjcf(part: Opaque) -> bool:
    return is_ours(part) and not is_carrier(part, "mjcf")


def reconcile(
    found: Iterable[Difference], seen: Iterable[Difference], reader: ComparingReader, files: tuple[str, str]
) -> list[Difference]:
    """Merge what a reader has `seen` into the differences `found` for readers that see less of the files.

    A difference that only some readers see becomes `carried`.
    """
    known, found = {_key(each) for each in seen if _is_difference(each)}, list(found)
    before = {_key(each) for each in found if _is_difference(each)}
    items = [each if _key(each) in known else _seen_as_same(each, reader, files) for each in found]
    items += [_seen_by_one(each, reader) for each in seen if _is_difference(each) and _key(each) not in before]
    places = {heading: place for place, heading in reversed([*enumerate(map(_heading, items))])}
    return sorted(items, key=lambda each: places[_heading(each)])


def _is_difference(item: Difference) -> bool:
    return item.severity is not DifferenceSeverity.NOTE


def _heading(item: Difference) -> tuple[str, ...]:
    return item.model, item.group, item.name


def _key(item: Difference) -> tuple[str, ...]:
    """Identify a difference without its values; in kinematics, which link is furthest off depends on the reader."""
    name = "" if item.group == "kinematics" else item.name
    return item.model, item.group, name, item.aspect


def _seen_as_same(item: Difference, reader: ComparingReader, files: tuple[str, str]) -> Difference:
    if item.severity is not DifferenceSeverity.DIFFERENCE:
        return item
    in_one = (item.a.text is None) != (item.b.text is None)
    what = f"it in {files[item.a.text is not None]}" if in_one else "them as the same"
    return _mark_carried(item, reader, f"{item.message}: {_ALONE[reader]} {what}")


def _seen_by_one(item: Difference, reader: ComparingReader) -> Difference:
    return _mark_carried(item, reader, f"{item.message}: {_ALONE[reader]} this")


def _mark_carried(item: Difference, reader: ComparingReader, message: str) -> Difference:
    return replace(item, severity=DifferenceSeverity.CARRIED, reader=str(reader), message=message)


Made = TypeVar("Made")


class Memo:
    """Results for one reader, reused for the next one where both see the same; it keeps the last result of each key."""

    def __init__(self) -> None:
        self._known: dict[Hashable, tuple[object, Any]] = {}

    def once(
        self, key: Hashable, given: object, make: Callable[[], Made], lasts: Callable[[Made], bool] = lambda _: True
    ) -> Made:
        """Return the result of `make`, or the last one that was made from something equal to `given`.

        A result is only kept if it `lasts`, that is, if it depends on nothing but `given`.
        """
        known = self._known.get(key)
        if known is not None and known[0] == given:
            return known[1]
        made = make()
        if lasts(made):
            self._known[key] = given, made
        return made
