"""Each finding about limits, with all that is in it."""

import pytest

from twinform.diagnostics import DiagnosticSink, Source
from twinform.ir import Axis, Document, Dynamics, Element, Format, Joint, JointType, Limit, Model, Opaque
from twinform.passes.joints.check_limits import CheckLimits

Found = tuple[str, int, str, str | None, str | None]
"""Rule, line, message, what was found, what was expected."""
JOINT, LIMIT, DYNAMICS = 3, 5, 7
"""The lines that these stand on."""


def at(line: int) -> Source:
    return Source("r.urdf", line, None, "x")


def found(joint: Joint, format_: Format = Format.URDF, options: CheckLimits | None = None) -> list[Found]:
    sink = DiagnosticSink()
    document = Document(format=format_, models=(Model(name="r", joints=(joint,)),))
    assert (options or CheckLimits()).run(document, sink) is document
    return [(each.rule.name, each.location.line, each.message, each.found, each.expected) for each in sink.diagnostics]


def joint(
    lower: float | None,
    upper: float | None,
    *,
    kind: JointType = "revolute",
    effort: float | None = 1,
    velocity: float | None = 1,
    line: int | None = LIMIT,
) -> Joint:
    limit = Limit(lower=lower, upper=upper, effort=effort, velocity=velocity, source=at(line) if line else None)
    return Joint(name="j", type=kind, axis=Axis(limit=limit), source=at(JOINT))


def empty(where: float, line: int = LIMIT) -> Found:
    return (
        "empty-range",
        line,
        f"joint 'j' cannot move: both of its limits are {where:g}",
        f"{where:g} to {where:g}",
        None,
    )


def degrees(lower: float, upper: float) -> Found:
    message = f"joint 'j' turns from {lower:g} to {upper:g} rad; are these degrees?"
    return ("range-in-degrees", LIMIT, message, f"{lower:g} to {upper:g}", "at most 12.57")


def away(lower: float, upper: float, line: int = LIMIT) -> Found:
    message = f"the limits of joint 'j' are {lower:g} and {upper:g}, and exclude its zero position"
    return ("zero-out-of-range", line, message, f"{lower:g} to {upper:g}", None)


@pytest.mark.parametrize(
    ("one", "format_", "expected"),
    [
        (joint(-1, 1), Format.URDF, []),
        (joint(0, 1), Format.URDF, []),
        (joint(-1, 0), Format.URDF, []),
        (joint(0, 0), Format.URDF, [empty(0)]),
        (joint(None, None), Format.URDF, [empty(0)]),
        (joint(None, None), Format.SDF, []),
        (joint(None, 1), Format.SDF, []),
        (joint(0.5, None), Format.SDF, []),
        (joint(0.5, 1), Format.URDF, [away(0.5, 1)]),
        (joint(-2, -1, kind="prismatic"), Format.SDF, [away(-2, -1)]),
        (joint(1, 1), Format.SDF, [empty(1), away(1, 1)]),
        (joint(1, -1), Format.SDF, []),
        (joint(-90, 90), Format.URDF, [degrees(-90, 90)]),
        (joint(-1, 13), Format.URDF, [degrees(-1, 13)]),
        (joint(-13, 1), Format.URDF, [degrees(-13, 1)]),
        (joint(-12.5, 12.5), Format.URDF, []),
        (joint(-90, 90, kind="prismatic"), Format.URDF, []),
        (joint(-1e16, 1e16), Format.SDF, []),
        (joint(-90, 90, kind="continuous"), Format.SDF, []),
        (joint(0.5, 1, line=None), Format.SDF, [away(0.5, 1, JOINT)]),
        (joint(1, 1, line=None), Format.URDF, [empty(1, JOINT), away(1, 1, JOINT)]),
        (joint(None, None, line=None), Format.URDF, []),
        (Joint(name="j", type="revolute"), Format.URDF, []),
        (joint(0, 0, kind="fixed", effort=None), Format.URDF, []),
    ],
)
def test_a_range_is_what_a_robot_has(one: Joint, format_: Format, expected: list[Found]) -> None:
    assert found(one, format_) == expected


def unbounded(what: str, line: int = LIMIT) -> Found:
    return ("unbounded-limit", line, f"joint 'j' has no limit of {what}", "none", None)


def implausible(what: str, value: str, most: str) -> Found:
    message = f"joint 'j' has a limit of {what} of {value}, which is more than actuators reach"
    return ("implausible-limit", LIMIT, message, value, f"at most {most}")


