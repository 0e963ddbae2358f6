"""Tiny numbers are found wherever one stands, and a model without any stays as it is."""

import pytest

import twinform
from twinform.diagnostics import DiagnosticSink, rules
from twinform.ir import Format
from twinform.passes.legalise.round_tiny_numbers import RoundTinyNumbers

_LINK = "<link name='l'><inertial><mass>{}</mass></inertial>{}</link>"
_VISUAL = "<visual name='v'><geometry><box><size>1 1 {}</size></box></geometry>{}</visual>"
_COLOR = "<material><diffuse>{} 0 0 1</diffuse></material>"
_MANY = (
    _LINK.format("1e-310", ""),
    _LINK.format("1", _VISUAL.format("4.9e-324", "")),
    _LINK.format("1", _VISUAL.format("1", _COLOR.format("1e-39"))),
    _LINK.format("1", _VISUAL.format("1", _COLOR.format(f"0.{'0' * 29}1e-9"))),
    "<frame name='f'><pose>0 -1e-320 0 0 0 0</pose></frame>" + _LINK.format("1", ""),
    _LINK.format("1", "<sensor name='s' type='altimeter'><update_rate>1e-310</update_rate></sensor>"),
    _LINK.format("1", "<audio_source><pitch>1E-0310</pitch></audio_source>"),
    f"<model name='n'>{_LINK.format('1e-310', '')}</model>",
)
_NONE = (
    _LINK.format("1e-307", _VISUAL.format("0", _COLOR.format("1e-37"))),
    _LINK.format("0.001", "<audio_source><pitch>1e-05</pitch></audio_source>"),
)


def _rounded(inside: str) -> tuple[bool, list[str]]:
    (model,) = twinform.loads(f"<sdf version='1.11'><model name='m'>{inside}</model></sdf>").models
    sink = DiagnosticSink()
    changed = RoundTinyNumbers.unchecked(to=Format.SDF).run_model(model, sink)
    return changed is not model, [each.rule.name for each in sink.entries]


@pytest.mark.parametrize("inside", _MANY)
def test_one_is_found_wherever_it_stands(inside: str) -> None:
    assert _rounded(inside) == (True, [rules.TINY_NUMBER.name])


@pytest.mark.parametrize("inside", _NONE)
def test_a_model_without_any_stays(inside: str) -> None:
    assert _rounded(inside) == (False, [])
