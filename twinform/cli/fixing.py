"""Fixing files from the command line: the options of `check --fix`, and what is said of the fixes."""

from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

from twinform.cli.printing import print_line
from twinform.cli.rewriting import Rewrite, show_differences, write_back
from twinform.cli.source import InputSource
from twinform.compiler import LoadOptions, LoadResult
from twinform.compiler.fixing import FixResult, apply_fixes_by
from twinform.compiler.input.loading import XACRO
from twinform.compiler.input.parsing import UnreadableError, read_bytes
from twinform.diagnostics import Diagnostic, DiagnosticSink, Policy, Severity

Look = Callable[[str | bytes, str], LoadResult]
"""Reads a file, or the bytes of one under its name, and says what is wrong with it."""


@dataclass(frozen=True, slots=True)
class Fixing:
    """How files are fixed; with `diff` nothing is written. Notes are fixed where they are shown."""

    look: Look
    load_options: LoadOptions
    policy: Policy
    unsafe: bool = False
    diff: bool = False
    notes: bool = False

    def wants(self, finding: Diagnostic) -> bool:
        """Whether a finding is shown."""
        # A command that changes a file for a reason that it does not print would surprise, so notes
        # are fixed only where they are shown.
        return bool(self.policy.apply([finding])) and (self.notes or finding.severity > Severity.INFO)


class MendedSource(NamedTuple):
    """A file that was fixed: what is found now, what to write, and what to say of it."""

    loaded: LoadResult
    rewrite: Rewrite | None
    news: list[str]
    number: int


def run_fixes(sources: Sequence[InputSource], fixing: Callable[[InputSource], Fixing]) -> tuple[list[LoadResult], int]:
    """Fix files, and write them or print what would change; gives what is found then, and how much was fixed.

    Raises:
        Unusable: a file cannot be written.
    """
    ways = [fixing(each) for each in sources]
    done = [fixed_source(each, way) for each, way in zip(sources, ways, strict=True)]
    rewrites = [each.rewrite for each in done if each.rewrite]
    if any(way.diff for way in ways):
        show_differences(rewrites)
    else:
        write_back(rewrites)
    for line in (line for each in done for line in each.news):
        print_line(line, err=True)
    return [each.loaded for each in done], sum(each.number for each in done)


def fixed_source(source: InputSource, fixing: Fixing) -> MendedSource:
    """A file once it is fixed; nothing is written. One that cannot be is only looked at."""
    sink = DiagnosticSink(source.name)
    try:
        data = _data(source, sink, fixing.load_options)
    except UnreadableError:
        return MendedSource(LoadResult(source.name, None, tuple(sink.diagnostics), unreadable=True), None, [], 0)
    if data is None:
        return MendedSource(fixing.look(source.content, source.name), None, [], 0)
    found = apply_fixes_by(lambda text: fixing.look(text, source.name), data, unsafe=fixing.unsafe, wanted=fixing.wants)
    rewrite = Rewrite(source, data, found.data)
    return MendedSource(
        found.left, rewrite, _news(source.name, found, "would fix" if fixing.diff else "fixed"), len(found.applied)
    )


def _data(source: InputSource, sink: DiagnosticSink, load_options: LoadOptions) -> bytes | None:
    """The bytes of a file that can be fixed; what xacro expands is not read from its own text.

    Raises:
        UnreadableError: it cannot be read.
    """
    if isinstance(source.content, bytes):
        return source.content
    if load_options.xacro or Path(source.name).suffix.lower() == XACRO:
        return None
    path = Path(source.content)
    return read_bytes(path, sink, load_options.limits, load_options.search.readable(path))


def _news(name: str, found: FixResult, verb: str) -> list[str]:
    """What was fixed in a file, by rule, and how much was taken back."""
    counts = Counter(each.rule.name for each in found.applied)
    shown = ", ".join(f"{count} x {rule}" for rule, count in counts.most_common())
    lines = [f"{name}: {verb} {shown}"] if counts else []
    if found.refused:
        words = "fix was" if len(found.refused) == 1 else "fixes were"
        rules = ", ".join(dict.fromkeys(each.finding.rule.name for each in found.refused))
        lines.append(f"{name}: {len(found.refused)} {words} taken back for what would be found then: {rules}")
    return lines
