"""The limit on what MJCF makes of a file by copying: replicates, attached models and values of classes.

A few bytes may stand for any number of copies, and a class may add a long text to every element. One budget for a file
and all that it attaches counts elements before they are made, and long texts with them.
"""

from twinform.compiler.input.mjcf.element_findings import ElementFindings
from twinform.compiler.input.size_limits import LIFTED_BY_TAGS, MOST_TAGS, Limits
from twinform.dataclass import dataclass
from twinform.diagnostics import rules
from twinform.schemas import XmlElement

MOST_COPIES = 100_000
"""The most elements that copying makes, unless more tags than usual are allowed."""
CHARACTERS = 200
"""How many characters of text count as one element."""


@dataclass(slots=True)
class CopyBudget:
    """How many elements may be made by copying, and how many were."""

    most: int
    made: int = 0
    is_spent: bool = False

    @classmethod
    def of(cls, limits: Limits) -> "CopyBudget":
        """Return the budget of a file that is read within limits."""
        return cls(limits.tags if limits.tags > MOST_TAGS else min(limits.tags, MOST_COPIES))

    def spend(self, amount: int, element: XmlElement, findings: ElementFindings) -> bool:
        """Count what is going to be made; the first time that it is too much, this is reported."""
        self.made += amount
        if self.made > self.most and not self.is_spent:
            self.is_spent = True
            message = f"copies make more than {self.most:,} elements of this file, the last of them by <{element.tag}>"
            findings.report(rules.OVERSIZED_FILE, element, message, help=LIFTED_BY_TAGS)
        return not self.is_spent

    def spend_on_replicates(self, root: XmlElement, findings: ElementFindings) -> bool:
        """Count what the replicates of a tree are going to make."""
        if next(root.iter("replicate"), None) is None:
            return True
        weights: dict[XmlElement, int] = {}
        worldbodies = list(root.iterchildren("worldbody"))
        for element in (each for top in worldbodies for each in _inner_first(top)):
            inside = sum(weights.pop(child, 0) for child in element.iterchildren("*"))
            if element.tag == "replicate":
                copied = (inside + inside * (len(element.get("sep", "")) // CHARACTERS)) * copies_of(element)
                if not self.spend(copied, element, findings):
                    return False
                weights[element] = copied
            else:
                weights[element] = inside + weight_of(element)
        return True


def copies_of(replicate: XmlElement) -> int:
    """Return how many copies a replicate makes: none where it says no number, or a negative one."""
    try:
        return max(int(replicate.get("count", "0")), 0)
    except ValueError:
        return 0


def weight_of(element: XmlElement, more: int = 0) -> int:
    """Return how many elements one counts as, with `more` characters in each of its names."""
    return 1 + (sum(map(len, element.values())) + more) // CHARACTERS


def weight_of_tree(root: XmlElement, more: int = 0) -> int:
    """Return how many elements a tree counts as."""
    return sum(weight_of(each, more) for each in root.iter("*"))


def _inner_first(top: XmlElement) -> list[XmlElement]:
    return list(top.iter("*"))[::-1]  # in reverse order of the file, all of an element comes before itself
