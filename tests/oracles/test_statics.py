"""Pinocchio agrees about what gravity needs of the joints of an arm: no more than in some position, and hardly less."""

import importlib
import itertools
from random import Random
from typing import Any

import numpy as np
import pytest

from twinform.compiler import LoadOptions, read
from twinform.compiler.mistakes.statics_checks import report_statics
from twinform.diagnostics import DiagnosticSink
from twinform.testing import oracles

_LENGTHS = 3
_STEPS = 13


def _arm(chance: Random) -> str:
    """An arm of three joints with limits, whose efforts are all too small."""
    parts = ['<link name="l0"/>']
    for number in range(1, _LENGTHS + 1):
        axis = chance.choice(["1 0 0", "0 1 0", "0 0 1", "0 0.6 0.8"])
        center, place = (" ".join(f"{chance.uniform(-0.3, 0.5):.3f}" for _ in "xyz") for _ in "12")
        inertia = '<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/>'
        mass = f'<mass value="{chance.uniform(0.5, 3):.3f}"/>'
        lower, upper = chance.choice([(-1.2, 0.7), (-3.0, 3.0), (0.0, 2.0)])
        parts.append(f'<link name="l{number}"><inertial><origin xyz="{center}"/>{mass}{inertia}</inertial></link>')
        limit = f'<limit lower="{lower}" upper="{upper}" effort="0.001" velocity="1"/>'
        parts.append(
            f'<joint name="j{number}" type="revolute"><parent link="l{number - 1}"/><child link="l{number}"/>'
            f'<origin xyz="{place}" rpy="0.3 {chance.uniform(-1, 1):.3f} 0"/><axis xyz="{axis}"/>{limit}</joint>'
        )
    return f'<robot name="arm">{"".join(parts)}</robot>'


def _found(text: str) -> dict[str, float]:
    """What the check says that gravity needs, by joint."""
    document, sink = read(text.encode(), LoadOptions()).document, DiagnosticSink()
    assert document is not None
    report_statics(document, sink)
    found = [each for each in sink.diagnostics if each.rule.name == "weak-joint"]
    return {each.message.split("'")[1]: float((each.expected or "").removeprefix("at least ")) for each in found}


@pytest.mark.parametrize("seed", range(8))
def test_gravity_needs_what_pinocchio_computes(seed: int) -> None:
    if not oracles.available("pinocchio"):
        pytest.skip("pinocchio is not installed")
    pinocchio: Any = importlib.import_module("pinocchio")
    text = _arm(Random(seed))
    model = pinocchio.buildModelFromXML(text)
    data = model.createData()
    for name, needed in _found(text).items():
        number = int(name[1:]) - 1
        grids = [
            [0.0] if n < number else [low + (high - low) * step / (_STEPS - 1) for step in range(_STEPS)]
            for n, (low, high) in enumerate(zip(model.lowerPositionLimit, model.upperPositionLimit, strict=True))
        ]
        torques = [
            abs(pinocchio.computeGeneralizedGravity(model, data, np.array(position))[number]) * 9.8 / 9.81
            for position in itertools.product(*grids)
        ]
        most = max(torques)
        assert needed <= most * 1.03
        assert needed >= most * 0.8
