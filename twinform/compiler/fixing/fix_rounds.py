"""Applies fixes until nothing changes. A fix that causes a new finding, or breaks the file, is taken back."""

from bisect import bisect_left, insort
from collections import Counter
from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from dataclasses import field

from twinform.compiler.fixing.offering import with_fixes
from twinform.compiler.input.loading import LoadOptions, LoadResult, read
from twinform.compiler.inspection import inspect
from twinform.dataclass import dataclass
from twinform.diagnostics import Diagnostic, Fix, Safety, Span, TextEdit
from twinform.diagnostics.sink import MOST
from twinform.lazy import lazy_pattern
from twinform.text import SourceText, apply

MOST_ROUNDS = 100
_MOST_CHECKS = 200
_LEAST_CHECKS = 10
# Which of a hundred fixes makes a file worse is found by halving, and each half is read again: so
# many times, and so many bytes in all, but at least the least number. Fixes that are not tried then
# are left out.
# A hostile file of 400 kB costs ten times what `check` costs, instead of 200 times.
_MOST_BYTES = 4_000_000
_PREDICATE = lazy_pattern(r"\[(?:@name='(?:.*?'\](?=[/\[]|$)|.*)|\d+\](?=[/\[]|$))")

Group = list[Diagnostic]
"""Findings that one fix fixes."""
Look = Callable[[bytes], LoadResult]
"""Reads a file and reports what is wrong with it."""


@dataclass(frozen=True, slots=True)
class Refused:
    """A fix that was taken back, and the rules of the findings that it would have caused."""

    finding: Diagnostic
    new: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class FixResult:
    """The fixed bytes, the findings that were fixed, in order, and what is found now."""

    data: bytes
    applied: tuple[Diagnostic, ...]
    left: LoadResult
    rounds: int
    refused: tuple[Refused, ...] = ()


def apply_fixes(
    data: bytes,
    load_options: LoadOptions,
    *,
    name: str = "",
    unsafe: bool = False,
    rules: Collection[str] | None = None,
) -> FixResult:
    """Apply the fixes of a file, of all rules or only of some; `name` is its path."""

    def look(text: bytes) -> LoadResult:
        return inspect(read(text, load_options, name=name), load_options)

    return apply_fixes_by(look, data, unsafe=unsafe, wanted=lambda each: rules is None or each.rule.name in rules)


def apply_fixes_by(
    look: Look, data: bytes, *, unsafe: bool = False, wanted: Callable[[Diagnostic], bool] = lambda _: True
) -> FixResult:
    """Apply the fixes of wanted findings in rounds, until `look` finds nothing more that can be fixed."""
    state = _State(data, look(data))
    fixing = _FixRun(look, Safety.UNSAFE if unsafe else Safety.SAFE, wanted)
    while fixing.rounds < MOST_ROUNDS:
        offered = _most_severe(fixing.offered(state.loaded))
        if not offered:
            break
        fixing.rounds += 1
        after = fixing.applied_to(state, offered)
        if after is state:
            continue  # what was refused is not tried again, so that there is less each time
        state = after
    return FixResult(state.data, tuple(fixing.applied), state.loaded, fixing.rounds, tuple(fixing.refused))


@dataclass(frozen=True, slots=True)
class _State:
    """A text, and what is found in it."""

    data: bytes
    loaded: LoadResult


@dataclass(slots=True)
class _FixRun:
    """One run; `tried` has the fixes that were refused."""

    look: Look
    most: Safety
    wanted: Callable[[Diagnostic], bool]
    rounds: int = 0
    checks: int = 0
    applied: list[Diagnostic] = field(default_factory=list[Diagnostic])
    refused: list[Refused] = field(default_factory=list[Refused])
    tried: set[tuple[str, str, str]] = field(default_factory=set[tuple[str, str, str]])

    def offered(self, loaded: LoadResult) -> list[Diagnostic]:
        """Return the findings with a fix that may be applied."""
        return [
            each
            for each in with_fixes(loaded, self.wanted)
            if each.fix and self._is_allowed(each.fix) and _key(each) not in self.tried
        ]

    def _is_allowed(self, fix: Fix) -> bool:
        return fix.safety is Safety.SAFE or fix.safety is self.most

    def applied_to(self, state: _State, offered: Sequence[Diagnostic]) -> _State:
        """Apply the fixes that do not overlap and make nothing worse."""
        good: list[Group] = []
        pending, best = [[*_without_overlaps(offered)]], state
        while pending:
            groups = pending.pop()
            if self.checks >= _most_checks(state.data):
                self._refuse(groups, ("too-many-tries",))
                continue
            after = self._apply_groups(state, [*good, *groups])
            new = _new_rules(best.loaded, after.loaded, groups)
            if not new:
                good, best = [*good, *groups], after
            elif len(groups) > 1:
                # Whether a fix is right is not left to the function that makes it: one after which
                # something new is found is taken back, alone.
                half = len(groups) // 2
                pending += (groups[half:], groups[:half])
            else:
                self._refuse(groups, new)
        self.applied += [each for group in good for each in group]
        return best

    def _refuse(self, groups: Iterable[Group], new: tuple[str, ...]) -> None:
        for group in groups:
            self.refused.append(Refused(group[0], new))
            self.tried.update(map(_key, group))

    def _apply_groups(self, state: _State, groups: Iterable[Group]) -> _State:
        source = SourceText.of(state.data)
        edits = [edit for first, *_ in groups if first.fix for edit in first.fix.edits]
        data = source.with_text(apply(source.text, edits)).data
        self.checks += 1
        return _State(data, self.look(data))


