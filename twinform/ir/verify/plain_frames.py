"""Whether the frames of a model are sound at first sight, as nearly always: then nobody builds their graph."""

from collections.abc import Mapping

from twinform.ir.frames import MODEL, base_of
from twinform.ir.model import Model

_NOTHING = ""


def has_plain_frames(model: Model) -> bool:
    """Whether every pose and body leads to the model or a link of it, and every joint connects two links.

    False says nothing: names may be there twice or be those of other models, which only a `FrameGraph` can tell.
    """
    # A graph of all frames was built only to find circles, and nearly every model is a tree at
    # first sight.
    if model.models or model.includes or model.placement_frame:
        return False
    bases: dict[str, str] = {MODEL: _NOTHING}
    bodies: dict[str, str] = {MODEL: _NOTHING}
    for link in model.links:
        bases[link.name], bodies[link.name] = base_of(link.pose, MODEL), _NOTHING
    for joint in model.joints:
        child = joint.child or MODEL
        if bodies.get(child) is not _NOTHING or bodies.get(joint.parent or "") is not _NOTHING:
            return False
        bases[joint.name] = base_of(joint.pose, child)
    for frame in model.frames:
        holder = frame.attached_to or MODEL
        bases[frame.name], bodies[frame.name] = base_of(frame.pose, holder), holder
    count = 1 + len(model.links) + len(model.joints) + len(model.frames)
    return len(bases) == count and _lead_somewhere(bases) and _lead_somewhere(bodies)


def _lead_somewhere(edges: Mapping[str, str]) -> bool:
    """Whether no way ends at an unknown name or goes round in a circle."""
    visited: dict[str, int] = {_NOTHING: -1}
    for number, start in enumerate(edges):
        name, steps = start, 0
        while name not in visited:
            visited[name], steps = number, steps + 1
            if name not in edges:
                return False
            name = edges[name]
        if steps and visited[name] == number:
            return False
    return True
