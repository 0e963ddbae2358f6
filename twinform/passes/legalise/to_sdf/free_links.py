"""Links that need no joint in SDF: those that are free, and those in static models."""

from twinform.ir import Element, Joint, Model
from twinform.ir.frames import WORLD
from twinform.passes.carriers.annotations import find_annotation, is_synthesized
from twinform.passes.legalise.names import scoped_name
from twinform.passes.transforms.notation import NESTED


def links_in_static_models(model: Model) -> frozenset[str]:
    """The links of a model that is static, or of the static models that it has in SDF."""
    if model.static:
        return frozenset(link.name for link in model.links)
    frames = (*model.links, *model.frames)  # a frame of SDF is a link at first
    scopes = tuple(f"{scoped_name(frame)}::" for frame in frames if _is_static(find_annotation(frame, NESTED)))
    return frozenset(link.name for link in model.links if scoped_name(link).startswith(scopes))


def needs_no_joint(joint: Joint, held: frozenset[str]) -> bool:
    """Whether SDF has no joint here; `held` are the links that are where they are, fixed to the world or not."""
    if joint.type == "floating":
        return True
    return joint.type == "fixed" and joint.parent == WORLD and joint.child in held and is_synthesized(joint)


def _is_static(nested: Element | None) -> bool:
    static = nested.find("static") if nested else None
    return static is not None and (static.text or "").strip() in {"true", "1"}
