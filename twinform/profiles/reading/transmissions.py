"""The two forms of `<transmission>` that urdf_parser_py knows: that of ros_control, and the older one of the PR2."""

from twinform.profiles.reading.nodes import RawNode


def objection(node: RawNode) -> str:
    """Why an element is neither of the two; empty where it is one."""
    newer, older = _newer(node), _older(node)
    return newer if newer and older else ""


def _newer(node: RawNode) -> str:
    joints, actuators = list(node.all("joint")), list(node.all("actuator"))
    if "name" not in node.attributes:
        return "<transmission> has no attribute 'name'"
    if node.first("type") is None:
        return "<transmission> has no <type>"
    if not joints or not actuators:
        return f"<transmission> has no <{'actuator' if joints else 'joint'}>"
    if any("name" not in each.attributes for each in (*joints, *actuators)):
        return "a <joint> or <actuator> of a <transmission> has no name"
    if any(joint.first("hardwareInterface") is None for joint in joints):
        return "a <joint> of a <transmission> has no <hardwareInterface>"
    reductions = (actuator.first("mechanicalReduction") for actuator in actuators)
    return next((f"{each.text!r} is no reduction" for each in reductions if each and not _is_number(each.text)), "")


def _older(node: RawNode) -> str:
    named = [node.first("joint"), node.first("actuator")]
    reduction = node.first("mechanicalReduction")
    if not {"name", "type"} <= node.attributes.keys() or reduction is None or not _is_number(reduction.text):
        return "<transmission> is not of the older form either"
    if any(each is None or "name" not in each.attributes for each in named):
        return "<transmission> is not of the older form either"
    return ""


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True
