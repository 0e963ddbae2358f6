"""What counts as a line of code."""

from pathlib import Path

from benchmarks.code_size import Size, rooms

_MODULE = '''\
"""About this module.

In two paragraphs.
"""

import os
from pathlib import (
    Path,
)

# a comment of its own line
LIMIT = 3  # and one that is not
"""What the limit is."""
TEXT = """
# no comment
"""


def function():
    """About this function."""
    import sys

    return os, Path, sys
'''


def test_imports_docstrings_comments_and_blank_lines_are_no_code(tmp_path: Path) -> None:
    package = tmp_path / "house" / "room"
    package.mkdir(parents=True)
    (package / "__init__.py").write_text('"""A room."""\n')
    (package / "module.py").write_text(_MODULE)
    (package / "made.py").write_text('"""Made by `make generate`; do not edit it."""\n\nX = 1\n')
    (package.parent / "beside.py").write_text("X = 1\n")
    assert dict(rooms(package.parent)) == {
        "house/*.py": Size(modules=1, lines=1, code=1),
        "house/room": Size(modules=3, packages=1, lines=24, code=6, comments=1, generated=3),
        "**house**": Size(modules=4, packages=1, lines=25, code=7, comments=1, generated=3),
    }
