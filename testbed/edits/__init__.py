"""Edits of robot files as people make them, for the property that what stands in a file is what counts.

edits, edited = draw_edits(text, Random(1))
assert_edits_win(text, edits)
"""

from testbed.edits.drawing import draw_edit, draw_edits
from testbed.edits.edit import Edit, EditError, apply_all

__all__ = ["Edit", "EditError", "apply_all", "draw_edit", "draw_edits"]
