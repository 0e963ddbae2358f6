"""What URDF can write of a node: the short look, which is enough for most, agrees with the whole comparison."""

import math

import pytest
from hypothesis import given

from twinform.ir import Collision, Document, Element, Inertial, Joint, Link, Node, Opaque, Pose, Visual, walk
from twinform.passes.legalise.to_urdf import remainder
from twinform.passes.legalise.to_urdf.remainder import KnownFields, urdf_fields
from twinform.testing import strategies

WORDS: dict[type[Node], KnownFields] = {
    Link: urdf_fields("link"),
    Joint: urdf_fields("joint"),
    Inertial: urdf_fields("link", "inertial"),
    Visual: urdf_fields("link", "visual"),
    Collision: urdf_fields("link", "collision"),
}


def _both(node: Node) -> tuple[bool, bool]:
    known = WORDS[type(node)]
    split = remainder._split(node, known, "", own_element=True)  # pyright: ignore[reportPrivateUsage] - the judge
    fits = remainder._fits(node, known)  # pyright: ignore[reportPrivateUsage] - what is judged
    return fits, not split.left and not split.endless


@given(strategies.sdf_models())
def test_the_short_look_agrees_with_the_comparison_for_models_of_sdf(document: Document) -> None:
    _agree(document)


@given(strategies.robots())
def test_the_short_look_agrees_with_the_comparison_for_robots(document: Document) -> None:
    _agree(document)


def _agree(document: Document) -> None:
    for node in walk(document):
        if type(node) in WORDS and not node.opaque:  # whoever asks looks at the opaque parts of the node itself
            fits, nothing_left = _both(node)
            assert fits == nothing_left


@pytest.mark.parametrize(
    ("node", "fits"),
    [
        (Inertial(mass=1.0), True),
        (Inertial(mass=math.inf), False),
        (Visual(name="v", pose=Pose(xyz=(0.0, math.nan, 0.0))), False),
        (Visual(name="v", pose=Pose(relative_to="f")), False),
        (Visual(name="v", pose=Pose(opaque=(Opaque(element=Element(name="{urn:x}y")),))), False),
    ],
)
def test_what_has_no_syntax_or_no_end_does_not_fit(node: Node, fits: bool) -> None:
    assert _both(node) == (fits, fits)
