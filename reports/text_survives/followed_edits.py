"""One model, converted, its result edited, and the edits patched into the model's own file."""

import difflib
import re
import tempfile
from collections import Counter
from dataclasses import dataclass
from enum import StrEnum
from functools import partial
from pathlib import Path
from random import Random

from lxml import etree

import twinform
from reports.text_survives.edit_jobs import MOST_BYTES, Job
from testbed.corpus.examine import rules_of
from testbed.edits import Edit, draw_edits
from testbed.edits.mistakes import KIND as MISTAKE
from twinform.compiler import ConversionRequest, Language, LoadOptions, SearchPath
from twinform.compiler.compare import ComparisonOptions, compare_files
from twinform.compiler.in_place import Updated
from twinform.compiler.into import convert_into
from twinform.schemas import XmlElement, versions_of

_VERSIONS = ("1.11",) * 7 + ("1.9", "1.8", "1.6")
_ELEMENT = re.compile(r"<\w")
_SLACK = 14
"""Changed lines that a patch may have more than the change has in our own layout: where authors break lines, and where
an inertial is written down that was left out."""


class Fate(StrEnum):
    """What became of an edit."""

    FOLLOWED = "followed"
    NOTHING = "says nothing new: not a byte changed"
    REFUSED = "refused, as its conversion is"
    CONFLICT = "refused: cannot be changed in place"
    UNPLACED = "refused: the file is not well-formed"
    FAULT = "fault"


@dataclass(frozen=True, slots=True)
class Followed:
    """One edit, what became of it, and how many lines of the file changed."""

    name: str
    to_urdf: bool
    kind: str
    fate: Fate
    lines: int = 0
    comments: int = 0
    faults: tuple[str, ...] = ()


def work(job: Job) -> list[Followed]:
    """Convert a file, and let it follow edits of the result."""
    random = Random(f"follow {job.seed} {job.name}")
    own: Language = "urdf" if job.is_urdf else "sdf"
    other: Language = "sdf" if job.is_urdf else "urdf"
    version = random.choice(_VERSIONS) if job.is_urdf else None
    try:
        made = twinform.convert(job.path, to=other, sdf_version=version, paths=job.paths).text.encode()
        back = twinform.convert(made, to=own, sdf_version=_version(job.path, own), paths=job.paths).text
    except twinform.CompileError:
        return []
    if len(made) > MOST_BYTES:
        return []
    return [_tried(job, made, back, *draw_edits(made, random)) for _ in range(job.edits)]


def _version(path: Path, format: str) -> str | None:
    document = twinform.check(path).document if format == "sdf" else None
    return document.version if document is not None and document.version in versions_of("sdf") else None


def _tried(job: Job, made: bytes, back: str, edits: tuple[Edit, ...], edited: bytes) -> Followed:
    kind = edits[0].kind if len(edits) == 1 else "several"
    kind = MISTAKE if any(each.kind == MISTAKE for each in edits) else kind
    own: Language = "urdf" if job.is_urdf else "sdf"
    try:
        whole = twinform.convert(edited, to=own, sdf_version=_version(job.path, own), paths=job.paths).text
    except twinform.CompileError:
        whole = None
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"edited.{'sdf' if job.is_urdf else 'urdf'}"
        path.write_bytes(edited)
        request = ConversionRequest(to=own)
        try:
            updated = convert_into(request, path, job.path, LoadOptions(search=SearchPath.of(job.paths)))
        except twinform.CompileError as error:
            return Followed(job.name, job.is_urdf, kind, *_refused(error, whole))
        except Exception as error:  # noqa: BLE001 - every other exception is a fault to report
            return Followed(job.name, job.is_urdf, kind, Fate.FAULT, faults=(f"{type(error).__name__}: {error}",))
    if whole is None:
        return Followed(job.name, job.is_urdf, kind, Fate.FAULT, faults=("its conversion is refused",))
    return _judged(job, kind, _States(made, back, edited, whole, job.path.read_bytes(), updated))


def _refused(error: twinform.CompileError, whole: str | None) -> tuple[Fate, int, int, tuple[str, ...]]:
    rules = rules_of(error.diagnostics)
    if "edit-conflict" not in rules:
        return (Fate.REFUSED, 0, 0, ()) if whole is None else (Fate.FAULT, 0, 0, (f"refused: {', '.join(rules)}",))
    if all(each.location.line for each in error.diagnostics if each.is_error):
        unplaced = any("not well-formed" in each.message or "line 1" in each.message for each in error.diagnostics)
        return (Fate.UNPLACED if unplaced else Fate.CONFLICT), 0, 0, ()
    return Fate.FAULT, 0, 0, ("a conflict without a line",)


@dataclass(frozen=True, slots=True)
class _States:
    """A conversion's result, converted back; the same after an edit; the own file, and what it becomes."""

    made: bytes
    back: str
    edited: bytes
    whole: str
    own: bytes
    updated: Updated

    @property
    def after(self) -> bytes:
        """What the own file becomes."""
        return self.updated.data


def _judged(job: Job, kind: str, states: _States) -> Followed:
    faults = _differences(job, states)
    changed, wanted = _changed(states.own, states.after), _changed(states.back.encode(), states.whole.encode())
    if changed > 2 * wanted + _SLACK:
        faults.append(f"{changed} lines change, {wanted} in our own layout")
    comments = _comments(states.own)
    deleted = "".join(change.old for change in states.updated.changes if _ELEMENT.search(change.old))
    lost = [each for each in comments - _comments(states.after) if each not in deleted]
    if lost:
        faults.append(f"comments are lost: {lost[:3]}")
    fate = Fate.FAULT if faults else Fate.FOLLOWED if states.own != states.after else Fate.NOTHING
    return Followed(job.name, job.is_urdf, kind, fate, changed, comments.total(), tuple(faults))


def _differences(job: Job, states: _States) -> list[str]:
    """What differs between the edited file and the one that follows it, and would not if that were written anew."""
    options, names = LoadOptions(search=SearchPath.of(job.paths)), (str(job.path), str(job.path))
    compared = partial(
        compare_files,
        load_options=options,
        options=ComparisonOptions(carriers=True),
        names=names,
        model=_robot(states.made),
    )
    try:
        found = compared(states.edited, states.after).differences
        pairs = ((states.made, states.own), (states.edited, states.whole.encode())) if found else ()
        known = {(each.group, each.name, each.aspect) for a, b in pairs for each in compared(a, b).differences}
    except twinform.CompileError as error:
        return [f"not compared: {error}"]
    return [each.message for each in found if (each.group, each.name, each.aspect) not in known]


def _robot(made: bytes) -> str | None:
    root = _tree(made)
    robot = root if root.tag == "robot" else root.find(".//model")
    return None if robot is None else robot.get("name")


def _changed(before: bytes, after: bytes) -> int:
    """How many lines go or come."""
    matcher = difflib.SequenceMatcher(None, before.splitlines(), after.splitlines(), autojunk=False)
    return sum(max(i2 - i1, j2 - j1) for tag, i1, i2, j1, j2 in matcher.get_opcodes() if tag != "equal")


def _comments(data: bytes) -> Counter[str]:
    return Counter(str(each.text).strip() for each in _tree(data).iter(etree.Comment))


def _tree(data: bytes) -> XmlElement:
    """The tree, also of a file with a slip that we repair, such as a prefix without a declaration."""
    return etree.fromstring(data, etree.XMLParser(recover=True))
