"""Which rules find what libsdformat finds, and which find what it does not?

The case files are looked through for those that announce a rule, so the page shows where each one is tried.
"""

import re
from collections import defaultdict
from pathlib import Path
from typing import NamedTuple

from reports.harness.pages import section, table
from reports.harness.report import Findings, Report
from reports.harness.sample import Sample

CASES = Path(__file__).parents[1] / "tests" / "cases" / "check"
_EXPECT = re.compile(r"<!--\s*expect:\s*\w+\s+([\w-]+)\s*-->")
_ABOUT = """\
The error codes of libsdformat 17 by name (numbers change between its versions), with the rules that find the same
here and a case file of `tests/cases/check` that shows each. Below it are faults that libsdformat reads without a word.
"""


class Row(NamedTuple):
    """A code or a fault, the rules for it, and a word where there are none."""

    title: str
    rules: tuple[str, ...] = ()
    note: str = ""


CODES = (
    Row("NONE", note="no error"),
    Row("FILE_READ", ("unreadable-file", "not-well-formed", "unknown-root")),
    Row("DUPLICATE_NAME", ("duplicate-name", "shared-name")),
    Row("RESERVED_NAME", ("reserved-name", "dangling-frame")),
    Row("ATTRIBUTE_MISSING", ("missing-attribute", "defaulted-attribute")),
    Row("ATTRIBUTE_INVALID", ("invalid-value", "dangling-frame", "empty-name")),
    Row("ATTRIBUTE_DEPRECATED", note="never reported by libsdformat; no attribute is deprecated"),
    Row("ATTRIBUTE_INCORRECT_TYPE", ("unknown-attribute", "outside-version")),
    Row("ELEMENT_MISSING", ("missing-part", "missing-element", "inertia-from-nothing")),
    Row("ELEMENT_INVALID", ("invalid-value", "out-of-range", "zero-axis", "blank-value")),
    Row("ELEMENT_DEPRECATED", ("deprecated-element",)),
    Row("ELEMENT_INCORRECT_TYPE", ("unknown-element", "repeated-element", "several-at-top")),
    Row("ELEMENT_ERROR", note="a fault of the program that calls libsdformat"),
    Row("URI_INVALID", note="never reported by libsdformat"),
    Row("URI_LOOKUP", note="with the rules about files that a model names"),
    Row("DIRECTORY_NONEXISTANT", note="never reported by libsdformat"),
    Row("MODEL_CANONICAL_LINK_INVALID", ("unknown-canonical-link",)),
    Row("MODEL_WITHOUT_LINK", ("empty-model", "no-links")),
    Row("NESTED_MODELS_UNSUPPORTED", note="never reported by libsdformat"),
    Row("LINK_INERTIA_INVALID", ("indefinite-inertia", "impossible-inertia", "non-positive-mass")),
    Row("JOINT_CHILD_LINK_INVALID", ("dangling-link", "world-child", "self-joint")),
    Row("JOINT_PARENT_LINK_INVALID", ("dangling-link", "self-joint")),
    Row("JOINT_PARENT_SAME_AS_CHILD", ("self-joint",)),
    Row("FRAME_ATTACHED_TO_INVALID", ("dangling-frame", "ambiguous-frame")),
    Row("FRAME_ATTACHED_TO_CYCLE", ("frame-cycle",)),
    Row("FRAME_ATTACHED_TO_GRAPH_ERROR", note="follows from the ones before"),
    Row("POSE_RELATIVE_TO_INVALID", ("dangling-frame", "ambiguous-frame")),
    Row("POSE_RELATIVE_TO_CYCLE", ("frame-cycle",)),
    Row("POSE_RELATIVE_TO_GRAPH_ERROR", note="follows from the ones before"),
    Row("ROTATION_SNAP_CONFIG_ERROR", note="an option of its printer"),
    Row("STRING_READ", ("not-well-formed", "unknown-root")),
    Row("MODEL_PLACEMENT_FRAME_INVALID", note="with the rules about includes"),
    Row("VERSION_DEPRECATED", note="never reported by libsdformat"),
    Row("MERGE_INCLUDE_UNSUPPORTED", note="with the rules about includes"),
    Row("PARAMETER_ERROR", ("invalid-value", "out-of-range")),
    Row("UNKNOWN_PARAMETER_TYPE", note="a fault in libsdformat's own description"),
    Row("FATAL_ERROR", note="a fault of libsdformat"),
    Row("WARNING", note="its word for `--strict`"),
    Row("JOINT_AXIS_EXPRESSED_IN_INVALID", ("dangling-frame",)),
    Row("CONVERSION_ERROR", ("unknown-version",)),
    Row("PARSING_ERROR", ("unknown-root", "duplicate-name")),
    Row("JOINT_AXIS_MIMIC_INVALID", ("unknown-leader",)),
    Row("XML_ERROR", ("not-well-formed", "repaired-xml", "doctype")),
)
"""In the order of their numbers in libsdformat 17."""

