"""The audit finds what became of each part, with carriers and without."""

import pytest

import twinform
from twinform.compiler import Language
from twinform.compiler.audit import audit

_ROBOT = b'<robot name="r"><link name="a"><visual>paint<geometry><box size="1 1 1"/></geometry></visual></link></robot>'
_MODEL = b'<sdf version="1.9"><model name="m"><link name="a"><inertial name="heavy"/></link></model></sdf>'


@pytest.mark.parametrize("carriers", [True, False])
@pytest.mark.parametrize(("source", "to", "count"), [(_ROBOT, "sdf", 1), (_MODEL, "urdf", 2)])  # 2: and the version
def test_text_and_attributes_of_no_format_are_carried_or_dropped(
    source: bytes, to: Language, count: int, carriers: bool
) -> None:
    made = twinform.convert(source, to=to, carriers=carriers)
    assert made.source is not None
    found = audit(made.source, made.text, made.ledger)
    assert (found.carried, found.dropped, found.unaccounted) == ((count, 0, ()) if carriers else (0, count, ()))
