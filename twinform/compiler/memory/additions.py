"""What the way over adds to a URDF, taken off the way back: most files never had it, and those that did remember it."""

from twinform.schemas import XmlElement

_SHAPES = ("visual", "collision")
_NUMBERS = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")


def take_off_additions(robot: XmlElement) -> None:
    """Take off names that shapes are given, inertias of nothing, and the wish that fixed joints stay, which is ours."""
    for link in robot.findall("link"):
        _unname(link)
        inertial = link.find("inertial")
        if inertial is not None and _is_nothing(inertial):
            link.remove(inertial)
    for block in robot.findall("gazebo"):
        if len(block) == 1 and block[0].tag == "preserveFixedJoint" and block[0].text == "true":
            robot.remove(block)


def _unname(link: XmlElement) -> None:
    for tag in _SHAPES:
        usual = f"{link.get('name')}_{tag}"
        for shape in link.findall(tag):
            name = shape.get("name") or ""
            if name.startswith(usual) and _is_number(name[len(usual) :]):
                del shape.attrib["name"]


def _is_number(ending: str) -> bool:
    return not ending or (ending[0] == "_" and ending[1:].isdecimal())


def _is_nothing(inertial: XmlElement) -> bool:
    """Whether it says mass and inertia of nothing, and no more."""
    mass, inertia = inertial.find("mass"), inertial.find("inertia")
    if mass is None or inertia is None or inertial.find("origin") is not None:
        return False
    return dict(mass.attrib) == {"value": "0"} and dict(inertia.attrib) == dict.fromkeys(_NUMBERS, "0")
