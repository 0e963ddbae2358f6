"""Static models in a model that an edit of the URDF has set free."""

from collections.abc import Set as AbstractSet
from typing import ClassVar

from twinform.diagnostics import DiagnosticSink
from twinform.diagnostics.rules import STALE_CARRIER
from twinform.ir import Element, Link, Model, Opaque
from twinform.ir.frames import WORLD
from twinform.passes.carriers.annotations import find_annotation, is_annotation
from twinform.passes.framework.pass_base import ModelPass
from twinform.passes.legalise.changed_names import scoped_name, scopes_in
from twinform.passes.legalise.free_links import is_static
from twinform.passes.shared.poses import NESTED


class FreeStaticModels(ModelPass):
    """Let go of the static models of SDF that the URDF does not hold to the world.

    Changes: the annotation of a nested model says no more that it is static, if one of its links hangs from something
    else than the world or one of its own, by a joint that moves or by none.
    Never touches: nested models in a static one.
    Diagnostics: `stale-carrier`.
    """

    name: ClassVar[str] = "free-static-models"

    def run_model(self, model: Model, sink: DiagnosticSink) -> Model:
        """The model whose nested static models are held."""
        static = [link for link in model.links if is_static(find_annotation(link, NESTED))]
        if not static or model.static:
            return model
        free = _free_models(model, frozenset(map(scoped_name, static)))
        for link in static:
            if scoped_name(link) in free:
                message = f"model {scoped_name(link)!r} is not static any more: the joints of the URDF let it move"
                sink.report(STALE_CARRIER, message, link.location, found=link.name)
        links = tuple(_without_static(link) if scoped_name(link) in free else link for link in model.links)
        return model.copy(links=links)


def _free_models(model: Model, static: AbstractSet[str]) -> AbstractSet[str]:
    """Return the static nested models that have a link which neither the world nor the model itself holds."""
    above = {joint.child: joint for joint in model.joints}
    names = {link.name: scoped_name(link) for link in model.links}
    free = set[str]()
    for link, scoped in names.items():
        joint = above.get(link)
        if joint is None or joint.type != "fixed" or joint.parent != WORLD:
            # A joint between two links of one model is its own affair, so only the models that the
            # parent is not in are let go.
            free |= (scopes_in(scoped) & static) - scopes_in(names.get((joint and joint.parent) or "", ""))
    return free


def _without_static(link: Link) -> Link:
    opaque = tuple(_without_static_element(part) if is_annotation(part, NESTED) else part for part in link.opaque)
    return link.copy(opaque=opaque)


def _without_static_element(part: Opaque) -> Opaque:
    element = part.element or Element.unchecked(name="")
    children = tuple(child for child in element.children if child.name != "static")
    return part.copy(element=element.copy(children=children))
