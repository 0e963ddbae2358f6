"""Judges edits: compares an edited file with what it is converted to. The edit has to win.

A converted file is edited and converted on. The robot of the edited file and that of the result have to be the same
twice: as `twinform diff` reads the edited file, and as somebody reads it who does not know our carriers, since nothing
that travels along may overrule what a person wrote. And the result is converted back once more, which has to give the
edited file's robot again. Where either file is MJCF, engines say so too, which read no carriers: see
`engines.py`. What already differs before the edit is not the edit's doing.
"""

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from types import MappingProxyType

from lxml import etree

from testbed.edits.edit import Edit, Rename
from testbed.edits.edited_file import EditedFile, Language, without_scenery
from testbed.edits.engines import NotReadError, differences_in_engines, is_refused_by_mujoco, is_static
from testbed.edits.mistakes import KIND as MISTAKE
from testbed.edits.plainly import Plainly, explained, plain_key
from twinform.compiler import CompileError, Conversion, check, convert
from twinform.compiler.compare import Difference, diff
from twinform.diagnostics import Diagnostic, Severity
from twinform.diagnostics.rules import OUTSIDE_MODEL, UNKNOWN_COLLISION

Key = tuple[str | None, ...]
"""What differs: group, name and aspect of a `Difference`; plainly, see `plain_key`."""
_KEPT = "/tf:mjcf/"
_MAY_BE_SAID = re.compile(r"^sensor '|/mimic$")
"""What an element that only MJCF has may become, once it says less."""


class Outcome(StrEnum):
    """What became of an edit; the last two are faults."""

    SAME = "same"
    WARNED = "same, with a warning"
    REFUSED = "refused"
    WRONG = "wrong"
    SILENT = "silent"


@dataclass(frozen=True, slots=True)
class Verdict:
    """What became of an edited file: the differences that the edit brought, or the rules that refuse it.

    `result` is what it was converted to, None where it was not; `explained` has the reasons why differences to the
    file without carriers do not count, if there are any.
    """

    outcome: Outcome
    differences: tuple[str, ...] = ()
    rules: tuple[str, ...] = ()
    result: str | None = None
    explained: tuple[str, ...] = ()

    @property
    def is_fault(self) -> bool:
        """Whether the edit did not win."""
        return self.outcome in {Outcome.WRONG, Outcome.SILENT}


@dataclass(frozen=True, slots=True)
class Converted:
    """A file that was converted, before any edit: what differs already when it is converted on."""

    text: bytes
    to: Language
    result: str
    differing: frozenset[Key] = frozenset()
    differing_plainly: frozenset[Key] = frozenset()
    differing_when_back: frozenset[Key] = frozenset()
    differing_in_engines: tuple[str, ...] = ()
    not_read: str = ""
    warnings: frozenset[str] = field(default=frozenset())


def unedited(text: bytes, to: Language | None = None) -> Converted:
    """The state before an edit of a file that is converted on `to` a language, or else to the other of URDF and SDF.

    Raises:
        CompileError: the file cannot be converted on.
    """
    file = EditedFile(text)
    to = to or ("sdf" if file.language == "urdf" else "urdf")
    made = convert(text, to=to)
    back = _back(file, made.text)
    found, plainly, when_back = _compared(file, made.text, back)
    in_engines, not_read = _in_engines(file, made, back, to)
    return Converted(
        text,
        to,
        made.text,
        frozenset(map(_key, found)),
        frozenset(map(plain_key, plainly)),
        frozenset(map(_key, when_back)),
        in_engines,
        not_read,
        _warnings(made.diagnostics),
    )


def judge(
    before: Converted,
    edited: bytes,
    *,
    must_be_refused: bool = False,
    plainly: Plainly = Plainly.ALL,
    names: Mapping[str, str] = MappingProxyType({}),
    kept: bool = False,
) -> Verdict:
    """What becomes of an edited file; no exception comes out of it.

    `names` are those that parts had before the edit, by those that they have now; `kept` is whether an element that is
    kept for MJCF was edited.
    """
    try:
        made = convert(edited, to=before.to)
    except CompileError as error:
        return _refused(error)
    except Exception as error:  # noqa: BLE001 - every exception is a fault to report
        return Verdict(Outcome.SILENT, (f"crash: {type(error).__name__}: {error}",))
    news = _warnings(made.diagnostics) - before.warnings
    fault = Outcome.WRONG if news else Outcome.SILENT
    warned = tuple(sorted(news))
    if must_be_refused:
        return Verdict(fault, ("it is not refused",), warned, made.text)
    file = EditedFile(edited)
    try:
        back = _back(file, made.text)
        compared, read, when_back = _compared(file, made.text, back)
        in_engines, not_read = _in_engines(file, made, back, before.to)
    except CompileError as error:
        if file.language == "mjcf" and is_refused_by_mujoco(file):  # it must not come back, and no trip goes on
            return _refused(error)
        return Verdict(fault, (f"not compared: {error}",), warned, made.text)
    except Exception as error:  # noqa: BLE001 - a result that cannot be read is no result
        return Verdict(fault, (f"not compared: {type(error).__name__}: {error}",), warned, made.text)
    compared, when_back = (_about_what_is_there(each, edited) for each in (compared, when_back))
    if is_static(file.root):
        compared, when_back = map(_without_holds, (compared, when_back))
    if kept:
        compared, when_back = map(_without_what_was_kept, (compared, when_back))
    found = [each.message for each in compared if _before(each, names) not in before.differing]
    news_plainly = [each for each in read if plain_key(each) not in before.differing_plainly]
    reasons = [explained(each, plainly, file) for each in news_plainly]
    differed = "an engine sees a difference before any edit" if before.differing_in_engines else ""
    # MuJoCo does not see what somebody has edited in a carrier, and that is to count.
    carried = "a carrier itself was edited, which is to count" if in_engines and plainly is Plainly.NONE else ""
    why = differed or before.not_read or not_read or carried
    if not why:
        found += [f"in an engine: {each}" for each in in_engines]
    known_back = before.differing_when_back
    found += [f"when it is back: {each.message}" for each in when_back if _before(each, names) not in known_back]
    found += [f"plainly: {each.message}" for each, reason in zip(news_plainly, reasons, strict=True) if reason is None]
    outcome = fault if found else Outcome.WARNED if news else Outcome.SAME
    known = {reason for reason in (*reasons, why) if reason}
    return Verdict(outcome, tuple(found), warned, made.text, tuple(sorted(known)))