@pytest.mark.parametrize(
    ("effort", "velocity", "expected"),
    [
        (0, 0, []),
        (1e5, 1e3, []),
        (None, 1, [unbounded("effort")]),
        (1, None, [unbounded("velocity")]),
        (-1, 1e16, [unbounded("effort and velocity")]),
        (2e5, 1, [implausible("effort", "200000", "100000")]),
        (1, 1001, [implausible("velocity", "1001", "1000")]),
        (2e5, None, [unbounded("velocity"), implausible("effort", "200000", "100000")]),
    ],
)
@pytest.mark.parametrize("kind", ["revolute", "continuous", "prismatic"])
def test_a_drive_has_limits(
    kind: JointType, effort: float | None, velocity: float | None, expected: list[Found]
) -> None:
    assert found(joint(-1, 1, kind=kind, effort=effort, velocity=velocity)) == expected


def test_a_drive_without_a_limit_is_reported_at_its_joint() -> None:
    bare = Joint(name="j", type="continuous", axis=Axis(), source=at(JOINT))
    assert found(bare) == [unbounded("effort and velocity", JOINT)]


def test_the_second_axis_is_looked_at_too() -> None:
    axis = joint(0.5, 1).axis
    for first in (Axis(), None):
        two = Joint(name="j", type="universal", axis=first, axis2=axis, source=at(JOINT))
        assert found(two, Format.SDF) == [away(0.5, 1)]


@pytest.mark.parametrize(
    ("damping", "friction", "expected"),
    [(0, 0, []), (None, None, []), (-0.1, 1, [("damping", "-0.1")]), (-1, -2, [("damping", "-1"), ("friction", "-2")])],
)
def test_nothing_is_damped_by_less_than_nothing(
    damping: float | None, friction: float | None, expected: list[tuple[str, str]]
) -> None:
    dynamics = Dynamics(damping=damping, friction=friction, source=at(DYNAMICS))
    one = Joint(name="j", type="ball", axis=Axis(dynamics=dynamics))
    assert found(one) == [
        ("negative-dynamics", DYNAMICS, f"the {name} of joint 'j' is {value}", value, "0 or more")
        for name, value in expected
    ]


def soft(lower: str, upper: str, kind: JointType = "revolute") -> Joint:
    limits = (("soft_lower_limit", lower), ("soft_upper_limit", upper))
    element = Element(name="safety_controller", attributes=limits)
    return joint(-1, 1, kind=kind).copy(opaque=(Opaque(element=element),))


OUTSIDE = "the soft limits of joint 'j', {0}, are outside of the hard ones"
TURNED = "the lower soft limit of joint 'j' is above the upper one: {0}"


@pytest.mark.parametrize(
    ("one", "message", "text"),
    [
        (soft("-0.9", "0.9"), None, ""),
        (soft("-1", "1"), None, ""),
        (soft("-1.1", "0.9"), OUTSIDE, "-1.1 to 0.9"),
        (soft("-0.9", "1.1"), OUTSIDE, "-0.9 to 1.1"),
        (soft("-0.9", "1.1", "continuous"), None, ""),
        (soft("0.5", "-0.5"), TURNED, "0.5 to -0.5"),
        (soft("0.5", "-0.5", "continuous"), TURNED, "0.5 to -0.5"),
    ],
)
def test_soft_limits_are_inside_of_the_hard_ones(one: Joint, message: str | None, text: str) -> None:
    expected = ("soft-limit-outside", JOINT, message.format(text), text, None) if message else None
    assert found(one) == ([expected] if expected else [])


def test_soft_limits_are_reported_at_their_element() -> None:
    sink, one = DiagnosticSink(), soft("-2", "2")
    CheckLimits().run(Document(format=Format.URDF, models=(Model(name="r", joints=(one,)),)), sink)
    assert [each.location for each in sink.diagnostics] == [one.location.at("safety_controller")]


def test_options_move_what_is_too_much_and_choose_joints() -> None:
    one = joint(-7, 7, effort=5, velocity=5)
    strict = CheckLimits(turns=1, effort=4, velocity=4)
    assert [(rule, expected) for rule, _, _, _, expected in found(one, options=strict)] == [
        ("range-in-degrees", "at most 6.283"),
        ("implausible-limit", "at most 4"),
        ("implausible-limit", "at most 4"),
    ]
    assert found(one, options=strict.model_copy(update={"joints": ("k*",)})) == []
    assert found(one, options=strict.model_copy(update={"joints": ("[jk]",)})) != []
