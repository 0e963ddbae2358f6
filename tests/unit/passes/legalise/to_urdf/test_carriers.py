"""What is carried, and that nothing else is lost."""

import pytest
from lxml import etree

from twinform.diagnostics import DiagnosticSink, Fate
from twinform.ir import Opaque
from twinform.passes import Pipeline
from twinform.passes.carriers.carriers import NAMESPACE, is_carrier, unpack
from twinform.passes.legalise.to_urdf.sequence import to_urdf
from twinform.schemas import XmlElement

from .models import BOX, EVERYTHING, LINK, arm, convert, joint, link, lower, read, values_at, visual


@pytest.mark.parametrize(
    ("text", "path", "expected"),
    [
        (
            arm("revolute", "<axis><limit><dissipation>3</dissipation></limit></axis>"),
            "//joint/tf:sdf[@at='axis/limit' or not(@at)]//dissipation/text()",
            ["3"],
        ),
        (
            link(visual(BOX + "<transparency>0.5</transparency>") + visual(BOX, "w")),
            "//visual[@name='v']/tf:sdf/transparency/text()",
            ["0.5"],
        ),
        (
            LINK + link("<pose>1 2 3 0 0 0</pose>", "b") + joint("fixed", "<pose>0 0 -1 0 0 0</pose>"),
            "//link[@name='b']/tf:offset/@*",
            ["0 0 1"],
        ),
        (link("<pose>1 2 3 0 0 0</pose>"), "/robot/tf:offset/@* | //link/tf:*", ["-1 -2 -3"]),
        (LINK, "/robot/tf:from/@*", ["sdf", "1.11"]),
    ],
)
def test_a_part_of_sdf_is_expressed_in_urdf(text: str, path: str, expected: list[str]) -> None:
    assert values_at(convert(text), path) == expected


def test_without_carriers_nothing_of_ours_is_left_and_the_ledger_has_dropped() -> None:
    root, sink = lower(read(EVERYTHING), carriers=False)
    assert NAMESPACE not in etree.tostring(root).decode()
    assert {entry.fate for entry in sink.entries} <= {Fate.DROPPED, Fate.APPROXIMATED}
    _, carried = lower(read(EVERYTHING))
    assert [entry.message for entry in carried.entries] == [entry.message for entry in sink.entries]
    assert {entry.fate for entry in carried.entries} <= {Fate.CARRIED, Fate.APPROXIMATED}


def test_carriers_unpack_to_the_pieces_as_they_were() -> None:
    inside = BOX + "<transparency>0.5</transparency><foo:bar xmlns:foo='urn:f'/>"
    document, sink = read(link(visual(inside) + visual(BOX, "w"))), DiagnosticSink()
    made = Pipeline(to_urdf()).run(document, sink).models[0].links[0].visuals[0]
    pieces = [piece for part in made.opaque if is_carrier(part, "sdf") for piece in unpack(part)]
    assert [piece.name for piece in pieces] == ["<transparency>"]
    assert [part.name for part in made.opaque if isinstance(part, Opaque) and not is_carrier(part, "sdf")] == [
        "<{urn:f}bar>"
    ]


def test_a_model_that_needs_nothing_but_urdf_has_only_where_it_is_from() -> None:
    root = convert(
        link(
            "<inertial><mass>1</mass><inertia><ixx>1</ixx><ixy>0</ixy><ixz>0</ixz>"
            "<iyy>1</iyy><iyz>0</iyz><izz>1</izz></inertia></inertial>"
        )
        + link("<pose relative_to='j'/>" + visual(BOX), "b")
        + joint(
            "revolute",
            "<pose relative_to='a'>0 0 1 0 0 0</pose><axis><xyz>1 0 0</xyz><limit><lower>0</lower>"
            "<upper>1</upper><effort>1</effort><velocity>1</velocity></limit></axis>",
        )
    )
    assert values_at(root, "//tf:from/@*") == ["sdf", "1.11"]
    assert values_at(root, "//tf:pose/@*") == ["j", "a"]  # the frames of both poses, which are implied in URDF
    assert len(values_at(root, "//tf:*")) == 3


def values(root: XmlElement) -> set[str]:
    """Every word of every attribute and text."""
    texts = [text for each in root.iter() for text in (*map(str, each.attrib.values()), each.text or "")]
    return {word for text in texts for word in text.replace("::", " ").split()}


def test_no_value_vanishes() -> None:
    source = etree.fromstring(f"<sdf version='1.11'><model name='m'>{EVERYTHING}</model></sdf>")
    # without limits revolute is continuous, and URDF has radians
    assert values(source) - values(convert(EVERYTHING)) == {"revolute", "90"}
