"""Three-way merges of model files: the edits of two people in one text.

The trees of the files are merged, and the differences are written into the text of `ours`, so that its layout, its
comments and all that nobody has changed stay as they are. Then the comments of `theirs` are merged into it, and the
result is searched for what neither side has wrong, such as a reference to a link that the other one has deleted.
"""

import re
from bisect import bisect_right
from collections import Counter
from collections.abc import Callable, Hashable, Iterable, Sequence
from copy import deepcopy
from typing import NamedTuple

from twinform.compiler.input.parsing import UnreadableError, parse
from twinform.compiler.input.size_limits import LIFTED_LIMITS, USUAL_LIMITS, Limits
from twinform.diagnostics import DiagnosticSink
from twinform.lazy import lazy_pattern
from twinform.schemas import XmlElement
from twinform.text import SourceText, UndecodableError, UnplacedError, merge, patch, spans
from twinform.text.alignment import ElementContents, elements, known_by
from twinform.text.line_merging import (
    Hunk,
    Pieces,
    changed_pieces,
    conflict,
    merge_pieces,
    split_lines,
    with_markers,
)
from twinform.text.tokens import COMMENT

_PIECES = lazy_pattern(rf"({COMMENT}|<[^<>]*+>)")
_ROOT = lazy_pattern(r"<(robot|sdf|gazebo)\b")
Step = tuple[Hashable, int]
"""What an element is known by, and its number among its siblings that are known by the same."""


class Problem(NamedTuple):
    """Something wrong at an offset of a text; `key` is the same in each text that has it."""

    key: Hashable
    message: str
    offset: int


FindProblems = Callable[[SourceText], Iterable[Problem]]


class MergedFile(NamedTuple):
    """The merged bytes, with git's markers around conflicts; the reasons of these; and what else there is to say."""

    data: bytes
    conflicts: Sequence[str] = ()
    notes: Sequence[str] = ()


class FileVersions(NamedTuple):
    """The bytes of a file in the three versions."""

    base: bytes
    ours: bytes
    theirs: bytes


class _Texts(NamedTuple):
    """The texts of the three files."""

    base: SourceText
    ours: SourceText
    theirs: SourceText


class _Trees(NamedTuple):
    """The trees of the three files, with their comments."""

    base: XmlElement
    ours: XmlElement
    theirs: XmlElement


def merge_files(
    versions: FileVersions, find_problems: FindProblems, limits: Limits = USUAL_LIMITS, *, marker_size: int = 7
) -> MergedFile:
    """Merge the edits of two people in a file; a problem of the result that no side has is a conflict as well.

    What cannot be merged stands between markers, so nothing of either side is lost. Files that are not well-formed are
    merged line by line, as git does it.
    """
    base, ours, theirs = versions
    if theirs in (base, ours) or ours == base:
        return MergedFile(theirs if ours == base else ours)
    if not base.strip() and (root := _ROOT.search(ours.decode("latin-1"))):
        base = f"<{root[1]}/>".encode()  # both have added the file
    try:
        texts = _with_line_ends(_Texts(*map(SourceText.of, (base, ours, theirs))))
    except UndecodableError as error:
        texts = _Texts(*(SourceText(each.decode("latin-1"), "latin-1") for each in (base, ours, theirs)))
        return _merged_by_lines(texts, marker_size, str(error))
    try:
        trees = _Trees(*(_tree(each, limits) for each in texts))
        return _Merging(texts, trees, marker_size).merged(find_problems)
    except (UnmergeableError, UnplacedError) as error:
        return _merged_by_lines(texts, marker_size, str(error))


class UnmergeableError(Exception):
    """A file has no tree that could be merged."""


def _with_line_ends(texts: _Texts) -> _Texts:
    """Give the other files the line ends of ours."""
    end = texts.ours.line_end
    base, theirs = (each.with_text(re.sub(r"\r?\n", end, each.text)) for each in (texts.base, texts.theirs))
    return _Texts(base, texts.ours, theirs)


