"""Every installed pass keeps its contract on models that Hypothesis makes up, whatever format they are in."""

import pytest
from hypothesis import given

from tests.profile import examples
from twinform.ir import Document
from twinform.passes import registered_passes
from twinform.testing import assert_pass_contract, strategies

_NEEDS = {name: entry.load() for name, entry in registered_passes().items()}
_WITH_DEFAULTS = sorted(
    name for name, kind in _NEEDS.items() if not any(field.is_required() for field in kind.model_fields.values())
)
"""Passes that can be run without being told anything."""


@pytest.mark.parametrize("name", _WITH_DEFAULTS)
def test_a_pass_keeps_its_contract(name: str) -> None:
    step = _NEEDS[name]()

    @examples(0.5)
    @given(strategies.robots() | strategies.sdf_models() | strategies.worlds(max_models=2))
    def keeps(model: Document) -> None:
        assert_pass_contract(step, model)

    keeps()
