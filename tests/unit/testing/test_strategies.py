"""What the strategies draw is valid, and what breaks shrinks to little."""

import subprocess
import sys
from collections.abc import Callable
from random import Random
from typing import Any, Literal

import pytest
from hypothesis import HealthCheck, Phase, find, given, settings
from hypothesis import strategies as st
from lxml import etree

from tests.edits.strategies import mutations, xml_documents
from tests.profile import DEEP
from twinform.ir import Document, Format, Inertial, Joint, Link, Model, Node, Pose
from twinform.schemas import libxml2_errors, parse_version, table
from twinform.testing import assert_valid, profiles, strategies

pytestmark = pytest.mark.slow

_FEW = settings(max_examples=15, deadline=None, suppress_health_check=[HealthCheck.too_slow])
_ONE = settings(_FEW, phases=(Phase.generate,))
_FIND = settings(max_examples=2000, deadline=None, database=None, phases=(Phase.generate, Phase.shrink))
LANGUAGES: tuple[Literal["urdf", "sdf"], ...] = ("urdf", "sdf")


@_FEW
@given(strategies.robots() | strategies.sdf_models(version="1.8") | strategies.worlds())
def test_documents_are_valid(document: Document) -> None:
    assert_valid(document)


@pytest.mark.parametrize("format", LANGUAGES)
@_FEW
@given(data=st.data())
def test_parts_make_a_valid_model(format: Literal["urdf", "sdf"], data: st.DataObject) -> None:
    one, other = (data.draw(strategies.links(format=format, name=name)) for name in ("one", "other"))
    joint = data.draw(strategies.joints(format=format, parent="one", child="other", types=("revolute",)))
    placed = other.copy(pose=Pose(relative_to="joint")) if format == "urdf" else other
    model = Model(name="m", links=(one, placed), joints=(joint,))
    assert_valid(Document(format=Format(format), version="1.11" if format == "sdf" else None, models=(model,)))


VERSIONS = [(format, version) for format in LANGUAGES for version in table(format).versions]


@pytest.mark.parametrize(("format", "version"), VERSIONS)
def test_an_xml_document_is_accepted_by_the_schema_of_its_version(format: Literal["urdf", "sdf"], version: str) -> None:
    @_FEW
    @given(xml_documents(format=format, version=version))
    def accepted(text: bytes) -> None:
        assert libxml2_errors(etree.fromstring(text), format, parse_version(version)) == []

    accepted()


@_FEW
@given(strategies.robots(), mutations(format="urdf"))
def test_a_mutation_makes_another_document(robot: Document, mutation: Callable[[Document], Document | None]) -> None:
    assert mutation(robot) != robot


@pytest.mark.parametrize("seed", range(20 if DEEP else 1))
def test_a_failure_shrinks_to_two_links(seed: int) -> None:
    """Segments that can be taken out one by one shrink in seconds; one of thirty seeds once stayed at three links."""
    found = find(
        strategies.robots(),
        lambda robot: any(joint.axis for joint in robot.models[0].joints),
        settings=_FIND,
        random=Random(seed),
    )
    assert (len(found.models[0].links), len(found.models[0].joints)) == (2, 1)
    assert not any(link.visuals or link.collisions or link.inertial for link in found.models[0].links)


IMPOSSIBLE: dict[str, Callable[[], Any]] = {
    "no links": lambda: strategies.robots(max_links=0),
    "more at least than at most": lambda: strategies.sdf_models(min_links=9, max_links=3),
    "a version without these frames": lambda: strategies.sdf_models(version="1.6"),
    "a shape that there is not": lambda: strategies.geometries(shapes=(Link,)),
    "a joint that URDF does not have": lambda: strategies.joints(types=("ball",)),
    "a joint that SDF does not have": lambda: strategies.joints(format="sdf", types=("floating",)),
    "a version that there is not": lambda: xml_documents(version="3.0"),
    "a format that there is not": lambda: strategies.links(format="usd"),
}


@pytest.mark.parametrize("name", IMPOSSIBLE)
def test_what_cannot_be_is_refused_at_once(name: str) -> None:
    with pytest.raises(ValueError, match=r"."):
        IMPOSSIBLE[name]()


@pytest.mark.parametrize("kind", [Document, Inertial, Joint, Link, Pose])
def test_types_have_strategies(kind: type[Node]) -> None:
    profiles.register_types()
    drawn: st.SearchStrategy[Node] = st.from_type(kind)
    assert isinstance(find(drawn, lambda _: True, settings=_ONE), kind)


def test_hypothesis_knows_the_profiles() -> None:
    for name, examples in profiles.PROFILES.items():
        assert settings.get_profile(f"twinform-{name}").max_examples == examples


@pytest.mark.parametrize("first", ["twinform.testing", "twinform.ir", "hypothesis"])
def test_the_kit_may_be_imported_in_any_order(first: str) -> None:
    """Hypothesis calls the kit when it is imported, also where the kit is what imports it."""
    program = (
        f"import {first}\nfrom twinform.testing import strategies\nfrom hypothesis import strategies as st\n"
        "from twinform.ir import Link\nassert st.from_type(Link).validate() is None"
    )
    subprocess.run([sys.executable, "-c", program], check=True)
