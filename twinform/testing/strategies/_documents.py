"""XML documents that a schema accepts, whatever they mean."""

from random import Random
from typing import Literal

from hypothesis import strategies as st

from twinform.schemas import table
from twinform.testing.documents import document


def xml_documents(*, format: Literal["urdf", "sdf"] = "sdf", version: str | None = None) -> st.SearchStrategy[bytes]:
    """Documents that the schema of a version accepts, of any version where none is given.

    They have all elements and attributes of the format, with values that fit; names need not refer to anything, so
    that such a document need not be a model.
    """
    versions = table(format).versions
    if version is not None and version not in versions:
        raise ValueError(f"{format} has no version {version!r}; it has {', '.join(versions)}")

    def make(random: Random, chosen: str) -> bytes:
        return document(random, format, chosen)

    chosen = st.sampled_from(versions) if version is None else st.just(version)
    return st.builds(make, st.randoms(use_true_random=False), chosen)
