"""Places the comments of a file in the text that it is converted to.

The document has no comments. But the writer notes which element each part has become, and a part knows where it was
read. So each comment is put before or behind the element that its neighbor has become, at the end of the element that
it stood in, or, where these have no place, at the nearest part that has one.
"""

import re
from collections import defaultdict
from collections.abc import Iterable
from itertools import chain, islice
from typing import NamedTuple

from lxml import etree

from twinform.compiler.output.source_comments import FIRST, Comments, SourceComment
from twinform.diagnostics import Source
from twinform.lazy import lazy_pattern
from twinform.schemas import WrittenParts, XmlElement, end_of_element, in_attribute, path_of

# The IR does not know of comments. A field in each node would be copied and merged by a hundred
# passes. In the source of a node they would go where it goes, but most stand at elements that are no
# nodes, such as `<origin>`, and a node made of two has one source. Written while the node with their
# line is written, they would be lost where there is none, which is known only in the end.
# A node knows the line that it was read at and the writer where its element stands in the text, so
# comments follow these, into the finished text, which is validated and the same without them.

# What an element may be called in the other format, where it is no part of the document.
_OTHER_NAMES = {"origin": "pose", "pose": "origin", "uri": "mesh", "rgba": "color"}
# Elements that hold many parts: an element of some name anywhere in them says nothing.
_LARGE = frozenset({"robot", "sdf", "world", "model", "link", "gazebo"})
# Elements that are not what is in them.
_WHOLE = frozenset({"robot", "sdf", "world", "model"})
# What an extension may refer to by its name.
_REFERRED = ("link", "joint", "frame")
# So many elements behind a comment are looked at for one that it can stand before.
_FAR = 8
_STEP = "  "
# What stands on the line of an element comes before what stands on lines below it.
_BESIDE, _BELOW = 0, 1
_START = lazy_pattern(r"<[^\s/>?][^\s/>]*")
_NAME = lazy_pattern(r' name="([^"]*)"')


class _Target(NamedTuple):
    """An element in the text: where its start tag begins and ends, the line break and indent before it, its name."""

    start: int
    head: int
    indent: str
    tag: str


class _Insertion(NamedTuple):
    """A text that is inserted at an offset, in the order of ranks."""

    at: int
    rank: int
    text: str


def place_comments(
    comments: Comments, text: str, parts: WrittenParts, namespaces: Iterable[tuple[str, str]]
) -> tuple[str, list[SourceComment]]:
    """Return a converted text with the comments of its source, and the comments that have no place in it."""
    placing = _CommentPlacing(comments, text, parts, {uri: prefix for prefix, uri in namespaces})
    placing.run()
    return placing.with_comments(), placing.left


