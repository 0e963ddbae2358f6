"""Strategies for edits of converted files, mutations of models, and XML documents that a schema accepts."""

from collections.abc import Callable
from random import Random
from typing import Literal

from hypothesis import reject
from hypothesis import strategies as st
from lxml import etree

from testbed.edits import Edit, draw_edits
from testbed.edits.arrangements import duplicate_carrier
from testbed.edits.drawing import MOST, draw_edit
from testbed.edits.scene import Scene
from tests.mutations import MUTATIONS, OF_SDF, OF_URDF, Mutation
from tests.schema_documents import document
from twinform.compiler import CompileError, convert
from twinform.compiler.output.emitting import emit
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Document, Format
from twinform.schemas import versions_of
from twinform.testing.strategies import robots, sdf_models

Draw = Callable[[bytes, Random], tuple[Edit, ...]]
"""Draws edits of a file."""
EditedFile = tuple[bytes, tuple[Edit, ...]]


def edits(*, text: bytes, max_size: int = MOST) -> st.SearchStrategy[tuple[Edit, ...]]:
    """One edit of a URDF or SDF file, or a few that are made one after the other."""
    if max_size < 1:
        raise ValueError(f"at most {max_size} edits: there is at least one")

    def draw(random: Random) -> tuple[Edit, ...]:
        return draw_edits(text, random, most=max_size)[0]

    return st.builds(draw, st.randoms(use_true_random=False))


def copies_of_carriers(text: bytes, random: Random) -> tuple[Edit, ...]:
    """A carrier of a file once more in any element of it, and another edit or none; no edit of what has no carriers."""
    copy = duplicate_carrier(Scene(etree.fromstring(text)), random)
    if copy is None or random.random() < 0.5:
        return () if copy is None else (copy,)
    return copy, draw_edit(copy.apply(text), random)[0]


def edited_files(
    *,
    models: st.SearchStrategy[Document] | None = None,
    max_size: int = MOST,
    sdf_version: str | None = None,
    draw: Draw | None = None,
    as_mjcf: bool = False,
) -> st.SearchStrategy[EditedFile]:
    """What a model becomes in the other format, and edits of that file, drawn from all kinds or by `draw`.

    With `as_mjcf` that is MJCF, and models are left out that MuJoCo would refuse, such as those that move without mass.
    """

    def edit(text: bytes) -> st.SearchStrategy[EditedFile]:
        drawn = edits(text=text, max_size=max_size)
        if draw is not None:
            drawn = st.builds(draw, st.just(text), st.randoms(use_true_random=False))
        return st.tuples(st.just(text), drawn)

    def convert_(model: Document) -> bytes:
        if as_mjcf:
            try:
                return convert(emit(model, DiagnosticSink()).encode(), to="mjcf").text.encode()
            except CompileError:
                reject()
        to_sdf = model.format is Format.URDF
        made = convert(
            emit(model, DiagnosticSink()).encode(),
            to="sdf" if to_sdf else "urdf",
            sdf_version=sdf_version if to_sdf else None,
        )
        return made.text.encode()

    drawn = models if models is not None else robots(max_links=4) | sdf_models(max_links=4)
    return drawn.map(convert_).flatmap(edit)


def mutations(*, format: Format | str | None = None) -> st.SearchStrategy[Mutation]:
    """Changes that make another robot: each takes a document and gives the changed one, or None if it has no place."""
    foreign = {None: frozenset[str](), Format.URDF: OF_SDF, Format.SDF: OF_URDF}[Format(format) if format else None]
    return st.sampled_from([Mutation(name) for name in MUTATIONS if name not in foreign])


def xml_documents(*, format: Literal["urdf", "sdf"] = "sdf", version: str | None = None) -> st.SearchStrategy[bytes]:
    """Documents that the schema of a version accepts, of any version where none is given.

    They have all elements and attributes of the format, with values that fit; names need not refer to anything, so
    that such a document need not be a model.
    """
    versions = versions_of(format)
    if version is not None and version not in versions:
        raise ValueError(f"{format} has no version {version!r}; it has {', '.join(versions)}")

    def make(random: Random, chosen: str) -> bytes:
        return document(random, format, chosen)

    chosen = st.sampled_from(versions) if version is None else st.just(version)
    return st.builds(make, st.randoms(use_true_random=False), chosen)