def _tree(text: SourceText, limits: Limits) -> XmlElement:
    sink = DiagnosticSink("")
    try:
        return parse(text.data, sink, limits, keep_comments=True)
    except UnreadableError as error:
        raise UnmergeableError("; ".join(each.message for each in sink.diagnostics)) from error


def _merged_by_lines(texts: _Texts, size: int, reason: str) -> MergedFile:
    found: list[str] = []

    def mark(hunk: Hunk) -> Pieces:
        found.append("both have changed the same lines")
        return conflict(hunk, size)

    base, ours, theirs = (split_lines(each.text) for each in texts)
    lines = merge_pieces(base, ours, theirs, mark)
    note = f"merged line by line, without looking at the models: {reason}"
    return MergedFile(texts.ours.with_text("".join(lines)).data, found[:1], (note,))


class _Merging:
    """One merge of three well-formed files."""

    def __init__(self, texts: _Texts, trees: _Trees, marker_size: int) -> None:
        self.texts, self.trees, self.marker_size = texts, trees, marker_size
        self.comments = _CommentMerging(texts, trees)
        self.made: dict[XmlElement, SourceText] = {}

    def merged(self, find_problems: FindProblems) -> MergedFile:
        """Merge the files."""
        base, ours, theirs = self.trees
        found = merge(base, theirs, ours)
        # With `same` nothing is a conflict, and theirs counts.
        other = merge(base, theirs, ours, same=True).tree if found.conflicts else found.tree
        reasons = [each.message for each in found.conflicts]
        problems = self._problems(self._patched(found.tree), find_problems)
        reasons += [each.message for each in problems]
        one = self._on_side(found.tree, found.tree, ours, problems)
        other = self._on_side(other, found.tree, theirs, problems)
        text = self.comments.merged(self._patched(one), theirs=False)
        text_of_theirs = self.comments.merged(self._patched(other), theirs=True)
        if lost := self._lost_comments(text + text_of_theirs):
            raise UnmergeableError(f"the comment {lost!r} would have no place")
        if text == text_of_theirs and not reasons:
            return MergedFile(self.texts.ours.with_text(text).data)
        if text == text_of_theirs:  # what is wrong has no place that differs, so all that theirs changes is shown
            text = self.texts.ours.text
        reasons = reasons or ["both have changed the same comment"]
        lines = with_markers(split_lines(text), split_lines(text_of_theirs), self.marker_size)
        return MergedFile(self.texts.ours.with_text("".join(lines)).data, reasons)

    def _lost_comments(self, merged: str) -> str:
        """Return a comment that one side has added and the merged text lacks."""
        base, ours, theirs = (set(_comments(_pieces(each.text))) for each in self.texts)
        return min((ours | theirs) - base - set(_comments(_pieces(merged))), default="")

    def _patched(self, tree: XmlElement) -> SourceText:
        if tree not in self.made:
            self.made[tree] = patch(self.texts.ours, self.trees.ours, tree)
        return self.made[tree]

    def _problems(self, text: SourceText, find_problems: FindProblems) -> list[Problem]:
        """Find what is wrong in the merged text, and was in neither side."""
        known = {each.key for side in (self.texts.ours, self.texts.theirs) for each in find_problems(side)}
        return [each for each in find_problems(text) if each.key not in known]

    def _on_side(
        self, tree: XmlElement, merged: XmlElement, side: XmlElement, problems: Sequence[Problem]
    ) -> XmlElement:
        """Return a tree in which the elements with problems are as one side has them."""
        if not problems:
            return tree
        made = deepcopy(tree)
        starts = [place.start_tag.start for place in spans(self._patched(merged).text).walk()]
        places = list(merged.iter("*"))
        for problem in problems:
            number = max(0, bisect_right(starts, problem.offset) - 1)
            _put_back(made, side, _steps_to(places[number]))
        return made


