"""What engines say of inertias that passes have computed, fixed and divided."""

import importlib
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import twinform
from tests.oracles.inertia_complaints import complaints
from twinform.testing import oracles
from twinform.testing.oracles import drake

CASES = Path(__file__).parents[1] / "cases/passes/inertia"
FIXED = "split-massless,balance-inertia"
HINGE = '<joint name="{0}" type="continuous"><parent link="base"/><child link="{0}"/><axis xyz="0 0 1"/></joint>'
LINK = '<link name="{}"><inertial><mass value="1"/><inertia {}/></inertial></link>'
BASE = LINK.format("base", 'ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"')
IMPOSSIBLE = {
    "a long moment": LINK.format("a", 'ixx="1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"'),
    "a product too large": LINK.format("a", 'ixx="1" ixy="2" ixz="0" iyy="1" iyz="0" izz="1"'),
    "nothing": LINK.format("a", 'ixx="0" ixy="0" ixz="0" iyy="0" iyz="0" izz="0"'),
    "no inertial": '<link name="a"/>',
}


def need(engine: str) -> None:
    if not oracles.available(engine):
        pytest.skip(f"{engine} is not installed")


@pytest.mark.parametrize("engine", ["mujoco", "drake"])
def test_engines_take_what_they_refused(engine: str) -> None:
    need(engine)
    texts = [f'<robot name="r">{BASE}{link}{HINGE.format("a")}</robot>'.encode() for link in IMPOSSIBLE.values()]
    fixed = [twinform.convert(text, to="urdf", passes=FIXED).text.encode() for text in texts]
    before, after = complaints(engine, texts), complaints(engine, fixed)
    assert sum(map(bool, before)) >= 2
    assert not any(after)


def spatial_inertia(path: Path) -> Any:
    """The inertia of the whole robot with its joints at zero, about the origin of its root, to Drake."""
    tree: Any = importlib.import_module("pydrake.multibody.tree")
    plant, bodies, *_ = drake.parts(path)
    indices = [tree.BodyIndex(body.index()) for body in bodies.values()]
    found = plant.CalcSpatialInertia(plant.CreateDefaultContext(), plant.GetFrameByName("base"), indices)
    return found.CopyToFullMatrix6()


def test_dividing_a_mass_leaves_the_whole_as_it_is(tmp_path: Path) -> None:
    need("drake")
    source, made = tmp_path / "source.urdf", tmp_path / "made.urdf"
    text = (CASES / "split_massless.urdf").read_text()
    made.write_text(twinform.convert(text.encode(), to="urdf", passes="split-massless{mass=1e-12 share=0.3}").text)
    source.write_text(text)
    assert np.allclose(spatial_inertia(source), spatial_inertia(made), rtol=0, atol=1e-10)
