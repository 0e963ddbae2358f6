"""What URDF can write of a node: the short look, which is enough for most, agrees with the whole comparison."""

import math

import pytest
from hypothesis import given

from twinform.ir import Collision, Document, Element, Inertial, Joint, Link, Node, Opaque, Pose, Visual, walk
from twinform.passes.legalise.to_urdf import remainder
from twinform.passes.legalise.to_urdf.remainder import KnownFields, urdf_fields, urdf_row
from twinform.request_options import UrdfVersion
from twinform.schemas import Table
from twinform.schemas.facts import parse_facts
from twinform.testing import strategies

WORDS: dict[type[Node], KnownFields] = {
    Link: urdf_fields("1.2", "link"),
    Joint: urdf_fields("1.2", "joint"),
    Inertial: urdf_fields("1.2", "link", "inertial"),
    Visual: urdf_fields("1.2", "link", "visual"),
    Collision: urdf_fields("1.2", "link", "collision"),
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


_NEWER = """
link
  @self_collide  ?  bool  until=1.0   -> self_collide
  kinematic      ?        since=1.2   -> .
    @value       1  bool              -> kinematic
"""


@pytest.mark.parametrize(("version", "carried"), [("1.0", ["kinematic"]), ("1.1", ["self_collide", "kinematic"])])
def test_what_the_version_lacks_is_carried(
    monkeypatch: pytest.MonkeyPatch, version: UrdfVersion, carried: list[str]
) -> None:
    (definition,) = parse_facts(_NEWER.splitlines(), "link.facts")
    newer = Table("urdf", ("1.0", "1.1", "1.2"), "link", {"link": definition})
    monkeypatch.setattr(remainder, "table", {"urdf": newer}.get)
    link = Link(name="l", self_collide=True, kinematic=True)
    kept, pieces, _ = remainder.take_remainder(link, "link", urdf_fields.__wrapped__(version, "link"))
    assert [piece.element.name for piece in pieces if piece.element] == carried
    assert (kept.self_collide, kept.kinematic) == (True if version == "1.0" else None, None)


def test_the_versions_of_shapes_and_limits_are_those_of_the_table() -> None:
    shapes = {version: sorted(urdf_fields(version, "geometry")["shape"] or {}) for version in ("1.0", "1.1", "1.2")}
    assert shapes["1.1"] == shapes["1.2"] == sorted([*shapes["1.0"], "capsule"])
    assert [urdf_row(version, "joint", "limit", "@effort").required for version in ("1.1", "1.2")] == [True, False]
