import pytest
from hypothesis import given
from hypothesis import strategies as st

from twinform.diagnostics import DiagnosticSink
from twinform.ir import Axis, Document, Format, Joint, JointType, Limit, Model, World
from twinform.passes import parse_pipeline
from twinform.passes.joints.fill_limits import FillLimits

ALL = FillLimits(effort=100, velocity=2, lower=-1, upper=1)


def joint(type_: JointType, limit: Limit | None = None, name: str = "hip") -> Joint:
    return Joint(name=name, type=type_, axis=Axis(xyz=(0, 0, 1), limit=limit))


def robot(*joints: Joint, format_: Format = Format.URDF) -> Document:
    return Document(format=format_, models=(Model(name="robot", joints=joints),))


def fill(options: FillLimits, document: Document) -> tuple[Document, list[str]]:
    sink = DiagnosticSink()
    return options.run(document, sink), [each.rule.name for each in sink.diagnostics]


def filled(options: FillLimits, one: Joint) -> tuple[Limit | None, list[str]]:
    document, rules = fill(options, robot(one))
    axis = document.models[0].joints[0].axis
    return axis and axis.limit, rules


CASES: dict[str, tuple[FillLimits, Joint, Limit | None, list[str]]] = {
    "all is missing": (ALL, joint("revolute"), Limit(effort=100, velocity=2, lower=-1, upper=1), ["filled-limit"]),
    "a slider": (ALL, joint("prismatic"), Limit(effort=100, velocity=2, lower=-1, upper=1), ["filled-limit"]),
    "a wheel has no range": (ALL, joint("continuous"), Limit(effort=100, velocity=2), ["filled-limit"]),
    "a fixed joint has no limits": (ALL, joint("fixed"), None, []),
    "a ball has no limits": (ALL, joint("ball"), None, []),
    "no axis in the file": (
        FillLimits(effort=5),
        Joint(name="hip", type="revolute"),
        Limit(effort=5),
        ["filled-limit"],
    ),
    "what is written stays": (
        ALL,
        joint("revolute", Limit(effort=0, lower=-0.5)),
        Limit(effort=0, velocity=2, lower=-0.5, upper=1),
        ["filled-limit"],
    ),
    "all is written": (
        ALL,
        joint("revolute", Limit(effort=1, velocity=1, lower=0, upper=0)),
        Limit(effort=1, velocity=1, lower=0, upper=0),
        [],
    ),
    "an upper end below the lower": (
        ALL,
        joint("revolute", Limit(lower=3)),
        Limit(effort=100, velocity=2, lower=3),
        ["unfilled-limit", "filled-limit"],
    ),
    "a lower end above the upper": (
        FillLimits(lower=0),
        joint("revolute", Limit(upper=-3)),
        Limit(upper=-3),
        ["unfilled-limit"],
    ),
    "a range that is written upside down": (
        FillLimits(effort=1),
        joint("revolute", Limit(lower=1, upper=-1)),
        Limit(effort=1, lower=1, upper=-1),
        ["filled-limit"],
    ),
    "no options": (FillLimits(), joint("revolute"), None, []),
    "another name": (FillLimits(effort=1, joints=("arm_*",)), joint("revolute"), None, []),
    "a name that matches": (
        FillLimits(effort=1, joints=("arm_[0-9]",)),
        joint("revolute", name="arm_3"),
        Limit(effort=1),
        ["filled-limit"],
    ),
}


@pytest.mark.parametrize("case", CASES)
def test_limits_of_a_joint(case: str) -> None:
    options, one, limit, rules = CASES[case]
    assert filled(options, one) == (limit, rules)


def test_a_joint_of_sdf_without_axis_is_left_alone() -> None:
    document = robot(Joint(name="hip", type="revolute"), format_=Format.SDF)
    assert fill(ALL, document) == (document, [])


def test_joints_of_worlds_and_nested_models_are_filled() -> None:
    one, done = joint("continuous"), joint("continuous", Limit(effort=1))
    inner = Model(name="inner", joints=(one,))
    model = Model(name="outer", models=(inner,))
    document = Document(format=Format.SDF, models=(model,), worlds=(World(name="w", models=(model,), joints=(one,)),))
    result, rules = fill(FillLimits(effort=1), document)
    assert rules == ["filled-limit"] * 3
    assert result.models[0].models[0].joints == (done,)
    assert result.worlds[0].models[0].models[0].joints == (done,)
    assert result.worlds[0].joints == (done,)


def test_parts_without_a_change_are_the_same_objects() -> None:
    untouched = Model(name="still", joints=(joint("fixed"),))
    document = Document(format=Format.SDF, models=(untouched, Model(name="moving", joints=(joint("revolute"),))))
    assert fill(ALL, document)[0].models[0] is untouched


VALUES = st.none() | st.floats(-5, 5)
LIMITS = st.none() | st.builds(Limit, lower=VALUES, upper=VALUES, effort=VALUES, velocity=VALUES)
JOINTS = st.builds(joint, st.sampled_from(["revolute", "prismatic", "continuous", "fixed", "universal"]), LIMITS)


@given(JOINTS)
def test_filling_twice_is_filling_once(one: Joint) -> None:
    once, _ = fill(ALL, robot(one))
    twice, rules = fill(ALL, once)
    assert twice is once
    assert "filled-limit" not in rules


@given(JOINTS)
def test_what_is_written_never_changes(one: Joint) -> None:
    limit, _ = filled(ALL, one)
    written = one.axis.limit.model_dump(exclude_none=True) if one.axis and one.axis.limit else {}
    assert not written or (limit and written.items() <= limit.model_dump(exclude_none=True).items())


@pytest.mark.parametrize("options", ["lower=2 upper=1", "effort=-1", "velocity=inf", "lower=inf"])
def test_options_that_no_joint_can_have_are_refused(options: str) -> None:
    with pytest.raises(ValueError, match="fill-limits"):
        parse_pipeline(f"fill-limits{{{options}}}")
