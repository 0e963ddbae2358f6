"""Random models in MJCF: trees of bodies with joints of all kinds, geoms of all primitives, and masses in every way."""

import math
from random import Random

from lxml import etree

from twinform.schemas import XmlElement

_JOINTS = ("hinge", "slide", "ball")
_SIZES = {"box": 3, "sphere": 1, "cylinder": 2, "capsule": 2, "ellipsoid": 3}
_MOST_JOINTS = 3


def random_model(seed: int) -> str:
    """Return a file with one to three trees, with or without a floor; each body has a mass."""
    random = Random(seed)
    root = etree.Element("mujoco", model=f"random_{seed}")
    compiler = etree.SubElement(root, "compiler", angle="radian", autolimits="false")
    if random.random() < 0.3:
        compiler.set("inertiagrouprange", "0 1")
    if random.random() < 0.3:
        compiler.set("boundinertia", "0.01")
    world = etree.SubElement(root, "worldbody")
    if random.random() < 0.5:
        etree.SubElement(world, "geom", name="floor", type="plane", size="1 1 0.1")
    for tree in range(random.randint(1, 3)):
        _add_body(world, random, f"tree_{tree}", random.randint(0, 3), is_free=random.random() < 0.5)
    return etree.tostring(root, pretty_print=True).decode()


def _add_body(above: XmlElement, random: Random, name: str, depth: int, *, is_free: bool) -> None:
    body = etree.SubElement(above, "body", {"name": name, **_place(random)})
    if is_free:
        etree.SubElement(body, "freejoint")
    else:
        _add_joints(body, random, name)
    if random.random() < 0.4:
        _add_inertial(body, random)
    for number in range(random.randint(1, 3)):
        _add_geom(body, random, f"{name}_geom_{number}", group=0 if number == 0 else random.randint(0, 4))
    for number in range(random.randint(0, 2) if depth else 0):
        _add_body(body, random, f"{name}_{number}", depth - 1, is_free=False)


def _add_joints(body: XmlElement, random: Random, name: str) -> None:
    for number in range(random.randint(0, _MOST_JOINTS)):
        kind = random.choice(_JOINTS[: 2 if number else 3])
        joint = etree.SubElement(body, "joint", name=f"{name}_joint_{number}", type=kind, pos=_numbers(random, 3))
        joint.set("damping", f"{random.uniform(0, 2):g}")
        if kind == "ball":
            return  # nothing that turns may come behind it
        joint.set("axis", _numbers(random, 3))
        if random.random() < 0.5:
            least = random.uniform(-2, 0)
            joint.attrib.update({"limited": "true", "range": f"{least:g} {least + random.uniform(0.5, 3):g}"})
        if random.random() < 0.3:
            joint.set("ref", f"{random.uniform(-1, 1):g}")
        if random.random() < 0.3:
            joint.attrib.update({"stiffness": "3", "springref": f"{random.uniform(-1, 1):g}", "frictionloss": "0.5"})


def _add_inertial(body: XmlElement, random: Random) -> None:
    inertial = etree.SubElement(body, "inertial", pos=_numbers(random, 3), mass=f"{random.uniform(0.1, 3):g}")
    if random.random() < 0.5:
        inertial.attrib.update({"quat": _numbers(random, 4), "diaginertia": "0.1 0.15 0.2"})
    else:
        inertial.set("fullinertia", "0.2 0.25 0.3 0.01 -0.02 0.03")


def _add_geom(body: XmlElement, random: Random, name: str, group: int) -> None:
    kind = random.choice(list(_SIZES))
    size = " ".join(f"{random.uniform(0.05, 0.5):g}" for _ in range(_SIZES[kind]))
    geom = etree.SubElement(
        body, "geom", {"name": name, "type": kind, "size": size, "group": str(group), **_place(random)}
    )
    said = random.random()
    if said < 0.3:
        geom.set("mass", f"{random.uniform(0.1, 2):g}")
    elif said < 0.6:
        geom.set("density", f"{random.uniform(100, 2000):g}")


def _place(random: Random) -> dict[str, str]:
    return {"pos": _numbers(random, 3), "quat": _numbers(random, 4)}


def _numbers(random: Random, count: int) -> str:
    """Return numbers that are not all next to zero."""
    while True:
        found = [random.uniform(-1, 1) for _ in range(count)]
        if math.hypot(*found) > 0.1:
            return " ".join(f"{each:.6g}" for each in found)
