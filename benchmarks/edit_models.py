"""Models that Hypothesis makes up, always the same ones for a seed, as files for `make edits`."""

from collections.abc import Callable
from pathlib import Path

from hypothesis import HealthCheck, Phase, given, seed, settings
from hypothesis import strategies as st

from twinform.compiler.emitting import emit
from twinform.diagnostics import Notes
from twinform.ir import Document
from twinform.testing import strategies

_SOURCES: dict[str, Callable[[], st.SearchStrategy[Document]]] = {
    "urdf": lambda: strategies.robots(max_links=6),
    "sdf": lambda: strategies.sdf_models(max_links=6),
}


def written(folder: Path, count: int, number: int) -> list[Path]:
    """So many models of each format, written below a folder."""
    folder.mkdir(parents=True, exist_ok=True)
    return [path for suffix in _SOURCES for path in _written(folder, suffix, count, number)]


def _written(folder: Path, suffix: str, count: int, number: int) -> list[Path]:
    texts: list[str] = []

    @seed(number)
    @settings(
        max_examples=count,
        database=None,
        phases=[Phase.generate],
        suppress_health_check=(HealthCheck.too_slow, HealthCheck.data_too_large),
        deadline=None,
    )
    @given(_SOURCES[suffix]())
    def collect(model: Document) -> None:
        texts.append(emit(model, Notes()))

    collect()
    paths = [folder / f"{number}_{index}.{suffix}" for index in range(len(texts))]
    for path, text in zip(paths, texts, strict=True):
        path.write_text(text, encoding="utf-8")
    return paths