class _CommentPlacing:
    """One run over the comments of a file."""

    def __init__(self, comments: Comments, text: str, parts: WrittenParts, prefixes: dict[str, str]) -> None:
        self.comments, self.text, self.prefixes = comments, text, prefixes
        self.top: list[str] = []
        self.bottom: list[str] = []
        self.left: list[SourceComment] = []
        self.insertions: list[_Insertion] = []
        self.filled: defaultdict[_Target, list[str]] = defaultdict(list)
        """Comments at the end of elements that are empty otherwise."""
        self.root = self._target_at(text.index("\n<") + 1)
        self.parts: defaultdict[int, list[tuple[Source, int]]] = defaultdict(list)
        files, by_line = comments.files, self.parts
        for part, start in parts:
            source: Source = part.source
            if source.file in files:
                by_line[source.line].append((source, start))
        self.places: dict[XmlElement, int] = {}
        self.known: dict[XmlElement, _Target | None] = {}
        self.ends: dict[_Target, int] = {}
        self.starts: dict[int, defaultdict[str, list[int]]] = {}
        self.inside: dict[tuple[_Target, str], list[int]] = {}
        self.named: dict[tuple[str, str], int] = {}

    def run(self) -> None:
        """Find a place in the text for each comment, in the order of the file."""
        for comment in filter(self.comments.travels, self.comments.found):
            if comment.around is not None:
                self._place(comment, comment.around)
            else:
                (self.top if comment.is_above else self.bottom).append(_format_comment(comment))

    def with_comments(self) -> str:
        """Return the text with the comments in it."""
        for target, inside in self.filled.items():
            opened = f">{''.join(inside)}{target.indent}</{target.tag}>"
            self.insertions.append(_Insertion(target.head - len("/>"), _BELOW, opened))
        pieces: list[str] = []
        done = 0
        for at, _, made in sorted(self.insertions, key=lambda each: each[:2]):
            pieces += (self.text[done:at], made)
            done = at + (len("/>") if made[0] == ">" else 0)
        declaration, _, rest = "".join((*pieces, self.text[done:])).partition("\n")
        top, bottom = ("".join([f"{each}\n" for each in around]) for around in (self.top, self.bottom))
        return f"{declaration}\n{top}{rest}{bottom}"

    def _place(self, comment: SourceComment, around: XmlElement) -> None:
        if comment.has_own_line:
            behind = comment.behind
            done = self._put_before(behind, comment) if behind is not None else self._put_last(around, comment)
        elif comment.before is not None:
            done = self._put_beside(comment.before, comment) or self._put_before(comment.before, comment)
        else:
            done = self._put_first(around, comment)
        if not done:
            self._without_place(comment)

    def _without_place(self, comment: SourceComment) -> None:
        if self.comments.partial:
            self.left.append(comment)
        else:
            self.top.append(_format_comment(comment))

    def _put_before(self, element: XmlElement, comment: SourceComment) -> bool:
        """Put a comment before what an element, or the next one, has become, or else at the end of their parent."""
        parent = element.getparent()
        is_outside = self.comments.partial and (parent is None or self._target(parent) is None)
        for each in chain((element,), islice(element.itersiblings("*"), 0 if is_outside else _FAR)):
            target = self._target(each)
            if target == self.root:
                self.top.append(_format_comment(comment))
                return True
            if target is not None:
                self._add_below(target.start - len(target.indent), target.indent, comment)
                return True
        return parent is not None and self._put_last(parent, comment)

    def _put_beside(self, element: XmlElement, comment: SourceComment) -> bool:
        """Put a comment behind what an element has become, on its line."""
        target = self._target(element)
        if target is None:
            return False
        if target == self.root:
            self.bottom.append(_format_comment(comment))
        else:
            self._add_beside(target, comment)
        return True

    def _put_first(self, parent: XmlElement, comment: SourceComment) -> bool:
        """Put a comment behind the start tag of what an element has become."""
        target = self._target(parent)
        if target is None:
            return self._put_before(parent, comment)
        if self._has_children(target):
            self.insertions.append(_Insertion(target.head, _BESIDE, f" {_format_comment(comment)}"))
            return True
        return self._put_last(parent, comment) if target == self.root else self._put_beside(parent, comment)

    def _put_last(self, parent: XmlElement, comment: SourceComment) -> bool:
        """Put a comment at the end of what an element has become."""
        target = self._target(parent)
        if target is None:
            return parent.getparent() is not None and self._put_before(parent, comment)
        inner = target.indent + _STEP
        if self._is_empty(target):
            self.filled[target].append(inner + _format_comment(comment, inner))
        elif self._has_children(target):
            end = self.text.rindex("</", target.head, self._end_of(target))
            self._add_below(end - len(target.indent), inner, comment)
        else:
            self._add_beside(target, comment)
        return True

    def _add_beside(self, target: _Target, comment: SourceComment) -> None:
        self.insertions.append(_Insertion(self._end_of(target), _BESIDE, f" {_format_comment(comment, target.indent)}"))

    def _add_below(self, at: int, indent: str, comment: SourceComment) -> None:
        self.insertions.append(_Insertion(at, _BELOW, indent + _format_comment(comment, indent)))

    def _target_at(self, start: int) -> _Target:
        tag = _START.match(self.text, start)
        before = self.text.rfind("\n", 0, start)
        indent = self.text[before:start] if before >= 0 else ""
        name = tag[0][1:] if tag else ""
        return _Target(start, self.text.index(">", start) + 1, "" if indent.strip() else indent, name)

    def _is_empty(self, target: _Target) -> bool:
        return self.text[target.head - 2] == "/"

    def _has_children(self, target: _Target) -> bool:
        """Whether an element has others in it, and no text before them."""
        return not self._is_empty(target) and self.text.startswith(f"{target.indent}{_STEP}<", target.head)

    def _end_of(self, target: _Target) -> int:
        if target not in self.ends:
            self.ends[target] = end_of_element(self.text, target.start)
        return self.ends[target]

    def _target(self, element: XmlElement) -> _Target | None:
        """Return what an element has become."""
        if element not in self.known:
            ways = (self._target_of_part, self._target_in_parent, self._target_of_child, self._target_by_name)
            self.known[element] = next((found for way in ways if (found := way(element)) is not None), None)
        return self.known[element]

    def _target_of_part(self, element: XmlElement) -> _Target | None:
        """Return what a part of the document has become; of several elements the one with its tag, or the first."""
        line = element.sourceline or 0
        if line not in self.starts:
            self.starts[line] = defaultdict(list)
            for source, start in self.parts.get(line, ()):
                self.starts[line][source.path.replace(FIRST, "")].append(start)
        if not self.starts[line]:
            return None
        path = path_of(element, self.places).replace(FIRST, "")
        found = [self._target_at(start) for start in self.starts[line].get(path, ())]
        alike = (each for each in found if each.tag == self._written_name(element))
        return next(alike, found[-1 if element is self.comments.tree else 0] if found else None)

    def _written_name(self, element: XmlElement) -> str:
        namespace, _, local = str(element.tag).rpartition("}")
        prefix = self.prefixes.get(namespace[1:]) if namespace else ""
        return f"{prefix}:{local}" if prefix else local

    def _target_in_parent(self, element: XmlElement) -> _Target | None:
        """Return what an element that is not a part of the document has become: one of its name in its parent."""
        parent = element.getparent()
        around = self._target(parent) if parent is not None else None
        if around is None or self._is_empty(around):
            return None
        for tag in filter(None, (self._written_name(element), _OTHER_NAMES.get(str(element.tag)))):
            found = self._starts_inside(around, tag)
            if found:
                place = sum(1 for _ in element.itersiblings(str(element.tag), preceding=True))
                return self._target_at(found[min(place, len(found) - 1)])
        return None

    def _starts_inside(self, around: _Target, tag: str) -> list[int]:
        """Return where the children with a tag begin in an element; if there are none, the first one deeper inside."""
        if (around, tag) not in self.inside:
            span = around.head, self._end_of(around)
            named = rf"<{re.escape(tag)}(?=[\s/>])"
            # Behind text a child is on its line, and so is a comment before it: without the comments the
            # text is what it is when none are wanted.
            before = f"{around.indent}{_STEP}" if self._has_children(around) else r"(?<=[^>\s])"
            children = re.compile(f"{before}({named})").finditer(self.text, *span)
            found = [each.start(1) for each in children]
            deeper = re.compile(named).search(self.text, *span) if not found and around.tag not in _LARGE else None
            self.inside[around, tag] = [deeper.start()] if deeper is not None else found
        return self.inside[around, tag]

    def _target_by_name(self, element: XmlElement) -> _Target | None:
        """Return an element with the same name and tag, whatever its namespace is, or one that an element refers to."""
        name, reference = element.get("name"), element.get("reference")
        if name is None and reference is None:
            return None
        if not self.named:
            self.named = self._starts_by_name()
        if reference is None:
            wanted = [(etree.QName(element).localname, in_attribute(name or ""))]
        else:
            wanted = [(tag, in_attribute(reference)) for tag in _REFERRED]
        return next((self._target_at(self.named[each]) for each in wanted if each in self.named), None)

    def _starts_by_name(self) -> dict[tuple[str, str], int]:
        """Return where elements begin, by their tags without prefixes and their names."""
        made = dict[tuple[str, str], int]()
        done = self.root.head
        for found in _NAME.finditer(self.text, done):
            start = self.text.rfind("<", done, found.start())
            done = found.end()
            if start >= 0 and self.text.find(">", start, found.start()) < 0:  # it is no text
                tag = self.text[start + 1 : self.text.index(" ", start)].rpartition(":")[2]
                made.setdefault((tag, found[1]), start)
        return made

    def _target_of_child(self, element: XmlElement) -> _Target | None:
        """Return what the first child with a place has become, for elements that only wrap their children."""
        if element.tag in _WHOLE:
            return None
        found = (self._target_of_part(each) for each in element.iterchildren("*"))
        return next((each for each in found if each is not None), None)


def _format_comment(comment: SourceComment, indent: str | None = None) -> str:
    """Format a comment; its lines are indented relative to the first one, which now has another indent.

    Double hyphens, and one at the end, which some parsers accept, are separated.
    """
    text = re.sub("-(?=-)", "- ", comment.text) if "--" in comment.text else comment.text
    text = f"{text} " if text.endswith("-") else text
    if comment.indent is not None and indent is not None:
        text = re.sub(rf"\n{comment.indent}(?![\r\n])", indent or "\n", text)
    return f"<!--{text}-->"
