"""What stands again where it may stand once, as it stood before: it is no other robot, and `check --fix` deletes it."""

from collections.abc import Iterator
from copy import deepcopy
from pathlib import Path
from random import Random

import pytest

from testbed.fixed_files import fixed_file
from testbed.value_mutants import described, text_of, tree_of
from tests.profile import DEEP
from twinform.schemas import XmlElement

pytestmark = pytest.mark.slow

_CASES = Path(__file__).parent / "cases"
_FILES = sorted(path for path in _CASES.rglob("*") if path.suffix in {".urdf", ".sdf"})
_EVERY = 1 if DEEP else 25
_EACH = 4


def _doubled(path: Path) -> Iterator[tuple[XmlElement, XmlElement]]:
    """A few elements of a file and their copies, one at a time: each copy stands behind its element meanwhile."""
    root, random = tree_of(path, ()), Random(path.name)
    if root is None:
        return
    once = [
        child
        for each in described(root)
        for name, row in each.rows.items()
        if not row.repeats and not name.startswith("@")
        for child in each.element.findall(name)[:1]
    ]
    for element in random.sample(once, min(_EACH, len(once))):
        copy = deepcopy(element)
        copy.tail = None
        element.addnext(copy)
        yield root, copy
        around = copy.getparent()
        assert around is not None
        around.remove(copy)


@pytest.mark.parametrize("path", _FILES[::_EVERY], ids=lambda path: path.relative_to(_CASES).as_posix())
def test_a_copy_behind_an_element_may_be_deleted(path: Path):
    for root, copy in _doubled(path):
        assert fixed_file(path.name, text_of(root)).faults == (), copy.getroottree().getpath(copy)