def _put_back(tree: XmlElement, side: XmlElement, steps: Sequence[Step]) -> None:
    """Make an element as it is in another tree, or remove what the other tree lacks of the way to it."""
    here, there = tree, side
    for step in steps:
        inner, other = _child(here, step), _child(there, step)
        if inner is None:
            return
        if other is None:
            here.remove(inner)
            return
        here, there = inner, other
    parent = here.getparent()
    if parent is not None:
        parent.replace(here, deepcopy(there))


def _steps_to(element: XmlElement) -> list[Step]:
    """Return the way from the root to an element."""
    steps: list[Step] = []
    for each in (element, *element.iterancestors()):
        parent = each.getparent()
        if parent is not None:
            alike = [child for child in elements(parent) if known_by(child) == known_by(each)]
            steps.append((known_by(each), alike.index(each)))
    return steps[::-1]


def _child(parent: XmlElement, step: Step) -> XmlElement | None:
    alike = [child for child in elements(parent) if known_by(child) == step[0]]
    return alike[step[1]] if step[1] < len(alike) else None


class _CommentMerging:
    """Makes in other texts the changes of comments that `theirs` has beside its changes of elements."""

    def __init__(self, texts: _Texts, trees: _Trees) -> None:
        # The base with their elements and its own comments: what it lacks of `theirs` are comments and layout.
        self.before = _pieces(patch(texts.base, trees.base, trees.theirs).text)
        # A tag that differs in its quotes and blanks only is the same.
        known = {_spelled(piece): piece for piece in self.before}
        theirs = [known.get(_spelled(piece), piece) for piece in _pieces(texts.theirs.text)]
        self.after = [
            piece
            for own, other in changed_pieces(self.before, theirs)
            for piece in (own if _comments(own) == _comments(other) else other)
        ]

    def merged(self, text: SourceText, *, theirs: bool) -> str:
        """Merge the comments into a text; `theirs` says which side counts where both have changed one."""
        if self.before == self.after:
            return text.text

        def choose(hunk: Hunk) -> Pieces:
            return _with_comments(hunk, theirs=theirs)

        made = "".join(merge_pieces(self.before, _pieces(text.text), self.after, choose))
        return made if _same_content(text.with_text(made), text) else text.text


def _pieces(text: str) -> list[str]:
    """Split a text into comments, tags, and what is between them."""
    return [piece for piece in _PIECES.split(text) if piece]


def _spelled(piece: str) -> str:
    """Return a tag in one of its spellings, and anything else as it is."""
    is_tag = piece.startswith("<") and not piece.startswith("<!")
    return " ".join(piece.replace("'", '"').replace("/>", " />").split()) if is_tag else piece


def _comments(pieces: Pieces) -> list[str]:
    return [piece for piece in pieces if piece.startswith("<!--")]


def _with_comments(hunk: Hunk, *, theirs: bool) -> list[str]:
    """Make in our pieces the changes of comments that theirs has; `theirs` decides where both have changed one."""
    base, ours, other = map(Counter, map(_comments, hunk))
    gone, new = base - other, other - base
    if gone & (base - ours) and new and ours - base:
        gone, new = (gone + (ours - base), new) if theirs else (Counter[str](), Counter[str]())
    blanks = next((piece for piece in (*hunk.ours, *hunk.theirs) if not piece.strip()), "")
    added = [each for piece in _comments(hunk.theirs) if piece in new for each in (blanks, piece)]
    return [*added, *(piece for piece in hunk.ours if piece not in gone)]


def _same_content(one: SourceText, other: SourceText) -> bool:
    """Whether two texts differ in comments and layout only."""
    contents = ElementContents()
    try:
        return contents.number(_tree(one, LIFTED_LIMITS)) == contents.number(_tree(other, LIFTED_LIMITS))
    except UnmergeableError:
        return False
