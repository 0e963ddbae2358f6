"""What a check leaves behind: nothing that only the garbage collector finds, which looks too seldom."""

import gc
import os
from collections.abc import Callable
from pathlib import Path

import pytest

from testbed import robots
from tests.profile import DEEP
from twinform.server.checking import CheckJob, EditorSettings, check

pytestmark = pytest.mark.slow

TEXT = robots.urdf(30)
EDITS: dict[str, Callable[[int], str]] = {
    "a name": lambda n: TEXT.replace('name="', f'name="e{n}_', 5),
    "an attribute that is not known": lambda n: TEXT.replace("<link ", f'<link q{n}="1" ', 3),
    "a link twice": lambda n: TEXT.replace("</robot>", f'<link name="a{n}"/><link name="a{n}"/></robot>'),
    "a number": lambda n: TEXT.replace('value="', f'value="x{n}', 4),
    "half a text": lambda n: TEXT[: 1000 + n % 900],
}
_MOST_OBJECTS = 50
_MOST_GROWTH = 8 * 2**20


def edit(name: str, number: int) -> None:
    path = Path("/nowhere/robot.urdf")
    check(CheckJob(path, {str(path): EDITS[name](number).encode()}, EditorSettings()))


@pytest.mark.parametrize("name", EDITS)
def test_a_check_leaves_nothing_to_the_garbage_collector(name: str) -> None:
    for number in range(3):
        edit(name, number)
    gc.collect()
    gc.disable()
    try:
        edit(name, 3)
        assert gc.collect() < _MOST_OBJECTS
    finally:
        gc.enable()


@pytest.mark.deep
@pytest.mark.parametrize("name", EDITS)
def test_two_thousand_edits_take_no_more_memory_than_some(name: str) -> None:
    assert DEEP
    for number in range(100):
        edit(name, number)
    before = resident()
    for number in range(2_000):
        edit(name, number)
    assert resident() - before < _MOST_GROWTH


def resident() -> int:
    return int(Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")
