"""What is asked of a value, and where it goes."""

from typing import Any

import pytest
from lxml import etree

from twinform.diagnostics import DiagnosticSink, Source
from twinform.schemas import Context, Fact
from twinform.schemas.value_readers import check_pose, value_check, value_store

LATE = Fact("@mode", since=(1, 5), enum=("late", "slow"))
GONE = Fact("@mode", until=(1, 0), enum=("gone", "slow"))
WORDS: dict[str, Any] = {
    "enum": ("fast", "slow"),
    "also": (("warp", "gazebo"),),
    "elsewhere": {"late": LATE, "gone": GONE},
}
FAST = "expected one of fast, slow"

CHECKS: list[tuple[Fact, object, tuple[str, str, str | None] | None]] = [
    (Fact("@mode", **WORDS), "fast", None),
    (Fact("@mode", **WORDS), "slow", None),
    (Fact("@mode", **WORDS), "odd", ("invalid-value", f"'mode' of <a> is 'odd'; {FAST}", "one of fast, slow")),
    (Fact("mode", **WORDS), "odd", ("invalid-value", f"<a> is 'odd'; {FAST}", "one of fast, slow")),
    (Fact("@mode", **WORDS), "warp", ("dialect", "'mode' of <a> is 'warp', which is not SDF; Gazebo reads it", None)),
    (
        Fact("@mode", **WORDS),
        "late",
        ("outside-version", "'late' as 'mode' of <a> was added in SDF 1.5; the file declares 1.2", "fast, slow"),
    ),
    (
        Fact("mode", **WORDS),
        "gone",
        ("outside-version", "'gone' as <a> was removed after SDF 1.0; the file declares 1.2", "fast, slow"),
    ),
    (Fact("@near", type="double", min=0, max=1), 0.0, None),
    (Fact("@near", type="double", min=0, max=1), 1.0, None),
    (
        Fact("@near", type="double", min=0, max=1),
        -0.25,
        ("out-of-range", "'near' of <a> is -0.25; expected at least 0", "at least 0"),
    ),
    (Fact("near", type="uint", min=2), 1, ("out-of-range", "<a> is 1; expected at least 2", "at least 2")),
    (Fact("near", type="uint", min=2), 10**9, None),
    (Fact("near", type="int", max=2), -(10**9), None),
    (Fact("near", type="int", max=2), 3, ("out-of-range", "<a> is 3; expected at most 2", "at most 2")),
    (Fact("near", type="color", min=0, max=1), (0.0, 1.0, 0.5), None),
    (
        Fact("near", type="color", min=0, max=1),
        (0.0, 1.0, 1.5),
        ("out-of-range", "<a> is 1.5; expected at most 1", "at most 1"),
    ),
]


def on(text: str = "<a/>") -> tuple[Any, Context]:
    return etree.fromstring(text), Context(DiagnosticSink(), "f", "sdf", (1, 2))


@pytest.mark.parametrize(("row", "value", "expected"), CHECKS)
def test_what_is_wrong_with_a_value_is_reported(
    row: Fact, value: object, expected: tuple[str, str, str | None] | None
) -> None:
    element, context = on()
    check = value_check(row)
    assert check
    check(element, value, context)
    findings = [(each.rule.name, each.message, each.expected) for each in context.sink.diagnostics]
    assert findings == ([expected] if expected else [])
    step = f"/a/{row.name}" if row.is_attribute else "/a"
    assert {each.location.path for each in context.sink.diagnostics} <= {step}
    named = row.name[1:] if row.is_attribute else "#text"
    assert context.replaced == ([(element, named, "fast")] if value in row.elsewhere else [])


@pytest.mark.parametrize("type", ["double", "vector3", "string", "bool"])
def test_nothing_is_asked_where_the_row_has_no_bounds(type: str) -> None:
    assert value_check(Fact("a", type=type)) is None


QUATERNION = "rotation_format='quat_xyzw'"
NO_QUATERNION = "six numbers, or the attribute rotation_format='quat_xyzw'"
POSES: list[tuple[str, int, tuple[str, str, str | None] | None]] = [
    ("", 6, None),
    ("degrees='true'", 6, None),
    (QUATERNION, 7, None),
    (f"{QUATERNION} degrees='false'", 7, None),
    ("", 7, ("/a", f"<a> has 7 numbers; expected {NO_QUATERNION}", NO_QUATERNION)),
    ("rotation_format='euler_rpy'", 7, ("/a", f"<a> has 7 numbers; expected {NO_QUATERNION}", NO_QUATERNION)),
    (QUATERNION, 6, ("/a", "<a> has 6 numbers; expected seven numbers", "seven numbers")),
    *(
        (
            f"{QUATERNION} degrees='{word}'",
            7,
            ("/a/@degrees", f"<a> is a quaternion, which cannot have the attribute degrees='{word}'", None),
        )
        for word in ("true", "1", " True ")
    ),
]


@pytest.mark.parametrize(("attributes", "count", "expected"), POSES)
def test_a_pose_has_the_numbers_of_its_notation(
    attributes: str, count: int, expected: tuple[str, str, str | None] | None
) -> None:
    element, context = on(f"<a {attributes}>text</a>")
    check_pose(element, count, context)
    assert [(each.location.path, each.message, each.expected) for each in context.sink.diagnostics] == (
        [expected] if expected else []
    )
    assert context.structural == 0


ABOVE = Source("f", 3, None, "above")
INSIDE = Source("f", 1, ABOVE, "a")
STORES: list[tuple[Fact, str, dict[str, Any], object, dict[str, Any]]] = [
    (Fact("a", type="double"), "field", {}, (1.0, "1"), {"field": 1.0}),
    (Fact("a", type="int", count="*"), "field", {}, (1, "1"), {"field": [1]}),
    (Fact("a", type="int", many=True), "field", {"field": [1]}, (2, "2"), {"field": [1, 2]}),
    (Fact("a", type="bool"), "field", {}, (True, "true"), {"field": True}),
    (Fact("a", type="bool"), "field", {}, (False, "false"), {"field": False}),
    (Fact("a", type="bool"), "field", {}, (True, " 1 "), {"field": True, "spelling": {"field": "1"}}),
    (
        Fact("a", type="bool"),
        "field",
        {"spelling": {"b": "0"}},
        (False, "FALSE"),
        {"field": False, "spelling": {"b": "0", "field": "FALSE"}},
    ),
    (Fact("a", type="double"), "box.field", {}, (1.0, "1"), {"box": {"source": INSIDE, "field": 1.0}}),
    (
        Fact("a", type="double"),
        "box.field",
        {"box": {"source": ABOVE, "other": 2.0}},
        (1.0, "1"),
        {"box": {"source": ABOVE, "other": 2.0, "field": 1.0}},
    ),
]


@pytest.mark.parametrize(("row", "place", "node", "value", "expected"), STORES)
def test_a_value_goes_where_the_table_puts_it(
    row: Fact, place: str, node: dict[str, Any], value: tuple[object, str], expected: dict[str, Any]
) -> None:
    element, context = on()
    data = {"source": ABOVE, **{key: each.copy() for key, each in node.items()}}
    value_store(row, place)(element, data, *value, context)
    assert data == {"source": ABOVE, **expected}
    assert context.header == {}


def test_what_is_about_the_document_goes_into_its_header() -> None:
    element, context = on()
    value_store(Fact("@version", type="string"), "/version")(element, {}, "1.1", "1.1", context)
    assert context.header == {"version": "1.1"}
