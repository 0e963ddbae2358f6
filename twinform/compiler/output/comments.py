"""Comments of a file in what it is converted to: each stands where the part went that it stood at in the file.

The document knows nothing of comments. When a tree is written, its writer notes which element each part has become, and
a part knows where it was read. So a comment is led from its place in the tree of the source to one in the tree of the
target: before or behind the element that its own has become, at the end of that which it stood in, or, where these have
no place, at the nearest part that has one.
"""

import re
from collections import defaultdict
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from itertools import islice

from lxml import etree

from twinform.diagnostics import Source
from twinform.schemas import Written, XmlElement, path_of

_OTHER_NAMES = {"origin": "pose", "pose": "origin", "uri": "mesh", "rgba": "color"}
"""What an element may be called in the other format, where it is no part of the document."""
_LARGE = frozenset({"robot", "sdf", "world", "model", "link", "gazebo"})
"""Elements that hold many parts: an element of some name anywhere in them says nothing."""
_WHOLE = frozenset({"robot", "sdf", "world", "model"})
"""Elements that are not what is in them."""
_REFERRED = ("link", "joint", "frame")
"""What an extension may refer to by its name."""
# The IR does not know of comments: a field in each node would be copied and merged by a hundred
# passes, and patching the text afterwards could tell by names only which piece came from where. A
# node knows the line that it was read at and the writer which element it becomes, so comments
# follow these. 200 comments in 1,000 links cost 45 %.
_FAR = 8
"""So many elements behind a comment are looked at for one that it can stand before."""
_MOST = 5000
"""So many comments are placed, and more stand behind the root: a hostile file may have a million at one place. The most
in a real file are some hundreds."""
_LONGEST_RUN = 32
"""So many comments on one line are looked at for its ends."""
_OWN = re.compile(r"\s*twinform:")
"""How comments begin that are for us, such as suppressions of findings, which are about one format."""
_STEP = "  "
_FIRST = "[1]"


@dataclass(frozen=True, slots=True)
class Comments:
    """The tree of a file with its comments, and the names that the file has as the source of parts.

    `partial` means that not all of it is converted. In the other format comments for twinform itself are `foreign`.
    Where a file becomes several, only comments `inside` of a part go along, or those `outside` of these.
    """

    tree: XmlElement
    files: frozenset[str]
    partial: bool = False
    foreign: bool = False
    inside: XmlElement | None = None
    outside: frozenset[XmlElement] = frozenset()

    def travels(self, comment: XmlElement) -> bool:
        """Whether a comment goes along."""
        # The finding that a suppression is about is one in its own format.
        if self.foreign and _OWN.match(comment.text or ""):
            return False
        if self.inside is None and not self.outside:
            return True
        around = set(comment.iterancestors())
        return (self.inside is None or self.inside in around) and not around & self.outside

    def element(self, source: Source) -> XmlElement | None:
        """The element of a part."""
        path = source.path.replace(_FIRST, "")
        found = (each for each in self.tree.iter(_last_name(path)) if each.sourceline == source.line)
        return next((each for each in found if path_of(each).replace(_FIRST, "") == path), None)


@dataclass(slots=True)
class Placed:
    """What is not in the tree, or only to be seen in its text: comments around the root, and those on lines of others.

    `left` are those without a place, with their lines.
    """

    top: list[str] = field(default_factory=list[str])
    bottom: list[str] = field(default_factory=list[str])
    beside: list[XmlElement] = field(default_factory=list[XmlElement])
    moved: list[tuple[XmlElement, str]] = field(default_factory=list[tuple[XmlElement, str]])
    left: list[tuple[str, int]] = field(default_factory=list[tuple[str, int]])

    def on_lines(self, root: XmlElement) -> None:
        """Put comments on the lines of what they stand beside, in a tree that is indented."""
        for comment in self.beside:
            before, parent = comment.getprevious(), comment.getparent()
            if before is not None:
                before.tail = before.tail if (before.tail or "").strip() else " "
            elif parent is not None:
                parent.text = parent.text if (parent.text or "").strip() else " "
        for comment, old in self.moved:
            new = _STEP * sum(1 for _ in comment.iterancestors())
            comment.text = re.sub(rf"\n{old}(?![\r\n])", f"\n{new}", comment.text or "")

    def framed(self, text: str) -> str:
        """The text of a file with the comments around its root."""
        declaration, _, rest = text.partition("\n")
        bottom = "".join(f"{each}\n" for each in self.bottom)
        return "".join((f"{declaration}\n", *(f"{each}\n" for each in self.top), rest, bottom))


