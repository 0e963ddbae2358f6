"""Every installed pass keeps its contract on models that Hypothesis makes up, whatever format they are in."""

import pytest
from hypothesis import given
from pydantic import ValidationError

from tests.profile import examples
from twinform.ir import Document
from twinform.passes import Pass, registered_passes
from twinform.testing import assert_pass_contract, strategies

_KINDS = {name: entry.load() for name, entry in registered_passes().items()}


def _without_options(kind: type[Pass]) -> Pass | None:
    try:
        return kind()
    except ValidationError:  # it has options that have to be given
        return None


_STEPS = {name: step for name, kind in _KINDS.items() if (step := _without_options(kind)) is not None}
"""Passes that can be run without options."""


@pytest.mark.parametrize("name", sorted(_STEPS))
def test_a_pass_keeps_its_contract(name: str) -> None:
    step = _STEPS[name]

    @examples(0.5)
    @given(strategies.robots() | strategies.sdf_models() | strategies.worlds(max_models=2))
    def keeps(model: Document) -> None:
        assert_pass_contract(step, model)

    keeps()
