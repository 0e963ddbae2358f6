"""What the sink does with more findings than anybody reads."""

from twinform.diagnostics import DiagnosticSink, rules
from twinform.diagnostics.sink import MOST


def test_help_is_made_for_findings_that_are_kept() -> None:
    sink, made = DiagnosticSink(), list[int]()

    def help_() -> str:
        made.append(len(made))
        return f"help {len(made)}"

    for _ in range(MOST + 5):
        sink.report(rules.UNKNOWN_REFERENCE, "nothing", help=help_)
    assert (len(made), len(sink.diagnostics), sink.left_out) == (MOST, MOST, 5)
    assert sink.diagnostics[-1].help == f"help {MOST}"