def _last_name(path: str) -> str:
    return path.rpartition("/")[2].partition("[")[0]


def place_comments(comments: Comments, root: XmlElement, written: Written) -> Placed:
    """Put the comments of a file into the tree that its document has become."""
    placing = _Placing(comments, root, written)
    placing.run()
    return placing.placed


class _Placing:
    """One run over the comments of a file."""

    def __init__(self, comments: Comments, root: XmlElement, written: Written) -> None:
        self.comments, self.root = comments, root
        self.placed = Placed()
        self.parts: defaultdict[int, list[tuple[Source, XmlElement]]] = defaultdict(list)
        for part, element in written:
            source: Source | None = part.source
            if source is not None and source.file in comments.files:
                self.parts[source.line].append((source, element))
        self.places: dict[XmlElement, int] = {}
        self.known: dict[XmlElement, XmlElement | None] = {}
        self.last_beside: dict[XmlElement, XmlElement] = {}
        self.first_in: dict[XmlElement, XmlElement] = {}
        self.named: dict[tuple[str, str], XmlElement] = {}

    def run(self) -> None:
        """Place them all, in their order."""
        tree = self.comments.tree
        around = [*reversed([*tree.itersiblings(preceding=True)]), None, *tree.itersiblings()]
        before_root = True
        for each in around:
            if each is None:
                before_root = False
                for number, comment in enumerate(tree.iter(etree.Comment)):
                    if not self.comments.travels(comment):
                        continue
                    if number < _MOST:
                        self._place(comment)
                    else:
                        self.placed.bottom.append(_text(comment))
            elif each.tag is etree.Comment and self.comments.travels(each):
                (self.placed.top if before_root else self.placed.bottom).append(_text(each))

    def _place(self, comment: XmlElement) -> None:
        made = etree.Comment(_legal(comment.text or ""))
        parent = comment.getparent()
        assert parent is not None  # noqa: S101 - those around the root are placed already
        anchor, behind = _neighbors(comment)
        if _begins_line(comment) or (anchor is not None and not _ends_line(comment)):
            self._remember_indent(comment, made)
            done = self._before(anchor, made) if anchor is not None else self._last_in(parent, made)
        elif behind is not None:
            done = self._beside(behind, made) or self._before(behind, made)
        else:
            done = self._first_in(parent, made)
        if not done:
            self._without_place(comment)

    def _remember_indent(self, comment: XmlElement, made: XmlElement) -> None:
        if "\n" in (comment.text or ""):
            self.placed.moved.append((made, _blanks_before(comment).rpartition("\n")[2]))

    def _without_place(self, comment: XmlElement) -> None:
        if self.comments.partial:
            words = " ".join((comment.text or "").split())
            message = f"the comment {words!r} is about what is not converted"
            self.placed.left.append((message, comment.sourceline or 0))
        else:
            self.placed.top.append(_text(comment))

    def _before(self, element: XmlElement, made: XmlElement) -> bool:
        """Put a comment before what an element, or the next one behind it, has become; else at the end around it."""
        parent = element.getparent()
        is_outside = self.comments.partial and (parent is None or self._target(parent) is None)
        for each in (element, *islice(element.itersiblings("*"), 0 if is_outside else _FAR)):
            target = self._target(each)
            if target is self.root:
                self.placed.top.append(_text(made))
                return True
            if target is not None:
                target.addprevious(made)
                return True
        return parent is not None and self._last_in(parent, made)

    def _beside(self, element: XmlElement, made: XmlElement) -> bool:
        """Put a comment behind what an element has become, on its line."""
        target = self._target(element)
        if target is None:
            return False
        if target is self.root:
            self.placed.bottom.append(_text(made))
            return True
        self._put_beside(target, made)
        return True

    def _put_beside(self, target: XmlElement, made: XmlElement) -> None:
        self.last_beside.get(target, target).addnext(made)
        self.last_beside[target] = made
        self.placed.beside.append(made)

    def _first_in(self, parent: XmlElement, made: XmlElement) -> bool:
        """Put a comment behind the start tag of what an element has become."""
        target = self._target(parent)
        if target is None:
            return self._before(parent, made)
        if target.text or (not len(target) and target is not self.root):
            if target is self.root:
                return self._last_in(parent, made)
            self._put_beside(target, made)
            return True
        after = self.first_in.get(target)
        if after is None:
            target.insert(0, made)
        else:
            after.addnext(made)
        self.first_in[target] = made
        self.placed.beside.append(made)
        return True

    def _last_in(self, parent: XmlElement, made: XmlElement) -> bool:
        """Put a comment at the end of what an element has become."""
        target = self._target(parent)
        if target is None:
            return parent.getparent() is not None and self._before(parent, made)
        if target.text and target is not self.root:
            self._put_beside(target, made)
        else:
            target.append(made)
        return True

    def _target(self, element: XmlElement) -> XmlElement | None:
        """What an element has become."""
        if element not in self.known:
            ways = (self._own, self._inside, self._of_child, self._of_name)
            self.known[element] = next((found for way in ways if (found := way(element)) is not None), None)
        return self.known[element]

    def _own(self, element: XmlElement) -> XmlElement | None:
        """What a part of the document has become; of several elements that which is called like it, or the first."""
        parts = self.parts.get(element.sourceline or 0)
        if not parts:
            return None
        path = path_of(element, self.places).replace(_FIRST, "")
        found = [made for source, made in parts if source.path.replace(_FIRST, "") == path and self._is_there(made)]
        alike = (each for each in found if each.tag == element.tag)
        return next(alike, found[-1 if element is self.comments.tree else 0] if found else None)

    def _is_there(self, element: XmlElement) -> bool:
        return element is self.root or any(above is self.root for above in element.iterancestors())

    def _inside(self, element: XmlElement) -> XmlElement | None:
        """What an element has become that is no part of the document: by its name in the part that it belongs to."""
        parent = element.getparent()
        around = self._target(parent) if parent is not None else None
        if around is None or parent is None:
            return None
        for tag in (str(element.tag), _OTHER_NAMES.get(str(element.tag), "")):
            found = around.findall(tag) if tag else []
            if found:
                place = sum(1 for _ in element.itersiblings(str(element.tag), preceding=True))
                return found[min(place, len(found) - 1)]
            if tag and around.tag not in _LARGE:
                deeper = next(around.iterdescendants(tag), None)
                if deeper is not None:
                    return deeper
        return None

    def _of_name(self, element: XmlElement) -> XmlElement | None:
        """What has the name of an element, and its tag but for the namespace: a carrier; or what it refers to."""
        name, reference = element.get("name"), element.get("reference")
        if name is None and reference is None:
            return None
        if not self.named:
            for each in self.root.iterdescendants("*"):
                if (its := each.get("name")) is not None:
                    self.named.setdefault((etree.QName(each).localname, its), each)
        if reference is None:
            return self.named.get((etree.QName(element).localname, name or ""))
        found = (self.named.get((tag, reference)) for tag in _REFERRED)
        return next((each for each in found if each is not None), None)

    def _of_child(self, element: XmlElement) -> XmlElement | None:
        """What the first child has become that has become anything, where the element itself is only around it."""
        if element.tag in _WHOLE:
            return None
        found = (self._own(each) for each in element.iterchildren("*"))
        return next((each for each in found if each is not None), None)


