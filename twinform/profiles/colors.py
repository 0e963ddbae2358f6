"""Facts about materials and the colors of visuals: where a name is defined, and whether it can be painted."""

from collections.abc import Iterator

from twinform.profiles.forms import FORMS, fits_bytes
from twinform.profiles.nodes import Fact, FactTable, RawNode

_EQUAL_COLORS = 1e-10


def _visual_materials(root: RawNode) -> Iterator[RawNode]:
    materials = (visual.first("material") for visual in root.all("link", "visual"))
    return (material for material in materials if material is not None)


def _uncolored_materials(root: RawNode) -> Fact:
    """Materials that are only a name, where no material before has this name."""
    known = set[str]()
    for material in (*root.all("material"), *_visual_materials(root)):
        name = material.name
        plain = material.first("color") is None and not material.value("texture", "filename")
        if plain and name and name not in known:
            yield material, f"material {name!r} has no color, and none before has this name"
        known.add(name)


def _recolored_materials(root: RawNode) -> Fact:
    known: dict[str, str | None] = {}
    for material in (*root.all("material"), *_visual_materials(root)):
        name, color = material.name, material.value("color", "rgba")
        if not name or (color is None and name in known):
            continue
        before = known.setdefault(name, color)
        if not _same_color(before or "0 0 0 0", color or "0 0 0 0"):
            yield material, f"material {name!r} has another color before"


def _strange_used_colors(root: RawNode) -> Fact:
    """Colors of the robot that are not from 0 to 1 and that a visual uses by their names."""
    colors = {node.name: node.value("color", "rgba") for node in root.all("material")}
    for material in _visual_materials(root):
        rgba = colors.get(material.name)
        if rgba is not None and material.first("color") is None and not FORMS["share"][1](rgba):
            yield material, f"the color of a visual is {rgba!r}"


def _unread_colors(root: RawNode) -> Fact:
    """Colors that are not four numbers, of the first material of each name that has a color."""
    known, waiting = set[str](), [root]
    while waiting:
        node = waiting.pop()
        waiting += reversed(node.children)
        name = node.attributes.get("name")
        color = node.first("color") if node.tag == "material" and name not in known else None
        if color is not None and name is not None:
            known.add(name)
            rgba = color.attributes.get("rgba", "")
            if not FORMS["strtods4+"][1](rgba) or len(list(node.all("color"))) > 1:
                yield color, f"the color of material {name!r} is {rgba!r}, or there are several"


def _same_color(one: str, other: str) -> bool:
    try:
        pairs = zip(map(float, one.split()), map(float, other.split()), strict=True)
        return all(abs(first - second) <= _EQUAL_COLORS for first, second in pairs)
    except ValueError:
        return True


def _nameless_colors(root: RawNode) -> Fact:
    for material in _visual_materials(root):
        if material.first("color") is None and "name" not in material.attributes:
            yield material, "a <material> has no name and no color"


def _undefined_materials(root: RawNode) -> Fact:
    known = {node.name for node in root.all("material")}
    for visual in root.all("link", "visual"):
        material = visual.first("material")
        if material is None or not (name := material.name):
            continue
        if material.value("color", "rgba") is None and material.value("texture", "filename") is None:
            if name not in known:
                yield material, f"material {name!r} is defined nowhere before"
        else:
            known.add(name)


def _nowhere_materials(root: RawNode) -> Fact:
    """Materials that are only a name and are defined neither before nor after."""
    named = [*root.all("material"), *(each for each in _visual_materials(root) if _has_appearance(each))]
    known = {node.name for node in named}
    for material in _visual_materials(root):
        name = material.name
        if name and name not in known and not _has_appearance(material):
            yield material, f"material {name!r} is defined nowhere"


def _has_appearance(material: RawNode) -> bool:
    return material.first("color") is not None or material.first("texture") is not None


def _plain_materials(root: RawNode) -> Fact:
    for material in root.all("material"):
        if material.value("color", "rgba") is None and material.value("texture", "filename") is None:
            yield material, f"material {material.name!r} has no color and no texture"


def _unpaintable_colors(root: RawNode) -> Fact:
    """Colors of visuals, their own or by name, that do not fit into bytes."""
    known = {node.name: node for node in root.all("material")}
    for visual in root.all("link", "visual"):
        material = visual.first("material")
        if material is not None and material.first("color") is None:
            material = known.get(material.name)
        color = None if material is None else material.first("color")
        if color is not None and not fits_bytes(rgba := color.attributes.get("rgba", "1 1 1 1")):
            yield color, f"the color of a visual is {rgba!r}"


def _flat_painted_boxes(root: RawNode) -> Fact:
    """Boxes with a color, their own or by name, and a size that is not three numbers."""
    known = {node.name for node in root.all("material") if node.first("color") is not None}
    for visual in root.all("link", "visual"):
        material, geometry = visual.first("material"), visual.first("geometry")
        box = geometry.children[0] if geometry is not None and geometry.children else None
        if material is None or box is None or box.tag != "box" or FORMS["commas3"][1](box.attributes.get("size", "")):
            continue
        if material.first("color") is not None or material.name in known:
            yield box, f"the size of a box with a color is {box.attributes.get('size', '')!r}"


FACTS: FactTable = {
    "strange-used-color": _strange_used_colors,
    "unread-color": _unread_colors,
    "uncolored": _uncolored_materials,
    "recolored": _recolored_materials,
    "nameless-color": _nameless_colors,
    "nowhere-material": _nowhere_materials,
    "undefined-material": _undefined_materials,
    "plain-material": _plain_materials,
    "unpaintable": _unpaintable_colors,
    "flat-painted-box": _flat_painted_boxes,
}
