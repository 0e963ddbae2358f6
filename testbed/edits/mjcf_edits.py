"""Edits of MJCF that was converted, as people make them in an editor: numbers, names, removed and added elements."""

from collections.abc import Callable
from random import Random

from lxml import etree

from twinform.schemas import XmlElement

Draw = Callable[[XmlElement, Random], str | None]
"""Edits a tree at random, and tells what it did; None where there is nothing of the kind."""
_NUMBERS = {
    "body": ("pos", "quat"),
    "geom": ("size", "pos", "quat", "rgba", "friction"),
    "inertial": ("mass", "pos", "diaginertia"),
    "joint": ("axis", "pos", "range", "damping", "frictionloss", "stiffness"),
    "site": ("pos",),
}
"""The attributes with numbers that are changed, by their elements."""


def draw_mjcf_edit(text: bytes, random: Random) -> tuple[str, bytes]:
    """Return what an edit does, and the text after it."""
    root = etree.fromstring(text)
    for _ in range(20):
        (draw,) = random.choices([each for _, each in KINDS], [weight for weight, _ in KINDS])
        done = draw(root, random)
        if done is not None:
            return done, etree.tostring(root)
    return "nothing", text


def without_carriers(text: bytes) -> bytes:
    """The text without what only we read."""
    root = etree.fromstring(text)
    for each in [*root.iterfind("custom/text")]:
        parent = each.getparent()
        if parent is not None and "twinform:" in (each.get("name") or ""):
            parent.remove(each)
    return etree.tostring(root)


def _elements(root: XmlElement, *tags: str) -> list[XmlElement]:
    return [each for each in root.iterfind("worldbody//*") if each.tag in tags]


def _pick(elements: list[XmlElement], random: Random) -> XmlElement | None:
    return random.choice(elements) if elements else None


def _called(element: XmlElement) -> str:
    return f"<{element.tag} name={element.get('name')!r}>"


def change_number(root: XmlElement, random: Random) -> str | None:
    """Change a number of an attribute, within sense."""
    places = [(each, name) for each in _elements(root, *_NUMBERS) for name in _NUMBERS[str(each.tag)] if each.get(name)]
    if not places:
        return None
    element, name = random.choice(places)
    numbers = [float(word) for word in (element.get(name) or "").split()]
    factor = random.choice((0.5, 0.9, 1.1, 2.0))
    if name in {"pos", "axis", "quat"}:
        at = random.randrange(len(numbers))
        numbers[at] = round(numbers[at] + random.choice((-0.25, 0.25, 0.5)), 6)
    elif name == "rgba":
        numbers[0] = round(random.random(), 3)
    elif name == "range":
        numbers[1] = numbers[1] * factor if numbers[1] > 0 else numbers[1] + 1
    else:
        numbers = [number * factor for number in numbers]
    element.set(name, " ".join(map(repr, numbers)))
    return f"change {name} of {_called(element)} to {element.get(name)}"


def rename_everywhere(root: XmlElement, random: Random) -> str | None:
    """Rename a body or joint in all of the file, also in carriers, as by replacing a word."""
    return _rename(root, random, carriers=True)


def rename_outside_carriers(root: XmlElement, random: Random) -> str | None:
    """Rename a body or joint where MuJoCo reads its name."""
    return _rename(root, random, carriers=False)


def _rename(root: XmlElement, random: Random, *, carriers: bool) -> str | None:
    element = _pick([each for each in _elements(root, "body", "joint") if each.get("name")], random)
    if element is None:
        return None
    old = element.get("name") or ""
    new = f"{old}_renamed"
    element.set("name", new)
    references = ("joint", "joint1", "joint2") if element.tag == "joint" else ("body1", "body2", "body")
    for each in root.iter("*"):
        for name in references:
            if each.getparent() is not None and each.get(name) == old:
                each.set(name, new)
        if carriers and each.tag == "text":
            each.set("name", (each.get("name") or "").replace(f":{old}", f":{new}"))
            each.set("data", (each.get("data") or "").replace(f'"{old}"', f'"{new}"').replace(f">{old}<", f">{new}<"))
    return f"rename {element.tag} {old!r} {'everywhere' if carriers else 'outside of carriers'}"


def delete_attribute(root: XmlElement, random: Random) -> str | None:
    """Delete an attribute that has a default."""
    names = ("pos", "quat", "damping", "frictionloss", "stiffness", "rgba", "friction")
    places = [(each, name) for each in _elements(root, *_NUMBERS) for name in names if each.get(name)]
    places = [(each, name) for each, name in places if each.tag != "inertial"]
    if not places:
        return None
    element, name = random.choice(places)
    del element.attrib[name]
    return f"delete {name} of {_called(element)}"


