"""Writing what all visuals of a link share, and URDF lacks, as one `<visual>` in a `<gazebo>` element."""

from collections.abc import Iterator
from functools import cache
from typing import Any, ClassVar

from twinform.ir import Element, GazeboExtension, Link, Material, Model, Visual, replace_fields
from twinform.ir.record import field_values
from twinform.passes.carriers.annotations import without_annotation
from twinform.passes.carriers.carriers import to_element
from twinform.passes.legalise.changed_names import LOOK, look_of
from twinform.passes.legalise.to_urdf.remainder import KnownFields, fits, take_remainder, urdf_fields
from twinform.passes.legalise.to_urdf_pass import ToUrdfPass, UrdfKeeper
from twinform.passes.shared.gazebo_tags import LINK_TAGS
from twinform.request_options import UrdfVersion

_COLORS = ("ambient", "diffuse")
_OF_MATERIALS = frozenset({"material"})
_IN_FRAMES = frozenset({"pose", "geometry"})


class ShareVisuals(ToUrdfPass):
    """Say by a `<visual>` in a `<gazebo>` element what all visuals of a link have alike.

    Changes: 1. plugins, transparency, shadows and the like of all visuals of a link, which Gazebo puts into each of
    them; 2. what a conversion from URDF found there of their materials.
    Never touches: what differs between them, and other parts of a material, in place of which Gazebo would put these.
    Diagnostics: none.
    """

    name: ClassVar[str] = "share-visuals"
    urdf_version: UrdfVersion = "1.0"

    def run_model(self, model: Model, keeper: UrdfKeeper) -> Model:
        """The model with shared parts of visuals in extensions."""
        links: list[Link] = []
        extensions = list(model.extensions)
        for link in model.links:
            kept, content = _share_parts(link, self.urdf_version)
            links.append(kept)
            if content:
                blob = Element.unchecked(name="visual", children=tuple(content))
                extensions.append(GazeboExtension.unchecked(reference=link.name, content=(blob,), source=link.source))
        return replace_fields(model, links=tuple(links), extensions=tuple(extensions))


def _share_parts(link: Link, version: UrdfVersion) -> tuple[Link, list[Element]]:
    """The link without the parts that all of its visuals share, and these parts."""
    look = look_of(link)
    link = without_annotation(link, LOOK)
    if not link.visuals:
        return link, []
    content: list[Element] = []
    visuals = link.visuals
    shared = _shared_look(visuals, look)
    if shared is not None:
        content += to_element(Visual.unchecked(name="", material=shared), "visual", "sdf").children
        visuals = tuple(_without_look(visual, look) for visual in visuals)
    parts = [_parts_beside_material(visual, version) for visual in visuals]
    if parts[0] and all(part == parts[0] for part in parts[1:]):
        content += parts[0]
        visuals = tuple(_without_rest(visual, version) for visual in visuals)
    return replace_fields(link, visuals=visuals), content


def _shared_look(visuals: tuple[Visual, ...], look: tuple[str, ...]) -> Material | None:
    """The material that all visuals share in the fields of `look`; None where they differ."""
    if not look:
        return None
    materials = [_with_only(visual.material, look) for visual in visuals]
    return (
        materials[0]
        if materials[0] != Material.unchecked() and all(one == materials[0] for one in materials[1:])
        else None
    )


def _with_only(material: Material | None, look: tuple[str, ...]) -> Material:
    return Material.unchecked(**{name: value for name, value in _written_fields(material) if name in look})


def _without_look(visual: Visual, look: tuple[str, ...]) -> Visual:
    """The visual without the fields of `look`; one color then counts for both, as in URDF."""
    rest = {name: value for name, value in _written_fields(visual.material) if name not in look}
    color = rest.get("diffuse") or rest.get("ambient")
    rest |= {name: color for name in _COLORS if color is not None and name in look}
    material = visual.material and Material.unchecked(**rest, source=visual.material.source)
    return visual.copy(material=None if not rest else material)


def _written_fields(material: Material | None) -> Iterator[tuple[str, Any]]:
    """The names and values of the fields that are set in a material."""
    for name, value in field_values(material).items() if material else ():
        if value not in (None, ()):
            yield name, value


def _parts_beside_material(visual: Visual, version: UrdfVersion) -> tuple[Element, ...]:
    """The elements of a visual that URDF lacks, besides the material."""
    if fits(visual, _fields_of_visual(version)):
        return ()
    bare = visual.copy(material=None, pose=None, geometry=None)
    _, pieces, _ = take_remainder(bare, "visual", urdf_fields(version, "link", "visual"))
    elements = tuple(piece.element for piece in pieces if piece.element and not piece.at)
    if len(elements) != len(pieces) or any(_is_special(element) for element in elements):
        return ()
    return elements


@cache
def _fields_of_visual(version: UrdfVersion) -> KnownFields:
    """The fields of a visual in URDF; the content of material, pose and geometry counts as known."""
    return KnownFields({**urdf_fields(version, "link", "visual"), **dict.fromkeys(("material", "pose", "geometry"))})


def _is_special(element: Element) -> bool:
    """Whether an element in an extension would be read as something else."""
    return element.name.startswith("{") or element.name in LINK_TAGS or element.name in _OF_MATERIALS | _IN_FRAMES


def _without_rest(visual: Visual, version: UrdfVersion) -> Visual:
    bare = visual.copy(material=None)
    kept, _, _ = take_remainder(bare, "visual", urdf_fields(version, "link", "visual"))
    return kept.copy(material=visual.material)
