"""Every xacro file of the corpus beside what the `xacro` command makes of it: `make xacro`."""

import sys
from collections import Counter
from collections.abc import Iterable
from statistics import median

from benchmarks.markdown import table, write
from tests.corpus.expressions import Evaluated, evaluated, expressions
from tests.corpus.files import CORPUS, MISSING, ROOT, CorpusFile
from tests.corpus.plain_xacro import Compared, Verdict, compare, known_differences, users_of_xacro
from twinform.testing.workers import Failure, run

PAGE = ROOT / "docs" / "reference" / "xacro.md"
_UNEXPLAINED = "**unexplained**"
_INTRODUCTION = """# What becomes of real xacro files

Made by `make xacro`; only the seconds differ from run to run.

Every file of the corpus that uses xacro, whatever its name is, is expanded by the compiler and by the `xacro` command
in a process of its own, with no arguments and with the packages that lie anywhere in the corpus (for the command, a
stand-in of the index of ROS says where). The trees are *the same* if their canonical XML is, comments included. Most
files that are refused are parts of robots whose other packages the corpus does not have; both then have to refuse them
for the same reason.

Below the files, every expression in them is evaluated by both once more, also those in macros that no file of the
corpus calls: its names stand in turn for a number, a text, a list, a dictionary and so on. What we refuse and xacro
does not is on the page about [work with xacro](../how-to/xacro.md#what-is-refused); no file here has any of it."""


def main() -> int:
    """Compare, report, and fail where a difference is not explained."""
    if not CORPUS.is_dir():
        print(MISSING, file=sys.stderr)
        return 1
    files = sorted(_compared(), key=lambda each: each.name)
    results = [each for expression in expressions() for each in evaluated(expression)]
    write(PAGE, _INTRODUCTION, *_sections(files, results))
    faults = [*_unexplained(files), *(repr(each) for each in results if not each.is_alike)]
    print(_totals(files), _expression_totals(results), f"written to {PAGE.relative_to(ROOT)}", sep="\n")
    print(*faults, f"{len(faults)} differences without a reason", sep="\n", file=sys.stderr)
    return 1 if faults else 0


def _compared() -> Iterable[Compared]:
    for file, result in run(_compare, users_of_xacro()):
        yield Compared(file.name, Verdict.DIFFERENT, result.cause) if isinstance(result, Failure) else result


def _compare(file: CorpusFile) -> Compared:
    return compare(file)


def _unexplained(files: Iterable[Compared]) -> list[str]:
    reasons = known_differences()
    return [
        f"{each.name}: {each.verdict}: {each.ours}" for each in files if not each.is_alike and each.name not in reasons
    ]


def _sections(files: list[Compared], results: list[Evaluated]) -> Iterable[str]:
    yield "## Files\n\n" + _totals(files)
    yield "## Files that both refuse\n\n" + _refused(files)
    yield "## Differences\n\n" + _differences(files)
    yield "## Expressions\n\n" + _expression_totals(results)
    yield "## Time\n\n" + _times(files)


def _totals(files: list[Compared]) -> str:
    counts = Counter(each.verdict for each in files)
    return table(["files", *Verdict], [(len(files), *(counts[verdict] for verdict in Verdict))])


def _refused(files: list[Compared]) -> str:
    refused = [each for each in files if each.verdict is Verdict.BOTH_REFUSE and each.is_alike]
    counts = Counter(each.reason for each in refused)
    examples = {each.reason: each.name for each in reversed(refused)}
    rows = [(reason, count, examples[reason]) for reason, count in counts.most_common()]
    return table(["reason", "files", "for example"], rows)


def _differences(files: list[Compared]) -> str:
    reasons = known_differences()
    rows = [(each.name, each.verdict, reasons.get(each.name, _UNEXPLAINED)) for each in files if not each.is_alike]
    return table(["file", "what", "why that is right"], rows) if rows else "None."


def _expression_totals(results: list[Evaluated]) -> str:
    different = {each.expression for each in results}
    row = (
        len(different),
        len(results),
        sum(not each.theirs.is_mistake for each in results),
        sum(not each.is_alike for each in results),
    )
    return table(["expressions", "evaluated", "with a value", "different"], [row])


def _times(files: list[Compared]) -> str:
    expanded = [each for each in files if each.verdict is Verdict.SAME]
    rows = [
        ("the compiler", *_spread([each.our_seconds for each in expanded])),
        ("the `xacro` command", *_spread([each.their_seconds for each in expanded])),
    ]
    text = "Seconds of the processor, for files with the same tree, each with the start of a process."
    return f"{text}\n\n{table(['', 'median', 'largest', 'sum'], rows)}"


def _spread(seconds: list[float]) -> tuple[str, str, str]:
    return f"{median(seconds):.3f}", f"{max(seconds):.1f}", f"{sum(seconds):.1f}"


if __name__ == "__main__":
    sys.exit(main())
