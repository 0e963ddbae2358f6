"""Masses and inertias that are not written: nothing in URDF, and 1 kg with 1 kg m^2 in SDF; and the root of a URDF."""

from collections import defaultdict
from typing import ClassVar

from twinform.diagnostics import DiagnosticSink, Fate, rules
from twinform.ir import Format, Inertia, Inertial, Link, Model, replace_fields
from twinform.ir.solids import with_written_defaults
from twinform.passes.carriers.annotations import came_from, with_annotation
from twinform.passes.carriers.token_mass import MOMENTS, TOKEN, TOKEN_MASS, TOKEN_MOMENT, UNSAID
from twinform.passes.framework.pass_base import ModelPass
from twinform.passes.legalise.frame_links import is_massless
from twinform.passes.legalise.to_urdf_pass import ToUrdfPass, UrdfKeeper

_NO_INERTIA = Inertia.unchecked(ixx=0.0, ixy=0.0, ixz=0.0, iyy=0.0, iyz=0.0, izz=0.0)
_NONE = Inertial.unchecked(mass=0.0, inertia=_NO_INERTIA)

# With a mass of zero, DART aborts where such a link moves and carries nothing, Bullet holds the
# whole robot by its root in the air, and libsdformat drops the link from URDF with everything below
# it. From 1e-12 kg and 1e-14 kg m^2 on, all of 69 corpus robots that DART aborted on came through
# in gz-physics 5; the rover falls in Bullet, and moves in DART as the lumped one to 1e-5.
_MASS = ("mass", f"{TOKEN_MASS:g} kg")
_INERTIA = ("inertia", f"{TOKEN_MOMENT:g} kg m^2")


class UrdfBodies(ModelPass):
    """Write out what URDF means by saying nothing about a link's mass, and name the root.

    Changes: 1. a link without mass gets a token of 1e-12 kg, one without inertia 1e-14 kg m^2: engines abort without,
    or hold it; 2. in a static model they get zeros, where SDF would give them 1 kg and 1 kg m^2; 3. `canonical_link`
    names the root where another link comes first.
    Never touches: mass and inertia that are written and not zero.
    Diagnostics: `massless-link` for a link that moves although nothing fixed to it has mass; the ledger has each token.
    """

    name: ClassVar[str] = "urdf-bodies"
    carriers: bool = True

    def run_model(self, model: Model, sink: DiagnosticSink) -> Model:
        """The model with a mass for every link."""
        self._report_massless(model, sink)
        links = tuple(self._body(link, model, sink) for link in model.links)
        children = {joint.child for joint in model.joints}
        root = next((link.name for link in links if link.name not in children), None)
        update: dict[str, object] = {"links": links}
        usual = came_from(model, Format.SDF) or (links and links[0].name == root)
        if root is not None and not usual and model.canonical_link is None:
            update["canonical_link"] = root
        return model.copy(**update)

    def _body(self, link: Link, model: Model, sink: DiagnosticSink) -> Link:
        if model.static:
            return _with_inertial(link, carriers=self.carriers)
        lacks = [*(_MASS if _has_no_mass(link) else ()), *(_INERTIA if _has_no_inertia(link) else ())]
        if not lacks:
            return link
        # the source has nothing of it, or an annotation has it
        message = f"link {link.name!r} has no {' or '.join(lacks[::2])}, and gets {' and '.join(lacks[1::2])}"
        where = link.inertial.location if link.inertial else link.location.at("inertial")
        sink.account(Fate.APPROXIMATED, rules.TINY_MASS, message, where, weight=0)
        return _with_token(link, carriers=self.carriers)

    def _report_massless(self, model: Model, sink: DiagnosticSink) -> None:
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
                sink.report(rules.MASSLESS_LINK, message, link.location)


def _has_no_mass(link: Link) -> bool:
    inertial = link.inertial or Inertial.unchecked()
    return not inertial.auto and not inertial.mass


def _has_no_inertia(link: Link) -> bool:
    inertial = link.inertial or Inertial.unchecked()
    moments = [getattr(inertial.inertia, name) for name in MOMENTS] if inertial.inertia else []
    return not inertial.auto and not any(moments)


def _with_token(link: Link, *, carriers: bool) -> Link:
    """A link with a token of the mass and the inertia that it does not have."""
    written = link.inertial
    if written is None:
        return link.copy(inertial=with_annotation(TOKEN, UNSAID, "inertial") if carriers else TOKEN)
    update: dict[str, object] = {}
    words: list[str] = []
    if _has_no_mass(link):
        update["mass"] = TOKEN.mass
        words.append("mass" if written.mass is None else "zero-mass")
    if _has_no_inertia(link):
        update["inertia"] = TOKEN.inertia
        words.append("inertia" if written.inertia is None else "zero-inertia")
    made = written.copy(**update)
    return link.copy(inertial=with_annotation(made, UNSAID, " ".join(words)) if carriers else made)


def _with_inertial(link: Link, *, carriers: bool) -> Link:
    inertial = link.inertial
    if inertial is None:
        return link.copy(inertial=_NONE)
    if inertial.auto:
        return link
    missing: dict[str, object] = {}
    if inertial.mass is None:
        missing["mass"] = 0.0
    if inertial.inertia is None:
        missing["inertia"] = _NO_INERTIA
    if not missing:
        return link
    made = inertial.copy(**missing)
    return link.copy(inertial=with_annotation(made, UNSAID, " ".join(missing)) if carriers else made)


def _reaches(start: str, edges: dict[str, list[str]], goal: set[str]) -> bool:
    stack, seen = [start], {start}
    while stack:
        name = stack.pop()
        if name in goal:
            return True
        stack.extend(new for new in edges.get(name, ()) if new not in seen)
        seen.update(edges.get(name, ()))
    return False


class FillInertials(ToUrdfPass):
    """Write the mass and inertia that SDF gives to every link without them.

    Changes: a missing mass is 1 kg, a missing `ixx`, `iyy`, `izz` 1 kg m^2 and a missing product of inertia 0. These
    are the values that every reader of SDF takes; a reader of URDF would take none.
    Diagnostics: none.
    """

    name: ClassVar[str] = "fill-inertials"

    def run_model(self, model: Model, keeper: UrdfKeeper) -> Model:
        """The model with an inertial in every link."""
        return model.copy(links=tuple(map(_fill_link, model.links)))


def _fill_link(link: Link) -> Link:
    # A link without <inertial> weighs 1 kg in SDF (the specification, and every reader) and nothing
    # in URDF.
    return replace_fields(link, inertial=with_written_defaults(link.inertial))
