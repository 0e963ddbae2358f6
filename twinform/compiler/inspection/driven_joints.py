"""Transmissions and `<ros2_control>` that name no joint of the robot."""

from collections import Counter
from collections.abc import Iterator

from twinform.diagnostics import DiagnosticSink, Location, did_you_mean, rules
from twinform.ir import Document, Element, Model
from twinform.passes.control.carried_elements import urdf_elements

_HOLDERS = ("transmission", "ros2_control")
_JOINTS = ("joint", "passive_joint")
# Elements of a transmission that name the joint that it drives; the last four are those of the PR2.
_WITH_JOINT = frozenset({*_JOINTS, "gap_joint", "simulated_actuated_joint", "flexJoint", "rollJoint"})


def report_driven_joints(document: Document, sink: DiagnosticSink) -> None:
    """Report the names of joints that are not there, and transmissions without any."""
    for model in document.models:
        _report(model, document, sink)


def _report(model: Model, document: Document, sink: DiagnosticSink) -> None:
    joints = {joint.name for joint in model.joints}
    for holder in _HOLDERS:
        for part, element in urdf_elements(model, document.format, holder):
            called = element.get("name") or ""
            if holder == "transmission" and not any(child.name in _WITH_JOINT for child in element.children):
                message = f"transmission {called!r} has no <joint>: it drives nothing"
                sink.report(rules.TRANSMISSION_WITHOUT_JOINT, message, part.location, expected="<joint name='...'>")
            for name, where in _named(element, part.location):
                if name not in joints and "$" not in name:
                    message = f"<{holder}> {called!r} names the joint {name!r}, which the robot does not have"
                    hint = did_you_mean(name, joints)
                    sink.report(rules.UNKNOWN_DRIVEN_JOINT, message, where, found=name, help=hint)


def _named(element: Element, place: Location) -> Iterator[tuple[str, Location]]:
    """The joints that an element names, and where."""
    counts: Counter[str] = Counter()
    for child in element.children:
        counts[child.name] += 1
        name = child.get("name")
        if child.name in _JOINTS and name:
            yield name, place.at(f"{child.name}[@name='{name}']")
