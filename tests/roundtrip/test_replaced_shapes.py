"""Shapes that the target lacks come home from what stands for them, from URDF and from every older SDF."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

import twinform
from tests.profile import examples
from tests.roundtrip.test_generated import text_of
from twinform.diagnostics import rules
from twinform.ir import Capsule, Cone, Document, Ellipsoid, Format, Geometry, Link, Mesh, Model, Polyline, Sphere, walk
from twinform.testing import assert_round_trip, strategies

SHAPES = (Capsule, Cone, Ellipsoid, Polyline)


def models() -> st.SearchStrategy[Document]:
    return strategies.sdf_models(max_links=3, shapes=SHAPES)


@examples()
@given(models())
def test_a_model_comes_back_from_urdf(model: Document) -> None:
    assert_round_trip(model, via="urdf")


@examples(0.5)
@given(models())
def test_others_see_a_shape_for_each(model: Document) -> None:
    made = twinform.convert(text_of(model).encode(), to="urdf", carriers=False)
    plain = twinform.loads(made.text)
    parts = [part for link in model.models[0].links for part in (*link.visuals, *link.collisions)]
    kinds = [part.geometry.shape for part in parts if part.geometry]
    capsules = sum(isinstance(kind, Capsule) for kind in kinds)
    shapes = [node for node in walk(plain) if isinstance(node, Mesh | Sphere)]
    assert len(shapes) == 2 * capsules + len(kinds) - capsules
    assert {node.uri for node in shapes if isinstance(node, Mesh)} == {each.path for each in made.side_files}
    assert "tf:" not in made.text


@pytest.mark.parametrize("version", ["1.8", "1.9", "1.10"])
def test_a_model_comes_back_from_an_older_sdf(version: str) -> None:
    @examples(0.4)
    @given(models())
    def comes_back(model: Document) -> None:
        older = twinform.convert(text_of(model).encode(), to="sdf", sdf_version=version)
        back = twinform.convert(older.text.encode(), to="sdf", sdf_version="1.11")
        assert not any(each.rule is rules.STALE_CARRIER for each in back.diagnostics)
        assert geometries(back.document) == geometries(model)

    comes_back()


@pytest.mark.parametrize("version", ["1.5", "1.7"])
def test_a_link_comes_back_from_an_sdf_without_capsules(version: str) -> None:
    @examples(0.4)
    @given(strategies.links(format=Format.SDF).flatmap(with_shapes))
    def comes_back(link: Link) -> None:
        model = Document(format=Format.SDF, version="1.11", models=(Model(name="m", links=(link,)),))
        older = twinform.convert(text_of(model).encode(), to="sdf", sdf_version=version)
        back = twinform.convert(older.text.encode(), to="sdf", sdf_version="1.11")
        assert not any(isinstance(node, Capsule | Cone | Ellipsoid) for node in walk(older.document))
        assert geometries(back.document) == geometries(model)

    comes_back()


def with_shapes(link: Link) -> st.SearchStrategy[Link]:
    """The link with shapes of these kinds in its visuals and collisions."""
    parts = [*link.visuals, *link.collisions]
    drawn = st.lists(strategies.geometries(shapes=SHAPES), min_size=len(parts), max_size=len(parts))

    def put(shapes: list[Geometry]) -> Link:
        made = [part.copy(geometry=shape) for part, shape in zip(parts, shapes, strict=True)]
        return link.copy(visuals=tuple(made[: len(link.visuals)]), collisions=tuple(made[len(link.visuals) :]))

    return drawn.map(put)


def geometries(document: Document) -> list[object]:
    parts = [part for link in document.models[0].links for part in (*link.visuals, *link.collisions)]
    return [(part.name, part.geometry) for part in parts]
