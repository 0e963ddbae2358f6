"""Is every xacro file expanded to what the xacro command makes of it?"""

from collections import Counter
from statistics import median

from reports.harness.known import Known
from reports.harness.sample import Sample
from reports.harness.section import UNEXPLAINED, Findings, Section
from testbed.corpus.expressions import Evaluated, evaluated, expressions
from testbed.corpus.plain_xacro import Compared, Verdict, compare, users_of_xacro
from testbed.markdown import listing, subsection, table

KNOWN = Known.beside(__file__)
_ABOUT = """\
Only the seconds differ from run to run.

Every file of the corpus that uses xacro, whatever its name is, is expanded by the compiler and by the `xacro` command
in a process of its own, with no arguments and with the packages that lie anywhere in the corpus (for the command, a
stand-in of the index of ROS has them). The trees are *the same* if their canonical XML is, comments included. Most
files that are refused are parts of robots whose other packages the corpus does not have; both then have to refuse them
for the same reason.

Below the files, every expression in them is evaluated by both once more, also those in macros that no file of the
corpus calls: its names stand in turn for a number, a text, a list, a dictionary and so on. What we refuse and xacro
does not is on the page about [work with xacro](../how-to/xacro.md#what-is-refused); no file here has any of it."""


def measure(sample: Sample) -> Findings:
    """Expand in both ways, and compare."""
    used = sample.of(users_of_xacro())
    files = sample.outcomes(compare, used, lambda file, why: Compared(file.name, Verdict.DIFFERENT, why))
    known = {each.name: KNOWN.why("files", each.name) for each in files if not each.is_alike}
    results = [each for expression in list(expressions())[:: sample.every] for each in evaluated(expression)]
    differing = [each for each in files if not each.is_alike]
    unexplained = [f"{each.name}: {each.verdict}: {each.ours}" for each in differing if not known[each.name]]
    rows = [(each.name, each.verdict, known[each.name] or UNEXPLAINED) for each in differing]
    sections = [
        subsection("Files", _totals(files)),
        subsection("Files that both refuse", _refused(files)),
        subsection("Differences", listing(["file", "what", "why that is right"], rows)),
        subsection("Expressions", _expression_totals(results)),
        subsection("Time", _times(files)),
    ]
    faults = [*unexplained, *(repr(each) for each in results if not each.is_alike)]
    return Findings(sections, f"{_totals(files)}\n{_expression_totals(results)}", faults)


def _totals(files: list[Compared]) -> str:
    counts = Counter(each.verdict for each in files)
    return table(["files", *Verdict], [(len(files), *(counts[verdict] for verdict in Verdict))])


def _refused(files: list[Compared]) -> str:
    refused = [each for each in files if each.verdict is Verdict.BOTH_REFUSE and each.is_alike]
    counts = Counter(each.reason for each in refused)
    examples = {each.reason: each.name for each in reversed(refused)}
    rows = [(reason, count, examples[reason]) for reason, count in counts.most_common()]
    return table(["reason", "files", "for example"], rows)


def _expression_totals(results: list[Evaluated]) -> str:
    different = {each.expression for each in results}
    valued = sum(not each.theirs.is_mistake for each in results)
    row = (len(different), len(results), valued, sum(not each.is_alike for each in results))
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
    return (f"{median(seconds):.3f}", f"{max(seconds):.1f}", f"{sum(seconds):.1f}") if seconds else ("", "", "")


SECTION = Section("xacro", _ABOUT, measure, known=KNOWN)
