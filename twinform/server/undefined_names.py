"""References in a text to names that it does not define."""

from collections.abc import Iterator

from twinform.server.document_names import names_of, resolve_in
from twinform.server.model_text import ModelText
from twinform.server.names import Name


def undefined_names(document: ModelText) -> Iterator[Name]:
    """Yield the references to what has no definition in the text; other files may define some of it."""
    for name in names_of(document):
        if not name.defines and not resolve_in(document, name):
            yield name
