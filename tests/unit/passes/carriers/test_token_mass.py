"""Links without mass get a token of it in SDF, and lose it in the conversion back."""

import pytest

import twinform
from twinform.ir import Link
from twinform.passes.carriers.token_mass import TOKEN, TOKEN_MASS, TOKEN_MOMENT

ZERO = 'ixx="0" ixy="0" ixz="0" iyy="0" iyz="0" izz="0"'
ONE = 'ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"'
INERTIALS = {
    "nothing": "",
    "an empty one": "<inertial/>",
    "mass of zero": f'<inertial><mass value="0"/><inertia {ONE}/></inertial>',
    "all zero": f'<inertial><origin xyz="1 0 0" rpy="0 0 0"/><mass value="0"/><inertia {ZERO}/></inertial>',
    "no inertia": '<inertial><mass value="2"/></inertial>',
    "inertia of zero": f'<inertial><mass value="2"/><inertia {ZERO}/></inertial>',
}


def _robot(inertial: str) -> bytes:
    joint = '<joint name="j" type="continuous"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/></joint>'
    base = f'<link name="a"><inertial><mass value="1"/><inertia {ONE}/></inertial></link>'
    return f'<robot name="r">{base}<link name="b">{inertial}</link>{joint}</robot>'.encode()


def _link(document: twinform.Document) -> Link:
    return next(link for link in document.models[0].links if link.name == "b")


@pytest.mark.parametrize("inertial", INERTIALS.values(), ids=INERTIALS)
def test_every_link_that_moves_has_mass_and_inertia(inertial: str) -> None:
    made = twinform.convert(_robot(inertial), to="sdf")
    found = _link(made.document).inertial
    assert found is not None
    assert found.inertia is not None
    assert (found.mass or 0) >= TOKEN_MASS
    assert (found.inertia.ixx or 0) >= TOKEN_MOMENT
    assert "tiny-mass" in {entry.rule.name for entry in made.ledger.entries if entry.fate == "approximated"}


@pytest.mark.parametrize("inertial", INERTIALS.values(), ids=INERTIALS)
def test_the_token_is_gone_after_the_round_trip(inertial: str) -> None:
    sdf = twinform.convert(_robot(inertial), to="sdf").text.encode()
    back = twinform.convert(sdf, to="urdf").document
    source = twinform.loads(_robot(inertial))
    assert _link(back).inertial == _link(source).inertial


def test_a_token_that_was_edited_counts() -> None:
    sdf = twinform.convert(_robot(""), to="sdf").text.replace(f"<mass>{TOKEN_MASS:g}</mass>", "<mass>3</mass>")
    found = _link(twinform.convert(sdf.encode(), to="urdf").document).inertial
    assert found is not None
    assert found.mass == 3
    assert found.inertia == TOKEN.inertia


def test_a_static_model_needs_none() -> None:
    static = _robot("").replace(b"</robot>", b"<gazebo><static>true</static></gazebo></robot>")
    found = _link(twinform.convert(static, to="sdf").document).inertial
    assert found is not None
    assert found.mass == 0
