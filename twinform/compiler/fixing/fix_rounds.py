"""Applies fixes until nothing changes. A fix that causes a new finding, or another robot by mistake, is taken back."""

from bisect import bisect_left, insort
from collections import Counter, defaultdict
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import field
from typing import TYPE_CHECKING

from twinform.compiler.conversion_error import CompileError
from twinform.compiler.fixing.offering import with_fixes
from twinform.compiler.input.loading import LoadOptions, LoadResult, read
from twinform.compiler.inspection import as_refused, inspect
from twinform.dataclass import dataclass
from twinform.diagnostics import Diagnostic, Fix, Safety, Severity, Span, TextEdit
from twinform.diagnostics.sink import MOST
from twinform.lazy import lazy_pattern
from twinform.text import SourceText, apply

if TYPE_CHECKING:
    from twinform.compiler.compare import Difference

MOST_ROUNDS = 100
ANOTHER_ROBOT = "another robot"
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
Texts = Mapping[str, bytes]
"""The bytes of a file, by an empty name, and of those that it includes and that are not what is on the disk."""
Look = Callable[[Texts], LoadResult]
"""Reads a file and reports what is wrong with it."""


@dataclass(frozen=True, slots=True)
class Refused:
    """A fix that was taken back, and the rules of the findings that it would have caused, or `ANOTHER_ROBOT`."""

    finding: Diagnostic
    new: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class FixResult:
    """The fixed bytes, the findings that were fixed, in order, and what is found now.

    `changes` say how the robot differs from the one before, where that could be read. `included` are the files that
    were changed besides, with their bytes before and after.
    """

    data: bytes
    applied: tuple[Diagnostic, ...]
    left: LoadResult
    rounds: int
    refused: tuple[Refused, ...] = ()
    changes: tuple[str, ...] = ()
    included: Mapping[str, tuple[bytes, bytes]] = field(default_factory=dict[str, tuple[bytes, bytes]])


def apply_fixes(
    data: bytes,
    load_options: LoadOptions,
    *,
    name: str = "",
    unsafe: bool = False,
    rules: Collection[str] | None = None,
) -> FixResult:
    """Apply the fixes of a file, of all rules or only of some; `name` is its path."""

    def look(texts: Texts) -> LoadResult:
        return as_refused(inspect(read(texts[""], load_options, name=name), load_options))

    return apply_fixes_by(
        look,
        data,
        unsafe=unsafe,
        wanted=lambda each: rules is None or each.rule.name in rules,
        load_options=load_options,
    )


def apply_fixes_by(
    look: Look,
    data: bytes,
    *,
    unsafe: bool = False,
    wanted: Callable[[Diagnostic], bool] = lambda _: True,
    load_options: LoadOptions | None = None,
    closed: Collection[str] = (),
) -> FixResult:
    """Apply the fixes of wanted findings in rounds, until `look` finds nothing more that can be fixed.

    The robots before and after are compared with what their files include, which `load_options` say where to find.
    Files that are `closed` are not changed.
    """
    first = state = _State({"": data}, look({"": data}))
    load_options = load_options or LoadOptions()
    fixing = _FixRun(look, Safety.UNSAFE if unsafe else Safety.SAFE, wanted, load_options, frozenset(closed))
    while fixing.rounds < MOST_ROUNDS:
        offered = _most_severe(fixing.offered(state.loaded))
        if not offered:
            break
        fixing.rounds += 1
        after = fixing.applied_to(state, offered)
        if after is state:
            continue  # what was refused is not tried again, so that there is less each time
        state = after
    applied, refused = tuple(fixing.applied), tuple(fixing.refused)
    keeps = all(each.fix and each.fix.keeps_robot for each in applied)
    changes = () if keeps else _differences(first.loaded, state.loaded, load_options)
    included = {name: (first.text(name), text) for name, text in state.texts.items() if name}
    return FixResult(state.texts[""], applied, state.loaded, fixing.rounds, refused, changes, included)


@dataclass(frozen=True, slots=True)
class _State:
    """The text of a file and of those of its files that were changed, and what is found in them."""

    texts: Texts
    loaded: LoadResult

    def text(self, name: str) -> bytes:
        """Return the bytes of the file or, by its name, of one that it includes."""
        found = self.texts.get(name)
        if found is not None:
            return found
        return (self.loaded.expansion.texts if self.loaded.expansion else self.loaded.texts)[name]


