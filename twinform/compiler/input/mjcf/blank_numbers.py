"""Attributes of MJCF that should have numbers and are empty, which MuJoCo takes as if they were not written."""

from twinform.diagnostics import rules
from twinform.schemas import Context, Fact, XmlElement, rows_by_name, table
from twinform.schemas.xml import is_blank

_MAY_BE_EMPTY = frozenset({"string", "words", "bool", "doubles", "ints"})
"""Types whose values may be empty, and `bool`, which MuJoCo refuses then."""


def leave_blank_numbers_out(root: XmlElement, context: Context) -> None:
    """Take empty numbers out of a tree, with a warning for each; required ones stay, and are errors as in MuJoCo."""
    facts = table("mjcf")
    waiting: list[tuple[XmlElement, Fact]] = [(root, facts.definitions[facts.root])]
    while waiting:
        element, row = waiting.pop()
        rows = rows_by_name(facts.resolve(row).rows, context.version)
        for name in [str(name) for name, text in element.items() if is_blank(str(text))]:
            found = rows.get(f"@{name}")
            if found is not None and not found.required and not found.enum and found.type not in _MAY_BE_EMPTY:
                message = f"{name!r} of <{element.tag}> is empty, which MuJoCo takes as if it were not there"
                context.report(rules.BLANK_VALUE, element, message, f"@{name}", found="")
                del element.attrib[name]
        # in their order, in which to count siblings takes linear time
        inside = [each for each in element.iterchildren("*", reversed=True) if each.tag in rows]
        waiting += [(each, rows[str(each.tag)]) for each in inside]
