import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from twinform.diagnostics import DiagnosticSink, Source
from twinform.ir import Document, Format, Frame, Inertia, Inertial, Joint, Link, Model, World
from twinform.passes.inertia.check_inertia import CheckInertia

LINK_LINE = Source("robot", 3, None, "link")
INERTIAL_LINE = Source("robot", 4, LINK_LINE, "inertial")
GOOD = Inertial(mass=1.0, inertia=Inertia(ixx=0.1, iyy=0.1, izz=0.1, ixy=0.0, ixz=0.0, iyz=0.0))


def body(xx: float, yy: float, zz: float, xy: float = 0.0, xz: float = 0.0, yz: float = 0.0) -> Inertial:
    inertia = Inertia(ixx=xx, iyy=yy, izz=zz, ixy=xy, ixz=xz, iyz=yz)
    return Inertial(mass=1.0, inertia=inertia, source=INERTIAL_LINE)


def link(inertial: Inertial | None = None, name: str = "part") -> Link:
    return Link(name=name, inertial=inertial, source=LINK_LINE)


def fixed(parent: str, child: str) -> Joint:
    return Joint(name=f"{parent}_{child}", type="fixed", parent=parent, child=child)


def hinge(parent: str, child: str) -> Joint:
    return Joint(name=f"{parent}_{child}", type="revolute", parent=parent, child=child)


def urdf(*links: Link, joints: tuple[Joint, ...] = ()) -> Document:
    return Document(format=Format.URDF, models=(Model(name="robot", links=links, joints=joints),))


def sdf(*models: Model, worlds: tuple[World, ...] = ()) -> Document:
    return Document(format=Format.SDF, models=models, worlds=worlds)


def found(document: Document, eps: float = 1e-6) -> list[tuple[str, int]]:
    sink = DiagnosticSink()
    assert CheckInertia(eps=eps).run(document, sink) is document
    return [(each.rule.name, each.location.line) for each in sink.diagnostics]


CASES: dict[str, tuple[Inertial, list[str]]] = {
    "a cube": (GOOD, []),
    "a plate, with rounding": (body(0.333333, 0.333334, 0.666668), []),
    "a turned box": (body(0.2, 0.25, 0.3, 0.01, -0.02, 0.03), []),
    "no mass": (
        Inertial(mass=0.0, inertia=Inertia(ixx=0.0, iyy=0.0, izz=0.0), source=INERTIAL_LINE),
        ["non-positive-mass"],
    ),
    "a negative mass": (GOOD.copy(mass=-1.0, source=INERTIAL_LINE), ["non-positive-mass"]),
    "a mass that is not a number": (
        GOOD.copy(mass=float("nan"), source=INERTIAL_LINE),
        ["non-positive-mass"],
    ),
    "a point": (body(0.0, 0.0, 0.0), ["indefinite-inertia"]),
    "a rod without thickness": (body(1.0, 1.0, 0.0), ["indefinite-inertia"]),
    "a turned rod without thickness": (body(0.5, 0.5, 1.0, -0.5), ["indefinite-inertia"]),
    "a product that is too large": (body(0.01, 0.01, 0.01, 0.02), ["indefinite-inertia"]),
    "a negative moment": (body(-0.1, 0.1, 0.1), ["indefinite-inertia"]),
    "an infinite moment": (body(float("inf"), 0.1, 0.1), ["indefinite-inertia"]),
    "one large moment": (body(1.0, 0.1, 0.1), ["impossible-inertia"]),
    "one large moment about a turned axis": (body(0.55, 0.55, 0.1, 0.45), ["impossible-inertia"]),
    "moments that miss": (Inertial(mass=1.0, inertia=Inertia(ixx=0.1)), []),
    "a simulator that computes": (body(1.0, 0.1, 0.1).copy(auto=True), []),
}


@pytest.mark.parametrize("case", CASES)
def test_inertial_of_a_moving_link(case: str) -> None:
    inertial, rules = CASES[case]
    assert found(urdf(link(inertial))) == [(rule, 4) for rule in rules]


def test_sdf_completes_moments_with_its_defaults() -> None:
    inertial = Inertial(mass=1.0, inertia=Inertia(ixx=5.0), source=INERTIAL_LINE)
    assert found(sdf(Model(name="m", links=(link(inertial),)))) == [("impossible-inertia", 4)]


def test_tolerance_is_a_part_of_the_trace() -> None:
    document = urdf(link(body(2.2, 1.0, 1.0)))
    assert found(document, eps=0.04) == [("impossible-inertia", 4)]
    assert found(document, eps=0.05) == []


