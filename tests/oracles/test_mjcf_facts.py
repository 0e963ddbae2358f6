"""The facts of MJCF are those of the MuJoCo that is installed: every element, attribute, type and word."""

import pytest

from tests.oracles.mjcf_probes import Attribute, attributes, complaint, lengths, printed, saved, written
from twinform.testing import oracles

SECTIONS = (
    "compiler", "option", "size", "statistic", "visual", "default", "custom", "extension", "asset", "body", "contact",
    "deformable", "equality", "tendon", "actuator", "sensor", "keyframe",
)  # fmt: skip
BOGUS = "zz~"
VALUES = {
    "string": ("x",),
    "words": ("x y",),
    "bool": ("true", "false"),
    "memory": ("10K", "-1"),
    "axes": ("xYz",),
    "doubles": ("1 2.5 inf",),
    "ints": ("1 2",),
}
"""Some values of the types of which there is no number of numbers."""


RESOLVED = frozenset(
    f"default/{each}"
    for each in ("position/@timeconst", "orientation/@input", "pid/@input", "damper/@kv", "dcmotor/@input")
) | {"default/texture/@gridlayout"}
"""Values of a class from which MuJoCo makes others, which it saves; and one that only goes with a grid of its size."""


@pytest.fixture(autouse=True)
def engine() -> None:
    if not oracles.available("mujoco"):
        pytest.skip("mujoco is not installed")


def test_the_elements_are_those_that_mujoco_prints() -> None:
    assert {steps: count for steps, (count, _) in written().items()} == {
        steps: count for steps, (count, _) in printed().items()
    }


def test_the_attributes_are_those_that_mujoco_prints() -> None:
    ours = {steps: {row.name[1:] for row in rows} for steps, (_, rows) in written().items()}
    assert ours == {steps: set(names) for steps, (_, names) in printed().items()}


@pytest.mark.parametrize("section", SECTIONS)
def test_every_value_of_the_facts_is_one_for_mujoco(section: str) -> None:
    refused = {
        f"{each}={value}": said
        for each in attributes([section])
        for value in _legal(each)
        if (said := complaint(each, value))
    }
    assert refused == {}


@pytest.mark.parametrize("section", SECTIONS)
def test_what_the_facts_do_not_have_is_none_for_mujoco(section: str) -> None:
    taken = [
        f"{each}={value}" for each in attributes([section]) for value in _illegal(each) if not complaint(each, value)
    ]
    assert taken == []


def test_a_default_that_is_written_changes_nothing() -> None:
    given = [each for each in attributes() if each.fact.default is not None and str(each) not in RESOLVED]
    pairs = [(str(each), before, saved(each, each.fact.default)) for each in given if (before := saved(each, None))]
    # An element that is no model by itself has the defaults of its class.
    assert len(pairs) > 600
    assert [name for name, before, after in pairs if before != after] == []


def _legal(attribute: Attribute) -> list[str]:
    fact = attribute.fact
    known = fact.enum or VALUES.get(fact.type or "")
    if known:
        return [*known]
    default = [fact.default] if fact.default else []
    return [*default, *(" ".join(["1"] * count) for count in lengths(fact))]


def _illegal(attribute: Attribute) -> list[str]:
    fact = attribute.fact
    if not fact.enum and fact.type in {"string", "words"}:
        return []
    if fact.enum or fact.type in VALUES:
        return ["zz" if fact.type == "axes" else BOGUS]  # it looks at the letters when it compiles
    counts = lengths(fact)
    wrong = [counts[-1] + 1, *([counts[0] - 1] if counts[0] > 1 else [])]
    return [BOGUS, *(" ".join(["1"] * count) for count in wrong)]
