"""Every field of every node is described where `help` and the reference of the IR read it: in the class's docstring."""

import inspect
import pydoc
import re
from dataclasses import MISSING

import pytest
from griffe import Docstring, DocstringSectionAttributes

import twinform.ir
from twinform.ir.record import Sourced, fields_of

from .kinds import kinds


def _described(kind: type[Sourced]) -> dict[str, str]:
    sections = Docstring(kind.__doc__ or "").parse("google", warnings=False)
    found = [each for each in sections if isinstance(each, DocstringSectionAttributes)]
    return {attribute.name: attribute.description for section in found for attribute in section.value}


KINDS = {kind.__name__: kind for kind in kinds()}


@pytest.mark.parametrize("name", sorted(KINDS))
def test_every_field_is_described(name: str):
    kind = KINDS[name]
    described = _described(kind)
    assert list(described) == [name for name in fields_of(kind) if name in inspect.get_annotations(kind)]
    assert all(description.endswith(".") for description in described.values())


_UNIT = re.compile(r"\b(m|rad|kg|s|Hz|N|m\\^2|m/s|rad/s|degrees|pixels)\b|without a unit|from 0 to 1|from -1 to 1")


@pytest.mark.parametrize("name", sorted(KINDS))
def test_every_number_has_a_unit_or_says_that_it_has_none(name: str):
    kind = KINDS[name]
    described = _described(kind)
    numbers = {
        field for field, info in fields_of(kind).items() if re.search(r"\bfloat\b", str(info.type))
    } & described.keys()
    assert [field for field in numbers if not _UNIT.search(described[field])] == []


def test_help_begins_with_the_fields():
    shown = pydoc.plain(pydoc.render_doc(twinform.ir.Link))
    assert shown.index("inertial: mass, center of mass and inertia") < shown.index("Method resolution order")


@pytest.mark.parametrize("name", sorted(KINDS))
def test_help_has_the_types_and_defaults_of_the_fields(name: str):
    kind = KINDS[name]
    parameters = inspect.signature(kind).parameters
    for field, info in fields_of(kind).items():
        if info.compare:
            assert parameters[field].annotation is not inspect.Parameter.empty
            assert (parameters[field].default is inspect.Parameter.empty) == (info.default is MISSING)