UNSEEN = (
    Row("closed kinematic loops", ("kinematic-loop",)),
    Row("two joints with one child", ("two-parents",)),
    Row("a lower limit above the upper one", ("lower-above-upper",)),
    Row("joints that mimic each other", ("mimic-cycle",)),
    Row("a contact sensor that looks at a missing collision", ("unknown-collision",)),
    Row("a gripper of missing links", ("unknown-gripper-link",)),
    Row("a mass of zero", ("non-positive-mass",)),
    Row("a sensor with the parameters of another type", ("sensor-mismatch",)),
    Row("a sensor of force and torque on a link", ("misplaced-sensor",)),
    Row("a joint that moves without an axis", ("missing-axis",)),
    Row("an axis of a fixed joint", ("unused-axis",)),
    Row("an axis that is not of length one", ("unnormalised-axis",)),
    Row("limits of a continuous joint", ("unused-limit",)),
    Row("an effort or velocity of zero", ("zero-limit",)),
    Row("single elements that are repeated, two shapes in one geometry", ("repeated-element",)),
    Row("a number with a unit behind it, such as `1.0kg`", ("invalid-value",)),
    Row("a value with a comment in the middle, of which the first piece is a value too", ("split-value",)),
    Row("numbers of URDF with a tab or a new line between them, with which a link is cut off", ("tabbed-numbers",)),
    Row("a visual or collision without a shape", ("missing-shape",)),
    Row("negative sizes", ("out-of-range",)),
    Row("sizes of zero", ("zero-size",)),
    Row("a visual and a collision of one name", ("shared-name",), "only `gz sdf --check` sees it"),
    Row("frames of poses in links, of lights and of gearboxes that do not exist", ("dangling-frame", "dangling-link")),
    Row("a `<gazebo>` that refers to nothing", ("unknown-reference",)),
    Row("materials of URDF that are redefined, undefined or unnamed", (
        "conflicting-material", "unknown-material", "unnamed-material", "bare-material",
    )),
    Row("a colour of three numbers", note="SDF allows it: alpha is 1"),
)  # fmt: skip


def measure(_: Sample) -> Findings:
    """Both tables."""
    cases = announced()
    sections = [_table("code", CODES, cases), section("Read without a word", _table("fault", UNSEEN, cases))]
    return Findings(sections, f"{len(CODES)} codes, {len(UNSEEN)} faults")


def announced() -> dict[str, list[str]]:
    """The case files that announce each rule."""
    found: dict[str, list[str]] = defaultdict(list)
    for path in sorted(CASES.iterdir()):
        for rule in dict.fromkeys(_EXPECT.findall(path.read_text(encoding="utf-8", errors="replace"))):
            found[rule].append(path.name)
    return found


def _table(title: str, rows: tuple[Row, ...], cases: dict[str, list[str]]) -> str:
    return table(
        [title, "rules", "cases"],
        [
            (row.title, ", ".join(f"[{rule}](rules.md#{rule})" for rule in row.rules) or row.note, _shown(row, cases))
            for row in rows
        ],
    )


def _shown(row: Row, cases: dict[str, list[str]]) -> str:
    return ", ".join(dict.fromkeys(name for rule in row.rules for name in cases[rule][:2]))


REPORT = Report(
    "libsdformat_codes", "What libsdformat finds, and what it does not", _ABOUT, measure, needs=(), folder="reference"
)
