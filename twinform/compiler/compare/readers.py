"""What different readers see of one file: all of them, Gazebo alone, or twinform alone.

A *carrier* is of our namespace, and no other reader knows it. Links, joints and frames in the `<gazebo>` elements of
URDF are read by Gazebo. This is the only place that takes either away: the comparison itself does not know who reads.
"""

from collections.abc import Iterable
from dataclasses import replace
from enum import StrEnum

from twinform.compiler.compare.comparison import Difference, DifferenceSeverity
from twinform.ir import Document
from twinform.passes.carriers.carriers import without_bodies_for_gazebo, without_ours


class ComparingReader(StrEnum):
    """Who reads a file. Each one sees what the ones before it see, and more."""

    ANY = "any"
    GAZEBO = "gazebo"
    TWINFORM = "twinform"


_ALONE = {ComparingReader.GAZEBO: "only Gazebo and twinform read", ComparingReader.TWINFORM: "only twinform reads"}


def as_read_by(document: Document, readers: Iterable[ComparingReader]) -> dict[ComparingReader, Document]:
    """The document without what each reader skips; one object for readers that skip the same."""
    if (wanted := [*readers]) == [ComparingReader.TWINFORM]:
        return {ComparingReader.TWINFORM: document}
    # A capsule that a URDF holds in a carrier is there for twinform alone: RViz, Drake and MuJoCo
    # see no collision. What a reader skips is taken away here, before anything is compared.
    bare = without_ours(document)
    seen = {
        ComparingReader.ANY: without_bodies_for_gazebo(bare),
        ComparingReader.GAZEBO: bare,
        ComparingReader.TWINFORM: document,
    }
    return {reader: seen[reader] for reader in wanted}


def reconcile(
    found: Iterable[Difference], seen: Iterable[Difference], reader: ComparingReader, files: tuple[str, str]
) -> list[Difference]:
    """What readers found, after one that sees more has compared the two files too.

    A difference that only some of them see is `carried`.
    """
    known, found = {_key(each) for each in seen if _counts(each)}, list(found)
    before = {_key(each) for each in found if _counts(each)}
    items = [each if _key(each) in known else _seen_as_same(each, reader, files) for each in found]
    items += [_seen_by_one(each, reader) for each in seen if _counts(each) and _key(each) not in before]
    places = {heading: place for place, heading in reversed([*enumerate(map(_heading, items))])}
    return sorted(items, key=lambda each: places[_heading(each)])


def _counts(item: Difference) -> bool:
    return item.severity is not DifferenceSeverity.NOTE


def _heading(item: Difference) -> tuple[str, ...]:
    return item.model, item.group, item.name


def _key(item: Difference) -> tuple[str, ...]:
    """What differs; in kinematics the link that is furthest away depends on what is compared."""
    name = "" if item.group == "kinematics" else item.name
    return item.model, item.group, name, item.aspect


def _seen_as_same(item: Difference, reader: ComparingReader, files: tuple[str, str]) -> Difference:
    if item.severity is not DifferenceSeverity.DIFFERENCE:
        return item
    in_one = (item.a.text is None) != (item.b.text is None)
    what = f"it in {files[item.a.text is not None]}" if in_one else "them as the same"
    return _carried(item, reader, f"{item.message}: {_ALONE[reader]} {what}")


def _seen_by_one(item: Difference, reader: ComparingReader) -> Difference:
    return _carried(item, reader, f"{item.message}: {_ALONE[reader]} this")


def _carried(item: Difference, reader: ComparingReader, message: str) -> Difference:
    return replace(item, severity=DifferenceSeverity.CARRIED, reader=str(reader), message=message)
