"""What is looked for only under `--for`: meshes in COLLADA, wherever a model has them."""

import pytest

import twinform

_URDF = '<robot name="r"><link name="a"><visual><geometry><mesh filename="{uri}"/></geometry></visual></link></robot>'


@pytest.mark.parametrize(
    ("uri", "found"),
    [
        ("package://arm/base.dae", True),
        ("package://arm/BASE.DAE", True),
        ("file:///arm/a b.dae", True),
        ("base.dae.stl", False),
        ("dae", False),
        (".stl", False),
    ],
)
def test_meshes_in_collada_are_found_by_their_ending(uri: str, found: bool) -> None:
    told = [
        each
        for each in twinform.check(_URDF.format(uri=uri).encode(), profiles="mujoco").diagnostics
        if each.rule.name == "collada-mesh"
    ]
    assert [(each.found, each.is_error) for each in told] == ([(uri, True)] if found else [])


def test_nobody_is_told_who_reads_it() -> None:
    model = _URDF.format(uri="base.dae").encode()
    for found in (twinform.check(model, profiles="pinocchio"), twinform.check(model)):
        assert "collada-mesh" not in {each.rule.name for each in found.diagnostics}
