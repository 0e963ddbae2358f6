"""What the case files show of each row: what became of it in the other format, and which rules spoke of it."""

from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

from lxml import etree

import twinform
from generators.mapping.file_rows import TablePart, parts
from testbed.corpus.files import ROOT
from testbed.corpus.there_and_back import robots
from twinform.compiler.audit import bare_path, fates
from twinform.diagnostics import Diagnostic, LedgerEntry, Location, Severity
from twinform.ir import Document, Format
from twinform.schemas import XmlElement, path_of, table
from twinform.server.mapping import MappingRow

CASES = ROOT / "tests" / "cases"
EXPRESSED = "expressed"
_FOLDERS = ("convert", "elements", "whole", "includes", "check")
"""Where cases of one file each are; the first one that has a row is the one that a reader is sent to."""
_Key = tuple[int, str]
"""A line, and the path of what begins there."""
PARTS = CASES / "includes" / "parts"
"""The models that the cases include."""


@dataclass(frozen=True, slots=True, order=True)
class Proof:
    """A case file that has the row; those of an earlier folder, and of few rows, show it best."""

    folder: int
    size: int
    path: str


@dataclass(slots=True)
class Seen:
    """What became of a row in all case files, which rules had findings, and the file to open."""

    fates: Counter[str] = field(default_factory=Counter[str])
    ledger: Counter[str] = field(default_factory=Counter[str])
    rules: dict[str, Severity] = field(default_factory=dict[str, Severity])
    proof: Proof | None = None

    def at(self, proof: Proof) -> None:
        """Keep the better one of two files."""
        if self.proof is None or proof < self.proof:
            self.proof = proof


def case_files() -> Iterator[tuple[int, Path]]:
    """All case files of one format, each with the number of its folder."""
    for number, folder in enumerate(_FOLDERS):
        for path in sorted((CASES / folder).iterdir()):
            if path.suffix in {".urdf", ".sdf"} and ".expected" not in path.name:
                yield number, path


@cache
def measured() -> dict[MappingRow, Seen]:
    """All case files read, and converted to the other format where that is possible."""
    seen: dict[MappingRow, Seen] = defaultdict(Seen)
    for folder, path in case_files():
        _measure(folder, path, seen)
    return dict(seen)


def _measure(folder: int, path: Path, seen: dict[MappingRow, Seen]) -> None:
    checked = twinform.check(path)
    root = _tree(path)
    if root is None:
        return
    here = _by_location(root)
    _note(checked.diagnostics, here, seen)
    if not checked.accepted or checked.document is None:
        return
    for part in here.values():
        seen[part.row].at(Proof(folder, len(here), path.relative_to(ROOT).as_posix()))
    for converted in conversions(path, checked.document):
        if isinstance(converted, twinform.Conversion):
            _count(converted, seen)
        _note(converted.diagnostics, here, seen)


def conversions(
    path: Path, document: Document, *, carriers: bool = True
) -> Iterator[twinform.Conversion | twinform.CompileError]:
    """The file, or each robot in it, in the other format; the error where it is refused."""
    to = "urdf" if document.format is Format.SDF else "sdf"
    for robot in robots(document) if to == "urdf" else [None]:
        try:
            yield twinform.convert(path, to=to, model=robot, carriers=carriers, paths=(PARTS,))
        except twinform.CompileError as error:
            yield error


def _count(converted: twinform.Conversion, seen: dict[MappingRow, Seen]) -> None:
    assert converted.source is not None
    rows = {(part.element, part.attribute): part.row for part in parts(converted.source)}
    entries = {_key(entry.location): entry for entry in reversed(converted.ledger.entries)}
    for met in fates(converted.source, converted.text, converted.ledger):
        row = rows.get((met.element, met.attribute))
        if row is None:
            continue
        seen[row].fates[str(met.fate or EXPRESSED)] += 1
        if met.fate is not None and (entry := _covering(met.element, met.attribute, entries)) is not None:
            seen[row].ledger[entry.rule.name] += 1


def _covering(element: XmlElement, attribute: str | None, entries: dict[_Key, LedgerEntry]) -> LedgerEntry | None:
    """The entry of the ledger that is about a part, or about the nearest element around it that has one."""
    if attribute is not None and (own := entries.get((_line(element), f"{_bare(element)}/@{attribute}"))):
        return own
    around: XmlElement | None = element
    while around is not None:
        if (entry := entries.get((_line(around), _bare(around)))) is not None:
            return entry
        around = around.getparent()
    return None


def _note(diagnostics: Iterable[Diagnostic], here: dict[_Key, TablePart], seen: dict[MappingRow, Seen]) -> None:
    for each in diagnostics:
        if (part := here.get(_key(each.location))) is not None:
            seen[part.row].rules[each.rule.name] = each.severity


def _by_location(root: XmlElement) -> dict[_Key, TablePart]:
    return {
        (_line(part.element), _bare(part.element) + (f"/@{part.attribute}" if part.attribute else "")): part
        for part in parts(root)
    }


def _key(location: Location) -> _Key:
    return location.line, bare_path(location.path)


def _line(element: XmlElement) -> int:
    return element.sourceline or 0


def _bare(element: XmlElement) -> str:
    return bare_path(path_of(element))


def _tree(path: Path) -> XmlElement | None:
    """The XML of a case; None where it is not one of the two formats, or of no version that there is."""
    try:
        root = etree.fromstring(path.read_bytes())
    except etree.XMLSyntaxError:
        return None
    if root.tag not in {"robot", "sdf"}:
        return None
    versions = table("urdf" if root.tag == "robot" else "sdf").versions
    return root if str(root.get("version") or versions[0]) in versions else None
