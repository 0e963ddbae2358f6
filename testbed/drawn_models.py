"""Models that Hypothesis makes up, always the same ones for a seed."""

from hypothesis import HealthCheck, Phase, given, seed, settings
from hypothesis import strategies as st

from twinform.compiler.output.emitting import emit
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Document


def drawn(strategy: st.SearchStrategy[Document], count: int, number: int) -> list[str]:
    """So many models in their own format."""
    texts: list[str] = []

    @seed(number)
    @settings(
        max_examples=count,
        database=None,
        phases=[Phase.generate],
        suppress_health_check=(HealthCheck.too_slow, HealthCheck.data_too_large, HealthCheck.filter_too_much),
        deadline=None,
    )
    @given(strategy)
    def collect(model: Document) -> None:
        texts.append(emit(model, DiagnosticSink()))

    collect()
    return texts
