"""The comments of a file that was read, and the tree of elements that they stood in."""

from typing import NamedTuple

from twinform.dataclass import dataclass
from twinform.diagnostics import Source
from twinform.lazy import lazy_pattern
from twinform.schemas import XmlElement, path_of

# The step of a path for the only element of its name may have it or not.
FIRST = "[1]"
# How comments begin that are for us, such as suppressions of findings.
_OWN = lazy_pattern(r"\s*twinform:")


class SourceComment(NamedTuple):
    """A comment, and where it stood.

    `around` is the element that it was in, and `before` and `behind` are the next elements on both sides. They are None
    for a comment outside of the root, which may be above it. A comment with a line of its own is about what follows,
    others are about what stands before them. `indent` is the indent of a comment of several lines.
    """

    text: str
    line: int
    around: XmlElement | None = None
    before: XmlElement | None = None
    behind: XmlElement | None = None
    is_above: bool = False
    has_own_line: bool = False
    indent: str | None = None


@dataclass(frozen=True, slots=True)
class Comments:
    """The comments of a file, the tree that they were taken from, and the names of the file in sources of nodes.

    `partial` means that not all of the file is converted, and `foreign` that it is converted to the other format. Where
    a file becomes several, only comments `inside` of an element go along, or those `outside` of some elements.
    """

    tree: XmlElement
    found: tuple[SourceComment, ...]
    files: frozenset[str] = frozenset()
    partial: bool = False
    foreign: bool = False
    inside: XmlElement | None = None
    outside: frozenset[XmlElement] = frozenset()

    def travels(self, comment: SourceComment) -> bool:
        """Whether a comment goes along with the conversion."""
        # The finding that a suppression is about is one in its own format.
        if self.foreign and _OWN.match(comment.text):
            return False
        if self.inside is None and not self.outside:
            return True
        around = set[XmlElement]()
        if comment.around is not None:
            around.update((comment.around, *comment.around.iterancestors()))
        return (self.inside is None or self.inside in around) and not around & self.outside

    def element(self, source: Source) -> XmlElement | None:
        """Return the element that a node was read from."""
        path = source.path.replace(FIRST, "")
        name = path.rpartition("/")[2].partition("[")[0]
        found = (each for each in self.tree.iter(name) if each.sourceline == source.line)
        return next((each for each in found if path_of(each).replace(FIRST, "") == path), None)
