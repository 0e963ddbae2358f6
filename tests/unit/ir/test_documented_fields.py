"""Every field of every node is described where `help` and the reference of the IR read it: in the class's docstring."""

import importlib
import pkgutil
import pydoc
from collections.abc import Iterator

import pytest
from griffe import Docstring, DocstringSectionAttributes

import twinform.ir
from twinform.ir.sourced import Sourced

for _each in pkgutil.iter_modules(twinform.ir.__path__, "twinform.ir."):
    importlib.import_module(_each.name)


def _kinds(kind: type[Sourced] = Sourced) -> Iterator[type[Sourced]]:
    yield kind
    for each in kind.__subclasses__():
        if each.__module__.startswith("twinform.ir."):
            yield from _kinds(each)


def _described(kind: type[Sourced]) -> dict[str, str]:
    sections = Docstring(kind.__doc__ or "").parse("google", warnings=False)
    found = [each for each in sections if isinstance(each, DocstringSectionAttributes)]
    return {attribute.name: attribute.description for section in found for attribute in section.value}


KINDS = {kind.__name__: kind for kind in _kinds()}


@pytest.mark.parametrize("name", sorted(KINDS))
def test_every_field_is_described(name: str):
    kind = KINDS[name]
    described = _described(kind)
    assert list(described) == [name for name in kind.model_fields if name in vars(kind).get("__annotations__", {})]
    assert all(description.endswith(".") for description in described.values())


def test_help_begins_with_the_fields():
    shown = pydoc.plain(pydoc.render_doc(twinform.ir.Link))
    assert shown.index("inertial: mass, center of mass and inertia") < shown.index("Method resolution order")
