"""Generator of the page on what `diff` leaves out.

Run `python -m twinform.compiler.compare.not_compared_page FILE [--check]`.
"""

import sys

from twinform.compiler.compare.not_compared import NOT_COMPARED
from twinform.diagnostics.generated_files import main

_INTRODUCTION = """\
# What diff does not compare

`twinform diff` compares every value of both files but these. A changed value anywhere else is a difference or a note: a
test changes values of real files, and looks. Also the same are: another order of elements that have names, comments, a
default that is written or not, and other notation for a number or a pose. The XPaths are those of the values, or of
elements with all below them.
This file is made by `python -m twinform.compiler.compare.not_compared_page docs/reference/not_compared.md`; do not
edit it.
"""


def page() -> str:
    """The page as Markdown."""
    sections = (f"## {each.what.capitalize()}\n\n{each.why}\n\n{_code(each.xpath)}" for each in NOT_COMPARED)
    return "\n".join((_INTRODUCTION, *sections))


def _code(xpath: str) -> str:
    paths = "\n".join(part.strip() for part in xpath.split(" | "))
    return f"```text\n{paths}\n```\n"


if __name__ == "__main__":
    sys.exit(main(page(), sys.argv[1:]))