MOMENTS = st.floats(-1, 2)


@given(st.tuples(*[MOMENTS] * 6))
def test_verdict_is_that_of_numpy(elements: tuple[float, float, float, float, float, float]) -> None:
    xx, yy, zz, xy, xz, yz = elements
    least, middle, most = np.linalg.eigvalsh(np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])).tolist()
    excess = (most - least - middle) - 1e-6 * (xx + yy + zz)
    assume(min(abs(least), abs(excess)) > 1e-12)  # nearer than that, the two may round apart
    verdict = ["indefinite-inertia"] if least <= 0 else ["impossible-inertia"] if excess > 0 else []
    assert [rule for rule, _ in found(urdf(link(body(*elements))))] == verdict


MISSING = [("missing-inertial", 3)]
URDF_BODIES: dict[str, tuple[Document, list[tuple[str, int]]]] = {
    "a root without mass": (urdf(link()), MISSING),
    "a root that is the world": (urdf(link(name="world")), []),
    "a link fixed to the world": (urdf(link(name="world"), link(name="a"), joints=(fixed("world", "a"),)), []),
    "a link hinged to the world": (urdf(link(name="world"), link(name="a"), joints=(hinge("world", "a"),)), MISSING),
    "a frame fixed to a body": (urdf(link(GOOD, "a"), link(name="b"), joints=(fixed("a", "b"),)), []),
    "a body fixed to a frame": (urdf(link(name="a"), link(GOOD, "b"), joints=(fixed("a", "b"),)), []),
    "a chain without mass": (
        urdf(link(GOOD, "a"), link(name="b"), link(name="c"), joints=(hinge("a", "b"), fixed("b", "c"))),
        MISSING,
    ),
    "a bad inertia that cannot move": (
        urdf(link(name="world"), link(body(0, 0, 0), "a"), joints=(fixed("world", "a"),)),
        [],
    ),
}


@pytest.mark.parametrize("case", URDF_BODIES)
def test_missing_inertial_of_a_body_of_urdf(case: str) -> None:
    document, expected = URDF_BODIES[case]
    assert found(document) == expected


ARM = Model(name="arm", links=(link(name="a"), link(GOOD, "b")), joints=(hinge("a", "b"),))
SDF_BODIES: dict[str, tuple[Document, int]] = {
    "a free link": (sdf(Model(name="m", links=(link(),))), 1),
    "links that are fixed to each other": (
        sdf(Model(name="m", links=(link(name="a"), link(name="b")), joints=(fixed("a", "b"),))),
        2,
    ),
    "a static model": (sdf(Model(name="m", static=True, links=(link(),))), 0),
    "a model in a static one": (sdf(Model(name="m", static=True, models=(ARM,))), 0),
    "a link fixed to the world": (sdf(Model(name="m", links=(link(),), joints=(fixed("world", "part"),))), 0),
    "a link fixed to the world through a frame": (
        sdf(
            Model(
                name="m",
                links=(link(),),
                frames=(Frame(name="f", attached_to="part"),),
                joints=(fixed("world", "f"),),
            )
        ),
        0,
    ),
    "a link fixed to the world as the model": (
        sdf(Model(name="m", links=(link(),), joints=(fixed("world", "__model__"),))),
        0,
    ),
    "a nested model fixed to the world": (
        sdf(Model(name="m", models=(ARM,), joints=(fixed("world", "arm::a"),))),
        0,
    ),
    "a nested model fixed by its name": (sdf(Model(name="m", models=(ARM,), joints=(fixed("world", "arm"),))), 0),
    "a model fixed by a joint of its world": (
        sdf(worlds=(World(name="w", models=(ARM,), joints=(fixed("world", "arm::a"),)),)),
        0,
    ),
    "a model of a world": (sdf(worlds=(World(name="w", models=(ARM,)),)), 1),
    "names that two models share": (
        sdf(worlds=(World(name="w", models=(ARM.copy(name="other", static=True), ARM)),)),
        1,
    ),
}


@pytest.mark.parametrize("case", SDF_BODIES)
def test_missing_inertial_of_a_link_of_sdf(case: str) -> None:
    document, count = SDF_BODIES[case]
    assert found(document) == MISSING * count


def test_a_long_chain_needs_no_deep_stack() -> None:
    links = tuple(link(GOOD, f"l{number}") for number in range(5000))
    joints = tuple(fixed(f"l{number + 1}", f"l{number}") for number in range(4999))
    assert found(urdf(*links, joints=joints)) == []