def delete_range(root: XmlElement, random: Random) -> str | None:
    """Let a joint turn or slide without a limit."""
    joint = _pick([each for each in _elements(root, "joint") if each.get("range")], random)
    if joint is None:
        return None
    del joint.attrib["range"]
    joint.attrib.pop("limited", None)
    return f"delete the range of {_called(joint)}"


def delete_shape(root: XmlElement, random: Random) -> str | None:
    """Delete a geom or a site that nothing names."""
    element = _pick(_elements(root, "geom"), random)
    return None if element is None else _delete(element)


def delete_joint(root: XmlElement, random: Random) -> str | None:
    """Fix a body to its parent, by deleting its only joint that nothing names."""
    named = {each.get(name) for each in root.iter("*") for name in ("joint", "joint1", "joint2")}
    found = [each for each in _elements(root, "joint") if each.get("name") not in named]
    joint = _pick([each for each in found if _is_only(each)], random)
    return None if joint is None else _delete(joint)


def _is_only(joint: XmlElement) -> bool:
    body = joint.getparent()
    return body is not None and len(body.findall("joint")) == 1


def delete_leaf(root: XmlElement, random: Random) -> str | None:
    """Delete a body that holds no other one, if nothing outside of it names what is in it."""
    sections = [each for each in root if each.tag not in {"worldbody", "custom", "asset"}]
    named = {value for section in sections for each in section.iter("*") for value in each.attrib.values()}
    leaves = [each for each in _elements(root, "body") if each.find("body") is None and each.getparent() is not None]
    found = [each for each in leaves if each.getparent() is not root.find("worldbody")]
    body = _pick([each for each in found if not any(inner.get("name") in named for inner in each.iter("*"))], random)
    return None if body is None else _delete(body)


def _delete(element: XmlElement) -> str:
    parent = element.getparent()
    if parent is not None:
        parent.remove(element)
    return f"delete {_called(element)}"


def delete_carrier(root: XmlElement, random: Random) -> str | None:
    """Delete a text that only we read, but that of the document."""
    texts = [each for each in root.iterfind("custom/text") if each.get("name") != "twinform:document"]
    text = _pick(texts, random)
    return None if text is None else _delete(text)


def add_geom(root: XmlElement, random: Random) -> str | None:
    """Add a shape to a body."""
    body = _pick(_elements(root, "body"), random)
    if body is None:
        return None
    seen = random.random() < 0.5
    touch = {"contype": "0", "conaffinity": "0", "group": "2", "density": "0"} if seen else {"group": "3"}
    name = f"added_{random.randrange(10**6)}"
    etree.SubElement(body, "geom", {"name": name, "type": "sphere", "size": "0.125", "pos": "0 0 0.5", **touch})
    return f"add a {'visual' if seen else 'collision'} to {_called(body)}"


def add_body(root: XmlElement, random: Random) -> str | None:
    """Add a body with a mass, with or without a joint."""
    body = _pick(_elements(root, "body"), random)
    if body is None:
        return None
    number = random.randrange(10**6)
    added = etree.SubElement(body, "body", {"name": f"added_body_{number}", "pos": "0.1 0.2 0.3"})
    etree.SubElement(added, "inertial", {"pos": "0 0 0.1", "mass": "0.5", "diaginertia": "0.01 0.01 0.01"})
    if random.random() < 0.6:
        kind = random.choice(("hinge", "slide"))
        etree.SubElement(added, "joint", {"name": f"added_joint_{number}", "type": kind, "axis": "0 1 0"})
    return f"add a body to {_called(body)}"


def add_joint_attribute(root: XmlElement, random: Random) -> str | None:
    """Give a joint damping, friction, or a range where it has none."""
    joint = _pick([each for each in _elements(root, "joint") if each.get("type") in {"hinge", "slide"}], random)
    if joint is None:
        return None
    name, value = random.choice((("damping", "0.75"), ("frictionloss", "0.25"), ("range", "-0.5 0.75")))
    joint.set(name, value)
    if name == "range":
        joint.set("limited", "true")
    return f"set {name} of {_called(joint)}"


def reorder(root: XmlElement, random: Random) -> str | None:
    """Put the first child body of a body behind its others."""
    bodies = [each for each in _elements(root, "body") if len(each.findall("body")) > 1]
    body = _pick(bodies, random)
    if body is None:
        return None
    first = body.findall("body")[0]
    body.append(first)
    return f"move {_called(first)} behind its siblings"


KINDS: tuple[tuple[int, Draw], ...] = (
    (10, change_number),
    (3, rename_everywhere),
    (2, rename_outside_carriers),
    (3, delete_attribute),
    (1, delete_range),
    (2, delete_shape),
    (1, delete_joint),
    (2, delete_leaf),
    (2, delete_carrier),
    (2, add_geom),
    (2, add_body),
    (3, add_joint_attribute),
    (1, reorder),
)
"""How often each kind is drawn, and what draws it."""