@dataclass(slots=True)
class _FixRun:
    """One run; `tried` has the fixes that were refused."""

    look: Look
    most: Safety
    wanted: Callable[[Diagnostic], bool]
    load_options: LoadOptions
    closed: frozenset[str] = frozenset()
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
        is_open = self.closed.isdisjoint(edit.file for edit in fix.edits)
        return is_open and (fix.safety is Safety.SAFE or fix.safety is self.most)

    def applied_to(self, state: _State, offered: Sequence[Diagnostic]) -> _State:
        """Apply the fixes that do not overlap and make nothing worse."""
        good: list[Group] = []
        groups = [*_without_overlaps(offered)]
        # those that keep the robot are compared with what was before the others
        pending = [[each for each in groups if not _keeps(each)], [each for each in groups if _keeps(each)]]
        pending, best = [*filter(None, pending)], state
        while pending:
            groups = pending.pop()
            if self.checks >= _most_checks(state.texts[""]):
                self._refuse(groups, ("too-many-tries",))
                continue
            after = self._apply_groups(state, [*good, *groups])
            new = new_rules(best.loaded, after.loaded, min(group[0].severity for group in groups))
            if not new and _keeps(groups[0]) and _differences(best.loaded, after.loaded, self.load_options):
                new = (ANOTHER_ROBOT,)
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
        by_file: defaultdict[str, list[TextEdit]] = defaultdict(list)
        for edit in (edit for first, *_ in groups if first.fix for edit in first.fix.edits):
            by_file[edit.file].append(edit)
        texts = dict(state.texts)
        for name, edits in by_file.items():
            source = SourceText.of(state.text(name))
            texts[name] = source.with_text(apply(source.text, edits)).data
        self.checks += 1
        return _State(texts, self.look(texts))


def _keeps(group: Group) -> bool:
    return group[0].fix is not None and group[0].fix.keeps_robot


def _differences(before: LoadResult, after: LoadResult, load_options: LoadOptions) -> tuple[str, ...]:
    """Return how two robots differ, in words; nothing where one of them cannot be read or compared."""
    robots = [each if each.accepted else each.document for each in (before, after)]
    if None in robots:
        return ()
    from twinform.compiler.compare import compare_files  # noqa: PLC0415 - few files are fixed

    try:
        one, other = (each for each in robots if each is not None)
        return tuple(map(_in_words, compare_files(one, other, load_options).counted))
    except CompileError:
        return ()


def _in_words(change: "Difference") -> str:
    what = " ".join(filter(None, (change.group, change.name and repr(change.name), change.aspect)))
    return f"{what}: {change.a.text or 'nothing'}, now {change.b.text or 'nothing'}"


def _most_checks(data: bytes) -> int:
    """Return how often a text may be read: the larger it is, the less often."""
    return max(_LEAST_CHECKS, min(_MOST_CHECKS, _MOST_BYTES // (len(data) or 1)))


def _without_overlaps(offered: Iterable[Diagnostic]) -> Iterator[Group]:
    """Group findings that have one fix, and drop fixes that overlap an earlier one."""
    groups: dict[tuple[TextEdit, ...], Group] = {}
    for each in offered:
        if each.fix:
            groups.setdefault(each.fix.edits, []).append(each)
    taken: defaultdict[str, list[Span]] = defaultdict(list)
    for edits, group in groups.items():
        if edits and not any(_overlaps(edit.span, taken[edit.file]) for edit in edits):
            for edit in edits:
                insort(taken[edit.file], edit.span)
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


def new_rules(before: LoadResult, after: LoadResult, least: Severity) -> tuple[str, ...]:
    """Return the rules of the findings that were not there before, without notes where something worse was fixed.

    Of a text that was no XML, only what could be read so far was known: it is enough that more can be read. Of a xacro
    file that cannot be expanded, the first fault is known: it is enough that it is gone.
    """
    if before.texts and after.texts:
        left = {(each.rule, each.message) for each in before.diagnostics if each.is_error}
        return () if left.isdisjoint((each.rule, each.message) for each in after.diagnostics) else _error_rules(after)
    if before.unreadable or after.unreadable:
        return (
            ()
            if not after.unreadable or (before.unreadable and _last_readable_line(after) > _last_readable_line(before))
            else _error_rules(after)
        )
    is_cut_off = len(before.diagnostics) >= MOST  # what is found now may have been there beyond the limit
    least = Severity.ERROR if is_cut_off else min(least, Severity.WARNING)
    seen = (each for each in after.diagnostics if each.severity >= least)
    new = Counter(map(kind_of, seen)) - Counter(map(kind_of, before.diagnostics))
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
