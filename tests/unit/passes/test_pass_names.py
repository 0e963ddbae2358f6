"""Names and docstrings of passes, of those for pipelines and those that targets ask for."""

import pkgutil
import re
import sys
from collections import defaultdict
from collections.abc import Iterator
from importlib import import_module
from inspect import isabstract

import pytest

import twinform.passes
from twinform.compiler.reproducers import Reproducer
from twinform.ir import Document, Format, Model
from twinform.passes import FailedPassError, Pass, registered_passes
from twinform.passes.framework.pass_page import description
from twinform.passes.legalise import legalisation_kinds
from twinform.passes.legalise.nested_models import FlattenForUrdf
from twinform.passes.structure.flatten_models import FlattenModels


def passes(kind: type[Pass] = Pass) -> Iterator[type[Pass]]:
    """The passes that stand in this package; not the narrower ones that some make of themselves."""
    for each in kind.__subclasses__():
        here = each.__module__.startswith("twinform.passes.")
        stands = here and getattr(sys.modules[each.__module__], each.__name__, None) is each
        if stands and not isabstract(each) and hasattr(each, "name"):
            yield each
        yield from passes(each)


def test_no_two_passes_have_one_name() -> None:
    for module in pkgutil.walk_packages(twinform.passes.__path__, "twinform.passes."):
        if not module.name.endswith("__main__"):
            import_module(module.name)
    kinds = defaultdict[str, set[type[Pass]]](set)
    for kind in passes():
        kinds[kind.name].add(kind)
    assert {name: found for name, found in kinds.items() if len(found) > 1} == {}
    own = {name for name, each in registered_passes().items() if each.owner == "twinform"}
    assert own.isdisjoint(legalisation_kinds())
    assert own | set(legalisation_kinds()) <= set(kinds)


def test_docstrings_have_one_form() -> None:
    own = {name: each.load() for name, each in registered_passes().items() if each.owner == "twinform"}
    for name, kind in {**own, **legalisation_kinds()}.items():
        lines = description(kind).splitlines()
        assert not re.fullmatch(r"\w*[^s]s", lines[0].split()[0]), f"{name}: not imperative"
        assert any(line.startswith("Changes") for line in lines), name
        assert name not in own or any(line.startswith("Diagnostics") for line in lines), name


@pytest.mark.parametrize("step", [FlattenModels(), FlattenForUrdf()], ids=lambda step: step.name)
def test_a_fault_comes_again_from_the_pass_that_made_it(step: Pass, monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(*_: object) -> Document:
        raise ZeroDivisionError

    monkeypatch.setattr(type(step), "run", fail)
    document = Document(format=Format.SDF, models=(Model(name="m"),))
    again = Reproducer.of(FailedPassError(step, document, ZeroDivisionError()), "m.sdf", "0").run()
    assert again is not None
    assert type(again.step) is type(step)
