"""Fixes of files, for `check --fix` and `fix`: their options, and the messages about them."""

from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

from twinform.cli.inputs import InputSource
from twinform.cli.printing import print_line
from twinform.cli.rewriting import Rewrite, show_differences, write_back
from twinform.compiler import LoadOptions, LoadResult
from twinform.compiler.fixing import FixResult, apply_fixes_by
from twinform.compiler.input.loading import XACRO
from twinform.compiler.input.parsing import UnreadableError, read_bytes
from twinform.diagnostics import Diagnostic, DiagnosticSink, Policy, Severity

Look = Callable[[str | bytes, str], LoadResult]
"""Checks a file, or the bytes of one under its name."""


@dataclass(frozen=True, slots=True)
class Fixing:
    """How files are fixed; with `diff` nothing is written, and notes are fixed only with `notes`."""

    look: Look
    load_options: LoadOptions
    policy: Policy
    unsafe: bool = False
    diff: bool = False
    notes: bool = False

    def wants(self, finding: Diagnostic) -> bool:
        """Whether a finding is shown, and so may be fixed."""
        # A command that changes a file for a reason that it does not print would surprise.
        return bool(self.policy.apply([finding])) and (self.notes or finding.severity > Severity.INFO)


class FixedSource(NamedTuple):
    """A fixed file: its findings now, its new text, messages about the fixes, and their number."""

    loaded: LoadResult
    rewrite: Rewrite | None
    news: list[str]
    number: int


def run_fixes(sources: Sequence[InputSource], fixing: Callable[[InputSource], Fixing]) -> tuple[list[LoadResult], int]:
    """Fix files, and write them or print what would change; return their findings then, and the number of fixes.

    Raises:
        Unusable: a file cannot be written.
    """
    ways = [fixing(each) for each in sources]
    done = [fix_source(each, way) for each, way in zip(sources, ways, strict=True)]
    rewrites = [each.rewrite for each in done if each.rewrite]
    if any(way.diff for way in ways):
        show_differences(rewrites)
    else:
        write_back(rewrites)
    for line in (line for each in done for line in each.news):
        print_line(line, err=True)
    return [each.loaded for each in done], sum(each.number for each in done)


def fix_source(source: InputSource, fixing: Fixing) -> FixedSource:
    """Fix a file without writing it; a file that cannot be fixed, such as xacro, is only checked."""
    sink = DiagnosticSink(source.name)
    try:
        data = _read_fixable(source, sink, fixing.load_options)
    except UnreadableError:
        return FixedSource(LoadResult(source.name, None, tuple(sink.diagnostics), unreadable=True), None, [], 0)
    if data is None:
        return FixedSource(fixing.look(source.content, source.name), None, [], 0)
    found = apply_fixes_by(lambda text: fixing.look(text, source.name), data, unsafe=fixing.unsafe, wanted=fixing.wants)
    rewrite = Rewrite(source, data, found.data)
    return FixedSource(
        found.left, rewrite, _describe(source.name, found, "would fix" if fixing.diff else "fixed"), len(found.applied)
    )


def _read_fixable(source: InputSource, sink: DiagnosticSink, load_options: LoadOptions) -> bytes | None:
    """Read a file that can be fixed; None for xacro, whose findings are about the expanded text.

    Raises:
        UnreadableError: it cannot be read.
    """
    if isinstance(source.content, bytes):
        return source.content
    if load_options.xacro or Path(source.name).suffix.lower() == XACRO:
        return None
    path = Path(source.content)
    return read_bytes(path, sink, load_options.limits, load_options.search.readable(path))


def _describe(name: str, found: FixResult, verb: str) -> list[str]:
    """Say how many findings were fixed in a file, by rule, and how many fixes were taken back."""
    counts = Counter(each.rule.name for each in found.applied)
    shown = ", ".join(f"{count} x {rule}" for rule, count in counts.most_common())
    lines = [f"{name}: {verb} {shown}"] if counts else []
    if found.refused:
        words = "fix was" if len(found.refused) == 1 else "fixes were"
        rules = ", ".join(dict.fromkeys(each.finding.rule.name for each in found.refused))
        lines.append(f"{name}: {len(found.refused)} {words} taken back for what would be found then: {rules}")
    return lines
