"""No real xacro file breaks the compiler, and each becomes what the `xacro` command makes of it."""

from pathlib import Path

import pytest

from reports.text_survives.xacro import KNOWN
from testbed.corpus.examine_xacro import examine_xacro
from testbed.corpus.expressions import evaluated, expressions
from testbed.corpus.files import xacro_files
from testbed.corpus.plain_xacro import compare, users_of_xacro
from tests.corpus.portions import portions
from tests.profile import DEEP

PORTIONS = portions(xacro_files())
COMPARED = portions(users_of_xacro())


@pytest.mark.parametrize("portion", PORTIONS)
def test_a_xacro_file_is_expanded_or_refused_with_a_line(corpus: Path, portion: str):
    assert corpus.is_dir()
    found = [examine_xacro(file.path, file.name) for file in PORTIONS[portion]]
    assert {each.name: each.faults for each in found if each.faults} == {}
    assert [each.name for each in found if each.accepted and not each.expanded] == []


@pytest.mark.parametrize("portion", COMPARED)
def test_a_file_becomes_what_xacro_makes_of_it(corpus: Path, portion: str):
    assert corpus.is_dir()
    found = [compare(file) for file in COMPARED[portion][:: 1 if DEEP else 2]]
    assert [each for each in found if not each.is_alike and not KNOWN.why("files", each.name)] == []


def test_an_expression_has_the_value_that_xacro_gives_it(corpus: Path):
    assert corpus.is_dir()
    found = [each for expression in expressions()[:: 1 if DEEP else 10] for each in evaluated(expression)]
    assert [each for each in found if not each.is_alike] == []
    assert any(not each.theirs.is_mistake for each in found)