def _neighbors(comment: XmlElement) -> tuple[XmlElement | None, XmlElement | None]:
    """The elements behind and before a comment, in the same element."""
    return next(comment.itersiblings("*"), None), next(comment.itersiblings("*", preceding=True), None)


def _blanks_before(comment: XmlElement) -> str:
    before, parent = comment.getprevious(), comment.getparent()
    text = before.tail if before is not None else parent.text if parent is not None else None
    return text or ""


def _begins_line(comment: XmlElement) -> bool:
    """Whether nothing stands before it on its line but other comments that begin it."""
    return any("\n" in _blanks_before(each) for each in _run(comment, lambda each: each.getprevious()))


def _ends_line(comment: XmlElement) -> bool:
    """Whether no element stands behind it on its line."""
    return any("\n" in (each.tail or "") for each in _run(comment, lambda each: each.getnext()))


def _run(comment: XmlElement, step: Callable[[XmlElement], XmlElement | None]) -> Iterator[XmlElement]:
    """A comment and those that follow each other in one direction."""
    here: XmlElement | None = comment
    for _ in range(_LONGEST_RUN):
        if here is None or here.tag is not etree.Comment:
            return
        yield here
        here = step(here)


def _text(comment: XmlElement) -> str:
    return f"<!--{_legal(comment.text or '')}-->"


def _legal(text: str) -> str:
    """The text of a comment without what other parsers let pass: two hyphens, and one at the end."""
    text = re.sub("-(?=-)", "- ", text)
    return f"{text} " if text.endswith("-") else text
