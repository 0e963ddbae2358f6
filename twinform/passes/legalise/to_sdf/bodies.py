"""Mass, and where the tree begins."""

from collections import defaultdict
from typing import ClassVar

from twinform.diagnostics import Notes
from twinform.diagnostics.rules import to_sdf
from twinform.ir import Format, Inertia, Inertial, Link, Model
from twinform.passes.legalise.marks import with_mark
from twinform.passes.legalise.model_pass import ModelPass
from twinform.passes.legalise.provenance import came_from
from twinform.passes.legalise.to_sdf.frame_links import is_massless

_NO_INERTIA = Inertia(ixx=0.0, ixy=0.0, ixz=0.0, iyy=0.0, iyz=0.0, izz=0.0)
_NONE = Inertial(mass=0.0, inertia=_NO_INERTIA)

UNSAID = "unsaid"
"""The mark on an inertial of SDF that lists what URDF leaves out: `<tf:unsaid>inertia</tf:unsaid>`."""


class UrdfBodies(ModelPass):
    """Write out what URDF means by saying nothing about a link's mass, and name the root.

    Changes: 1. a link without inertial, mass or inertia gets one of zero: SDF would give it 1 kg or 1 kg m^2; 2.
    `canonical_link` names the root where another link comes first.
    Never touches: an inertial that is written.
    Diagnostics: `massless-link` for a link that moves although nothing fixed to it has mass.
    """

    name: ClassVar[str] = "urdf-bodies"
    carriers: bool = True

    def run_model(self, model: Model, notes: Notes) -> Model:
        """The model with a mass for every link."""
        self._report_massless(model, notes)
        links = tuple(_with_inertial(link, carriers=self.carriers) for link in model.links)
        children = {joint.child for joint in model.joints}
        root = next((link.name for link in links if link.name not in children), None)
        update: dict[str, object] = {"links": links}
        usual = came_from(model, Format.SDF) or (links and links[0].name == root)
        if root is not None and not usual and model.canonical_link is None:
            update["canonical_link"] = root
        return model.model_copy(update=update)

    def _report_massless(self, model: Model, notes: Notes) -> None:
        """A link that moves, and to which only massless links are fixed."""
        if model.static:
            return
        massive = {link.name for link in model.links if not is_massless(link)}
        fixed: dict[str, list[str]] = defaultdict(list)
        for joint in model.joints:
            if joint.type == "fixed":
                fixed[joint.parent or ""].append(joint.child or "")
        moved = {joint.child for joint in model.joints if joint.type != "fixed"}
        for link in model.links:
            if link.name in moved and not _reaches(link.name, fixed, massive):
                message = f"link {link.name!r} moves but has no mass, nor has anything fixed to it"
                notes.report(to_sdf.MASSLESS_LINK, message, link.location)


def _with_inertial(link: Link, *, carriers: bool) -> Link:
    inertial = link.inertial
    if inertial is None:
        return link.model_copy(update={"inertial": _NONE})
    if inertial.auto:
        return link
    missing: dict[str, object] = {}
    if inertial.mass is None:
        missing["mass"] = 0.0
    if inertial.inertia is None:
        missing["inertia"] = _NO_INERTIA
    if not missing:
        return link
    made = inertial.model_copy(update=missing)
    return link.model_copy(update={"inertial": with_mark(made, UNSAID, " ".join(missing)) if carriers else made})


def _reaches(start: str, edges: dict[str, list[str]], goal: set[str]) -> bool:
    stack, seen = [start], {start}
    while stack:
        name = stack.pop()
        if name in goal:
            return True
        stack.extend(new for new in edges.get(name, ()) if new not in seen)
        seen.update(edges.get(name, ()))
    return False
