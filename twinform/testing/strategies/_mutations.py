"""Small changes of a model."""

from hypothesis import strategies as st

from twinform.ir import Format
from twinform.testing.mutations import MUTATIONS, OF_SDF, OF_URDF, Mutation


def mutations(*, format: Format | str | None = None) -> st.SearchStrategy[Mutation]:
    """Changes that make another robot: each takes a document and gives the changed one, or None if it has no place."""
    foreign = {None: frozenset[str](), Format.URDF: OF_SDF, Format.SDF: OF_URDF}[Format(format) if format else None]
    return st.sampled_from([Mutation(name) for name in MUTATIONS if name not in foreign])
