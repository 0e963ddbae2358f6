"""URIs of ROS become those of Gazebo, and no others."""

import pytest

from twinform.diagnostics import Notes
from twinform.ir import Box, Collision, Geometry, Link, Material, Mesh, Model, Visual
from twinform.passes.legalise.to_sdf.mesh_uris import MeshUris

OTHERS = ["file:///p/a.dae", "model://p/a.dae", "meshes/a.dae", "https://example.org/a.dae", "PACKAGE://p/a.dae", ""]


def link(mesh: str, texture: str, collision: str) -> Link:
    shape, other = Geometry(shape=Mesh(uri=mesh)), Geometry(shape=Mesh(uri=collision))
    visual = Visual(name="v", geometry=shape, material=Material(albedo_map=texture))
    return Link(name="a", visuals=(visual, Visual(name="w")), collisions=(Collision(name="c", geometry=other),))


def rewritten(one: Link) -> Link:
    notes = Notes()
    (made,) = MeshUris().run_model(Model(name="m", links=(one,)), notes).links
    assert notes.diagnostics == []
    return made


@pytest.mark.parametrize("other", OTHERS)
@pytest.mark.parametrize("place", range(3))
def test_each_uri_is_rewritten_by_itself(place: int, other: str) -> None:
    uris, expected = [other] * 3, [other] * 3
    uris[place], expected[place] = "package://p/meshes/a b.dae", "model://p/meshes/a b.dae"
    assert rewritten(link(*uris)) == link(*expected)


def test_a_link_without_uris_of_ros_is_the_same_object() -> None:
    bare = Link(name="a", visuals=(Visual(geometry=Geometry(shape=Box(size=(1, 1, 1))), material=Material()),))
    for one in (bare, link("a.dae", "b.png", "c.dae")):
        assert rewritten(one) is one