def _most_checks(data: bytes) -> int:
    """Return how often a text may be read: the larger it is, the less often."""
    return max(_LEAST_CHECKS, min(_MOST_CHECKS, _MOST_BYTES // (len(data) or 1)))


def _without_overlaps(offered: Iterable[Diagnostic]) -> Iterator[Group]:
    """Group findings that have one fix, and drop fixes that overlap an earlier one."""
    groups: dict[tuple[TextEdit, ...], Group] = {}
    for each in offered:
        if each.fix:
            groups.setdefault(each.fix.edits, []).append(each)
    taken: list[Span] = []
    for edits, group in groups.items():
        found = [edit.span for edit in group[0].fix.edits] if group[0].fix else []
        if edits and not any(_overlaps(span, taken) for span in found):
            for span in found:
                insort(taken, span)
            yield group


def _overlaps(span: Span, taken: Sequence[Span]) -> bool:
    at = bisect_left(taken, span)
    return any(_meet(span, each) for each in taken[max(0, at - 1) : at + 1])


def _meet(one: Span, other: Span) -> bool:
    """Whether both edits change the same piece; insertions at one place do not, and keep the order of the findings."""
    return one.start < other.end and other.start < one.end


def _most_severe(offered: Sequence[Diagnostic]) -> list[Diagnostic]:
    """Return the errors, or all findings where there are no errors: an error may hide what else is wrong."""
    return [each for each in offered if each.is_error] or [*offered]


def _new_rules(before: LoadResult, after: LoadResult, groups: Sequence[Group]) -> tuple[str, ...]:
    """Return the rules of the findings that fixes have caused.

    Where an error is fixed, more of the file is checked, and hidden mistakes are found. So after several fixes, all
    errors that they fix have to be gone; after a single one, there must not be more errors than before.
    """
    if before.unreadable or after.unreadable:
        return (
            ()
            if not after.unreadable or (before.unreadable and _last_readable_line(after) > _last_readable_line(before))
            else _error_rules(after)
        )
    is_cut_off = len(before.diagnostics) >= MOST  # what is found now may have been there beyond the limit
    seen = (each for each in after.diagnostics if each.is_error or not is_cut_off)
    new = Counter(map(kind_of, seen)) - Counter(map(kind_of, before.diagnostics))
    if not new:
        return ()
    if groups[0][0].is_error:
        errors = [sum(each.is_error for each in loaded.diagnostics) for loaded in (before, after)]
        gone = sum(map(len, groups)) if len(groups) > 1 else 0
        if errors[1] <= errors[0] - gone:
            return ()
    return tuple(sorted({rule for rule, _ in new}))


def _error_rules(loaded: LoadResult) -> tuple[str, ...]:
    return tuple(each.rule.name for each in loaded.diagnostics if each.is_error)


def _last_readable_line(loaded: LoadResult) -> int:
    """Return the line up to which a file could be read."""
    return max((each.location.line for each in loaded.diagnostics if each.is_error), default=0)


def kind_of(finding: Diagnostic) -> tuple[str, str]:
    """Return a finding's rule and path, without names and numbers that the fix of another part may change."""
    return finding.rule.name, _PREDICATE.sub("", finding.location.path)


def _key(finding: Diagnostic) -> tuple[str, str, str]:
    return finding.rule.name, finding.location.path, finding.fix.title if finding.fix else ""
