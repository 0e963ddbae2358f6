"""Suppressions that suppress nothing: reported by `check`, where it looks for what they allow."""

from twinform.compiler.input.allowances import Allowances
from twinform.diagnostics import DiagnosticSink, Location
from twinform.diagnostics.rules import UNUSED_SUPPRESSION
from twinform.diagnostics.suppressions import Suppression

_NAMES = """
    ambiguous-frame angle-in-degrees backslash-in-path bare-material blank-value conflicting-material
    continuous-in-sdf dangling-frame dangling-link defaulted-attribute deprecated-element dialect duplicate-name
    empty-dynamics empty-model empty-name frame-cycle gazebo-conflict gazebo-tag-without-target impossible-inertia
    indefinite-inertia inertia-from-nothing invalid-value kinematic-loop lower-above-upper mimic-cycle
    misplaced-sensor missing-attribute missing-axis missing-element missing-file missing-inertial missing-limit
    missing-part missing-shape no-links non-positive-mass old-root out-of-range outside-version repaired-xml
    repeated-element reserved-name self-joint sensor-mismatch several-at-top several-roots shared-name split-value
    stray-text tabbed-numbers transmission-without-joint two-parents unexpanded-xacro unknown-attribute
    unknown-canonical-link unknown-collision unknown-driven-joint unknown-element unknown-gripper-link
    unknown-leader unknown-material unknown-reference unknown-version unnamed-material unnormalised-axis
    unnormalised-quaternion unprintable-name unused-axis unused-limit world-child xacro-warning zero-axis zero-limit
    zero-size
"""
ALWAYS_SOUGHT = frozenset(_NAMES.split())
"""The rules that each check looks for; others are sought by passes, conversions, or where includes are read."""


def report_unused(allowances: Allowances, sink: DiagnosticSink) -> None:
    """Report each rule that the file itself allows without need."""
    own = allowances.files.get(allowances.file)
    for entry, rule in own.unused() if own else ():
        if rule in ALWAYS_SOUGHT:
            where = _lines(entry)
            message = f"no {rule} is found {where}, so nothing has to be allowed"
            help = f"delete {rule} from the comment" if len(entry.rules) > 1 else "delete the comment"
            sink.report(UNUSED_SUPPRESSION, message, Location(allowances.file, entry.line), found=rule, help=help)


def _lines(entry: Suppression) -> str:
    """The lines on which an entry allows its rules, in words."""
    if not entry.last:
        return "in this file"
    return f"on line {entry.first}" if entry.first == entry.last else f"on the lines {entry.first} to {entry.last}"
