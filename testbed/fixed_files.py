"""What has to hold for the fixes of any file, whatever is wrong with it."""

import re
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import twinform
from twinform.compiler import LoadOptions, LoadResult, inspect, read
from twinform.compiler.fixing import FixResult, apply_fixes_by
from twinform.compiler.fixing.fix_rounds import kind_of
from twinform.diagnostics import Safety, Severity, Span
from twinform.text import SourceText, UndecodableError

_CONTROL = re.compile(r"[\x00-\x08\x0b\x0c\x0e-\x1f]")
"""Characters that fixes delete, which may stand in the end of a comment."""
_COMMENT = re.compile(r"<!--.*?-->", re.DOTALL)


@dataclass(frozen=True, slots=True)
class FixedFile:
    """A file that was fixed: how many findings of each rule, whether it is the same robot, and broken promises.

    `same` is None where nothing was changed, or the robot could not be read before.
    """

    name: str
    changed: bool = False
    safe: tuple[tuple[str, int], ...] = ()
    unsafe: tuple[tuple[str, int], ...] = ()
    refused: tuple[str, ...] = ()
    same: bool | None = None
    faults: tuple[str, ...] = ()


def fixed_file(name: str, data: bytes) -> FixedFile:
    """Fix a file, safely and then in every way, and see what is true of it."""

    def look(text: bytes) -> LoadResult:
        load_options = LoadOptions()
        return inspect(read(text, load_options, name=name), load_options)

    safe, unsafe = (apply_fixes_by(lambda texts: look(texts[""]), data, unsafe=each) for each in (False, True))
    keeps = all(each.fix and each.fix.keeps_robot for each in safe.applied)
    same = _same(data, safe.data, name) if safe.data != data and keeps and look(data).accepted else None
    faults = [*_faults(look, data, safe, unsafe=False), *(f"unsafe: {each}" for each in _faults(look, data, unsafe))]
    if same is False:
        faults.append("another robot after safe fixes")
    return FixedFile(
        name,
        safe.data != data,
        _counted(safe),
        _counted(unsafe),
        tuple(each.finding.rule.name for each in unsafe.refused),
        same,
        tuple(faults),
    )


def _counted(fixed: FixResult) -> tuple[tuple[str, int], ...]:
    return tuple(Counter(each.rule.name for each in fixed.applied).items())


def _same(before: bytes, after: bytes, name: str) -> bool | None:
    """Whether it is one robot, as far as both can be compared: what they include may not be here."""
    documents = [read(data, LoadOptions(), name=name).document for data in (before, after)]
    if documents[0] is None or documents[1] is None:
        return False
    try:
        return twinform.diff(documents[0], documents[1]).same
    except twinform.CompileError:
        return None


def _faults(
    look: Callable[[bytes], LoadResult], data: bytes, fixed: FixResult, *, unsafe: bool = True
) -> Iterator[str]:
    before = look(data)
    yield from _against_rules(fixed)
    if fixed.data == data:
        return
    again = apply_fixes_by(lambda texts: look(texts[""]), fixed.data, unsafe=unsafe)
    if again.data != fixed.data:
        yield f"a second run changes it: {again.applied[0].rule.name}"
    seen = (each for each in fixed.left.diagnostics if each.severity > Severity.INFO)
    new = Counter(map(kind_of, seen)) - Counter(map(kind_of, before.diagnostics))
    if new and not before.unreadable:
        yield f"new findings: {sorted(new)[:3]}"
    if before.accepted and fixed.left.accepted and _same(data, fixed.data, before.path) is False and not fixed.changes:
        yield "another robot without a word"
    if before.document is not None and fixed.left.document is None:
        yield "cannot be read any more"
    yield from _against_text(data, fixed)


def _against_rules(fixed: FixResult) -> Iterator[str]:
    order = (Safety.SAFE, Safety.UNSAFE, Safety.DISPLAY)
    for each in fixed.applied:
        if each.fix is None or each.rule.fix is None or order.index(each.fix.safety) < order.index(each.rule.fix):
            yield f"a fix of {each.rule.name} is safer than its rule says"


def _against_text(data: bytes, fixed: FixResult) -> Iterator[str]:
    try:
        old, new = SourceText.of(data), SourceText.of(fixed.data)
    except UndecodableError:
        yield "no text any more"
        return
    if (old.mark, old.encoding.lower()) != (new.mark, new.encoding.lower()):
        yield "another encoding"
    kept = Counter(map(_words, _COMMENT.findall(new.text)))
    lost = Counter(map(_words, _COMMENT.findall(_CONTROL.sub("", old.text)))) - kept
    if lost:
        yield f"a comment is lost: {next(iter(lost))[:60]}"
    if fixed.rounds == 1 and not _is_kept(old.text, new.text, [*_spans(fixed)]):
        yield "what is outside of the fixes differs"


def _words(comment: str) -> str:
    """A comment without what fixes exchange in it: blanks, hyphens, control characters, and characters of YAML."""
    return "".join(each for each in comment if each.isprintable() and each not in "- :#*")


def _spans(fixed: FixResult) -> Iterator[Span]:
    seen = {edit for each in fixed.applied if each.fix for edit in each.fix.edits}
    yield from (edit.span for edit in seen)


def _is_kept(old: str, new: str, spans: list[Span]) -> bool:
    """Whether all that is between these pieces is there still, in its order."""
    here = at = 0
    for span in sorted(spans):
        piece = old[here : span.start]
        found = new.find(piece, at)
        if found < 0:
            return False
        here, at = span.end, found + len(piece)
    return new.endswith(old[here:])
