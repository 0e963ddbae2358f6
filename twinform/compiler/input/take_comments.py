"""Takes comments out of the tree of a file, to put them into the file that it is converted to."""

from collections.abc import Callable, Iterator
from dataclasses import replace

from lxml import etree

from twinform.compiler.input.load_options import LoadResult, expanded_name
from twinform.compiler.output.source_comments import Comments, SourceComment
from twinform.ir import Document, Format
from twinform.schemas import XmlElement

_BEGINS = tuple("<!--".encode(encoding) for encoding in ("utf-8", "utf-16-le", "utf-16-be"))
# So many comments are placed, and more stand behind the root: a hostile file may have a million at
# one place. The most in a real file are some hundreds.
_MOST = 5000
# So many comments on one line are looked at for its ends.
_LONGEST_RUN = 32


def may_have_comments(text: bytes) -> bool:
    """Whether a file may have comments."""
    return any(each in text for each in _BEGINS)


def take_comments(root: XmlElement) -> Comments | None:
    """Take the comments out of a tree, and return them; None where there are none."""
    inside = [
        _comment_with_place(each) if number < _MOST else _bare_comment(each)
        for number, each in enumerate(root.iter(etree.Comment))
    ]
    above = [_bare_comment(each)._replace(is_above=True) for each in root.itersiblings(etree.Comment, preceding=True)]
    found = (*reversed(above), *inside, *map(_bare_comment, root.itersiblings(etree.Comment)))
    etree.strip_tags(root, etree.Comment)
    return Comments(root, found) if found else None


def comments_of(loaded: LoadResult, document: Document, target: str, model: str | None) -> Comments | None:
    """Return the comments of a file, prepared for the conversion of its document to a format."""
    if loaded.comments is None:
        return None
    is_other = document.format != target
    partial = model is not None or (is_other and document.format is Format.SDF and _holds_more(document))
    files = frozenset({loaded.path, expanded_name(loaded.path)})
    return replace(loaded.comments, files=files, partial=partial, foreign=is_other)


def _holds_more(document: Document) -> bool:
    """Whether a file holds more than one model."""
    return bool(document.worlds) or len(document.models) > 1


def _bare_comment(comment: XmlElement) -> SourceComment:
    return SourceComment(comment.text or "", comment.sourceline or 0)


def _comment_with_place(comment: XmlElement) -> SourceComment:
    behind = _nearest_element(comment, preceding=False)
    has_own_line = _begins_line(comment) or (behind is not None and not _ends_line(comment))
    return SourceComment(
        comment.text or "",
        comment.sourceline or 0,
        comment.getparent(),
        _nearest_element(comment, preceding=True),
        behind,
        has_own_line=has_own_line,
        indent=_blanks_before(comment).rpartition("\n")[2] if has_own_line and "\n" in (comment.text or "") else None,
    )


def _nearest_element(comment: XmlElement, *, preceding: bool) -> XmlElement | None:
    near = comment.getprevious() if preceding else comment.getnext()
    if near is None or near.tag is not etree.Comment:  # an iterator takes longer, and most are beside an element
        return near
    return next(comment.itersiblings("*", preceding=preceding), None)


def _blanks_before(comment: XmlElement) -> str:
    before, parent = comment.getprevious(), comment.getparent()
    text = before.tail if before is not None else parent.text if parent is not None else None
    return text or ""


def _begins_line(comment: XmlElement) -> bool:
    """Whether nothing but comments stands before a comment on its line."""
    if "\n" in _blanks_before(comment):
        return True
    return any("\n" in _blanks_before(each) for each in _adjacent_comments(comment, lambda each: each.getprevious()))


def _ends_line(comment: XmlElement) -> bool:
    """Whether no element stands behind a comment on its line."""
    return any("\n" in (each.tail or "") for each in _adjacent_comments(comment, lambda each: each.getnext()))


def _adjacent_comments(comment: XmlElement, step: Callable[[XmlElement], XmlElement | None]) -> Iterator[XmlElement]:
    """Yield a comment, and the comments that follow it directly in one direction."""
    here: XmlElement | None = comment
    for _ in range(_LONGEST_RUN):
        if here is None or here.tag is not etree.Comment:
            return
        yield here
        here = step(here)
