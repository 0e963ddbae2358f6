"""Bring transmissions of URDF into the form that every reader takes, and leave out those that have none."""

from collections.abc import Iterator
from typing import ClassVar

from twinform.diagnostics import DiagnosticSink, Fate
from twinform.diagnostics.rules import TIDIED_TRANSMISSION
from twinform.ir import Document, Element, Format, Model, Opaque, replace_fields, rewrite
from twinform.passes.framework.pass_base import Pass
from twinform.passes.shared.nodes import unique_name

_TYPE = "transmission_interface/SimpleTransmission"
_INTERFACE = "hardware_interface/EffortJointInterface"
_READ = frozenset({"type", "joint", "actuator"})


class TidyTransmissions(Pass):
    """Complete transmissions so that Drake and urdf_parser_py take them.

    Changes `<transmission>` elements of models of URDF that have one joint of the robot and one actuator:

    1. one without a name or a type gets them, the type being that of a simple transmission;
    2. an interface that stands in the actuator alone is written in the joint, where ros_control reads it; where there
       is none, it is that of effort;
    3. a reduction that is no number goes; that of the older form of the PR2 moves into the actuator;
    4. an actuator with the name of another one is numbered.

    Transmissions without a joint of the robot, or without an actuator with a name, go: no reader can use them, and some
    refuse the file. Never touches: SDF, transmissions of several joints that are complete, and `<ros2_control>`.
    Diagnostics: `tidied-transmission` for each; what goes has an entry of the ledger, *dropped*.
    """

    name = "tidy-transmissions"
    example: ClassVar[str] = "tidy-transmissions"

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document with complete transmissions."""
        if document.format is not Format.URDF:
            return document
        return rewrite(document, Model, lambda model: replace_fields(model, opaque=tuple(_tidy_parts(model, sink))))


def _tidy_parts(model: Model, sink: DiagnosticSink) -> Iterator[Opaque]:
    joints = {joint.name for joint in model.joints}
    names, actuators = set[str](), set[str]()
    for part in model.opaque:
        if part.element is None or part.element.name != "transmission":
            yield part
        elif not _is_usable(part.element, joints):
            _drop(part, part.element, sink)
        else:
            made = _complete(part.element, names, actuators)
            if made != part.element:
                message = f"<transmission> {made.get('name')!r} is completed"
                sink.report(TIDIED_TRANSMISSION, message, part.location, found=made.get("name"))
            yield replace_fields(part, element=made)


def _is_usable(element: Element, joints: set[str]) -> bool:
    """Whether all joints of a transmission belong to the robot, and it has a joint and a named actuator."""
    ends = element.find_all("joint")
    named = [joint.get("name") for joint in ends]
    return (
        bool(ends)
        and set(named) <= joints
        and all(each.get("name") for each in element.find_all("actuator"))
        and element.find("actuator") is not None
    )


def _drop(part: Opaque, element: Element, sink: DiagnosticSink) -> None:
    message = f"<transmission> {element.get('name')!r} has no joint of the robot, or no actuator: it is left out"
    sink.report(TIDIED_TRANSMISSION, message, part.location, found=element.get("name"))
    sink.account(Fate.DROPPED, TIDIED_TRANSMISSION, message, part.location)


def _complete(element: Element, names: set[str], actuators: set[str]) -> Element:
    joint = element.find_all("joint")[0]
    name = unique_name(element.get("name") or f"{joint.get('name')}_transmission", names)
    names.add(name)
    kind = next((child.text or "" for child in element.find_all("type")), None) or element.get("type") or _TYPE
    interfaces = [child for each in element.find_all("actuator") for child in each.find_all("hardwareInterface")]
    reduction = next((child for child in element.find_all("mechanicalReduction") if _is_number(child.text)), None)
    children = [Element(name="type", text=kind)]
    for child in element.children:
        if child.name == "joint":
            children.append(_complete_joint(child, interfaces))
        elif child.name == "actuator":
            children.append(_complete_actuator(child, reduction, actuators))
        elif child.name not in {"type", "mechanicalReduction"}:
            children.append(child)
    attributes = (("name", name), *(pair for pair in element.attributes if pair[0] not in {"name", "type"}))
    return element.copy(attributes=attributes, children=tuple(children), text=None)


def _complete_joint(element: Element, interfaces: list[Element]) -> Element:
    if element.find("hardwareInterface") is not None:
        return element
    wanted = tuple(interfaces[:1]) or (Element(name="hardwareInterface", text=_INTERFACE),)
    return element.copy(children=(*element.children, *wanted))


def _complete_actuator(element: Element, reduction: Element | None, taken: set[str]) -> Element:
    name = unique_name(element.get("name") or "", taken)
    taken.add(name)
    kept = [each for each in element.children if each.name != "mechanicalReduction" or _is_number(each.text)]
    if reduction is not None and not any(each.name == "mechanicalReduction" for each in kept):
        kept.append(reduction)
    attributes = tuple((key, name if key == "name" else value) for key, value in element.attributes)
    return element.copy(attributes=attributes, children=tuple(kept))


def _is_number(text: str | None) -> bool:
    try:
        float(text or "")
    except ValueError:
        return False
    return True
