"""Reads the comments of a file that was loaded, for the file that it is converted to."""

from twinform.compiler.input.loading import read_tree_again
from twinform.compiler.input.options import LoadResult, expanded_name
from twinform.compiler.output.comments import Comments
from twinform.ir import Document, Format

_BEGINS = tuple("<!--".encode(encoding) for encoding in ("utf-8", "utf-16-le", "utf-16-be"))


def comments_of(loaded: LoadResult, document: Document, target: Format, model: str | None) -> Comments | None:
    """The comments of a file; None where it has none, which costs next to nothing."""
    content = loaded.content
    if content is None or not any(each in content for each in _BEGINS):
        return None
    tree = read_tree_again(content, keep_comments=True)
    is_other = document.format is not target
    partial = model is not None or (is_other and document.format is Format.SDF and _holds_more(document))
    files = frozenset({loaded.path, expanded_name(loaded.path)})
    return Comments(tree, files, partial, is_other)


def _holds_more(document: Document) -> bool:
    """Whether a file holds more than one model."""
    return bool(document.worlds) or len(document.models) > 1
