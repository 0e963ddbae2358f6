"""Verifies the kinematic tree: joints that give a link a second parent, and cycles."""

from collections.abc import Iterable

from twinform.diagnostics import DiagnosticSink, Severity, rules
from twinform.ir.groups import Groups
from twinform.ir.joint import Joint


def report_loops(joints: Iterable[Joint], sink: DiagnosticSink, severity: Severity | None = None) -> dict[str, Joint]:
    """Report second parents and circles; give the first joint of each child."""
    parents: dict[str, Joint] = {}
    groups = Groups()
    for joint in joints:
        if joint.child is None:
            continue
        first = parents.setdefault(joint.child, joint)
        closes = joint.type != "gearbox" and not groups.join(joint.parent or "", joint.child)
        if first is not joint:
            message = f"link {joint.child!r} is the child of joint {first.name!r} and of joint {joint.name!r}"
            message += ", which closes a loop" if closes else ""
            related = (first.location,)
            sink.report(rules.TWO_PARENTS, message, joint.location, related=related, severity=severity)
    for joint in _circles(parents):
        message = f"joint {joint.name!r} closes a loop of joints through link {joint.child!r}"
        sink.report(rules.KINEMATIC_LOOP, message, joint.location, severity=severity)
    return parents


def _circles(parents: dict[str, Joint]) -> list[Joint]:
    """One joint of each circle; every link is walked over once."""
    settled: set[str] = set()
    found: list[Joint] = []
    for start in parents:
        path: dict[str, Joint] = {}
        link = start
        while link in parents and link not in settled and link not in path:
            path[link] = parents[link]
            link = parents[link].parent or ""
        if link in path and path[link].parent != link:  # a joint of one link with itself has a rule of its own
            found.append(path[link])
        settled.update(path)
    return found
