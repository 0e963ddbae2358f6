"""Edits of converted files, as people make them."""

from random import Random

from hypothesis import strategies as st

from twinform.compiler import convert
from twinform.compiler.output.emitting import emit
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Document, Format
from twinform.testing.edits import Edit, draw_edits
from twinform.testing.edits.drawing import MOST
from twinform.testing.strategies._models import robots, sdf_models

EditedFile = tuple[bytes, tuple[Edit, ...]]


def edits(*, text: bytes, max_size: int = MOST) -> st.SearchStrategy[tuple[Edit, ...]]:
    """One edit of a URDF or SDF file, or a few that are made one after the other."""
    if max_size < 1:
        raise ValueError(f"at most {max_size} edits: there is at least one")

    def draw(random: Random) -> tuple[Edit, ...]:
        return draw_edits(text, random, most=max_size)[0]

    return st.builds(draw, st.randoms(use_true_random=False))


def edited_files(
    *, models: st.SearchStrategy[Document] | None = None, max_size: int = MOST, sdf_version: str | None = None
) -> st.SearchStrategy[EditedFile]:
    """What a model becomes in the other format, and edits of that file."""

    def edit(text: bytes) -> st.SearchStrategy[EditedFile]:
        return st.tuples(st.just(text), edits(text=text, max_size=max_size))

    def convert_(model: Document) -> bytes:
        to_sdf = model.format is Format.URDF
        made = convert(
            emit(model, DiagnosticSink()).encode(),
            to="sdf" if to_sdf else "urdf",
            sdf_version=sdf_version if to_sdf else None,
        )
        return made.text.encode()

    drawn = models if models is not None else robots(max_links=4) | sdf_models(max_links=4)
    return drawn.map(convert_).flatmap(edit)
