"""URIs of ROS become those of Gazebo, and no others."""

import pytest

from twinform.diagnostics import DiagnosticSink
from twinform.ir import Box, Collision, Geometry, Link, Material, Mesh, Model, Node, Visual, map_children
from twinform.passes.carriers.annotations import find_annotation, with_annotation, without_annotation
from twinform.passes.legalise.to_sdf.mesh_uris import MeshUris
from twinform.passes.shared.document_uris import MESH_SCHEME, TEXTURE_SCHEME

OTHERS = ["file:///p/a.dae", "model://p/a.dae", "meshes/a.dae", "https://example.org/a.dae", "PACKAGE://p/a.dae", ""]


def link(mesh: str, texture: str, collision: str) -> Link:
    shape, other = Geometry(shape=Mesh(uri=mesh)), Geometry(shape=Mesh(uri=collision))
    visual = Visual(name="v", geometry=shape, material=Material(albedo_map=texture))
    return Link(name="a", visuals=(visual, Visual(name="w")), collisions=(Collision(name="c", geometry=other),))


def bare(node: Node) -> Node:
    """The node without annotations, which have a test of their own."""
    return map_children(without_annotation(node, MESH_SCHEME, TEXTURE_SCHEME), bare)


def rewritten(one: Link) -> Link:
    sink = DiagnosticSink()
    (made,) = MeshUris().run_model(Model(name="m", links=(one,)), sink).links
    assert sink.diagnostics == []
    return made


@pytest.mark.parametrize("other", OTHERS)
@pytest.mark.parametrize("place", range(3))
def test_each_uri_is_rewritten_by_itself(place: int, other: str) -> None:
    uris, expected = [other] * 3, [other] * 3
    uris[place], expected[place] = "package://p/meshes/a b.dae", "model://p/meshes/a b.dae"
    assert bare(rewritten(link(*uris))) == link(*expected)


@pytest.mark.parametrize(
    ("written", "annotation", "became", "left"),
    [
        ("model://a", None, "model://a", "model"),  # which would come back as package://
        ("package://a", None, "model://a", None),
        ("package://a", "package", "package://a", None),  # as it was in SDF
        ("model://a", "package", "model://a", None),  # edited since
        ("package://a", "nonsense", "model://a", None),
        ("a.dae", "package", "a.dae", None),
    ],
)
def test_an_annotation_has_the_scheme_that_the_conversion_back_would_not_find(
    written: str, annotation: str | None, became: str, left: str | None
) -> None:
    (visual,) = (Visual(name="v", geometry=Geometry(shape=Mesh(uri=written))),)
    annotated = (
        visual if annotation is None else with_annotation(visual, MESH_SCHEME, attributes={"scheme": annotation})
    )
    (made,) = rewritten(Link(name="a", visuals=(annotated,))).visuals
    assert made.geometry
    assert made.geometry.shape == Mesh(uri=became)
    found = find_annotation(made, MESH_SCHEME)
    assert (found and found.get("scheme")) == left


def test_a_link_without_uris_of_ros_is_the_same_object() -> None:
    plain = Link(name="a", visuals=(Visual(geometry=Geometry(shape=Box(size=(1, 1, 1))), material=Material()),))
    for one in (plain, link("a.dae", "b.png", "c.dae")):
        assert rewritten(one) is one