def judge_edits(before: Converted, edits: Iterable[Edit], edited: bytes) -> Verdict:
    """What becomes of a file after these edits, which ask for more or less by their kinds."""
    every = tuple(edits)
    must = any(each.kind == MISTAKE for each in every)
    renames = [each for edit in every for each in edit.operations if isinstance(each, Rename)]
    names = {each.new: each.old for each in renames}
    kept = any(_KEPT in getattr(each, "at", "") for edit in every for each in edit.operations)
    return judge(before, edited, must_be_refused=must, plainly=_plainly(every), names=names, kept=kept)


def edits_carriers(edits: Iterable[Edit]) -> bool:
    """Whether any of the edits changes what only we read."""
    return any(edit.kind.startswith("carrier: ") for edit in edits)


def _plainly(edits: Iterable[Edit]) -> Plainly:
    kinds = {edit.kind for edit in edits}
    if any(kind.startswith("carrier: ") for kind in kinds - {"carrier: delete one", "carrier: delete all"}):
        return Plainly.NONE
    return Plainly.ADDITIONS_TOO if any(kind.startswith("delete ") for kind in kinds) else Plainly.ALL


def _back(file: EditedFile, result: str) -> str:
    return convert(result.encode(), to=file.language).text


def _compared(file: EditedFile, result: str, back: str) -> tuple[tuple[Difference, ...], ...]:
    """The differences between a file and its result; those without its carriers; those to the result converted back."""
    made = result.encode()
    others = ((file.text, made), (etree.tostring(file.plain), made), (file.text, back.encode()))
    if file.language == "mjcf":  # MuJoCo is who reads it without carriers
        others = (others[0], (b"", b""), others[2])
    return tuple(diff(one, other, carriers=True).differences if one else () for one, other in others)


def _about_what_is_there(found: Iterable[Difference], edited: bytes) -> list[Difference]:
    """The differences, without names of collisions that are none: `check` reports these, and they say nothing."""
    listed = list(found)
    lost = {id(each): (each.a.text or "").strip("'") for each in listed if _is_lost_contact(each)}
    if not lost:
        return listed
    unknown = {each.found for each in check(edited).diagnostics if each.rule is UNKNOWN_COLLISION}
    return [each for each in listed if lost.get(id(each)) not in unknown]


def _without_holds(found: Iterable[Difference]) -> list[Difference]:
    """The differences without what holds the links of a robot that is static, and does not move whatever does."""
    return [each for each in found if each.group != "link" or each.aspect != "joint" or each.a.text is not None]


def _without_what_was_kept(found: Iterable[Difference]) -> list[Difference]:
    """The differences without sensors and mimics in the result for elements of MJCF that were edited.

    A camera without a mode is a sensor, and an equality without a polynomial a mimic, which moves what follows.
    """
    listed = list(found)
    new = [each for each in listed if each.a.text is None and _MAY_BE_SAID.search(each.aspect or "")]
    follows = any((each.aspect or "").endswith("mimic") for each in new)
    return [each for each in listed if each not in new and not (follows and each.group == "kinematics")]


def _is_lost_contact(found: Difference) -> bool:
    return "/contact/collision" in (found.aspect or "") and found.b.text is None


def _in_engines(file: EditedFile, made: Conversion, back: str, to: Language) -> tuple[tuple[str, ...], str]:
    """What differs to engines, where MJCF is one of the languages; or why none of them reads the edited file.

    A file of URDF holds one robot: what belongs to the world alone is none of it, if the ledger says that it is gone.
    """
    if "mjcf" not in {file.language, to}:
        return (), ""
    is_robot_alone = any(
        each.rule is OUTSIDE_MODEL and each.location.path == "/mujoco/worldbody" for each in made.ledger.entries
    )
    try:
        return tuple(differences_in_engines(without_scenery(file) if is_robot_alone else file, made.text, back)), ""
    except NotReadError as error:
        return (), f"the edited file is not read by {error.engine}"


def _refused(error: CompileError) -> Verdict:
    errors = [each for each in error.diagnostics if each.is_error]
    rules = tuple(dict.fromkeys(each.rule.name for each in errors))
    if not any(each.location.line for each in errors):
        return Verdict(Outcome.WRONG, (f"refused without a line: {', '.join(rules)}",), rules)
    return Verdict(Outcome.REFUSED, (), rules)


def _key(found: Difference) -> Key:
    return found.group, found.name, found.aspect


def _before(found: Difference, names: Mapping[str, str]) -> Key:
    """What differs, by the names that its parts had before the edit."""
    name, aspect = found.name, found.aspect
    for new, old in names.items():
        name = old if name == new else name
        aspect = aspect.replace(f"'{new}'", f"'{old}'") if aspect else aspect
    return found.group, name, aspect


def _warnings(diagnostics: Iterable[Diagnostic]) -> frozenset[str]:
    return frozenset(f"{each.rule.name}: {each.message}" for each in diagnostics if each.severity is Severity.WARNING)
