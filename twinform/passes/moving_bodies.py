"""Which links are one rigid body, and which of these bodies move."""

from collections.abc import Iterable

from twinform.ir import Document, Joint, Link, Model

_GROUND = "world"
"""What both formats call the thing that never moves: SDF as the end of a joint, URDF as a root link."""


def moving_bodies(document: Document) -> list[tuple[Link, ...]]:
    """The links that fixed joints hold together, for each body that is not held by the world, in document order."""
    groups, links = _Groups(), dict[str, Link]()
    for model in document.models:
        _collect(model, "", groups, links, static=False)
    for world in document.worlds:
        for model in world.models:
            _collect(model, "", groups, links, static=False)
        _join_fixed(world.joints, "", groups)
    ground = groups.find(_GROUND)
    bodies: dict[str, list[Link]] = {}
    for name, link in links.items():
        root = groups.find(name)
        if root != ground:
            bodies.setdefault(root, []).append(link)
    return [tuple(body) for body in bodies.values()]


def _collect(model: Model, scope: str, groups: "_Groups", links: dict[str, Link], *, static: bool) -> None:
    """Enter a model's links by their scoped names, and join what cannot move apart."""
    outside, inside = f"{scope}{model.name}", f"{scope}{model.name}::"
    static = static or bool(model.static)
    for link in model.links:
        key = _key(inside, link.name)
        links[key] = link
        if static:
            groups.join(_GROUND, key)
    for nested in model.models:
        _collect(nested, inside, groups, links, static=static)
    groups.join(f"{inside}__model__", outside)
    canonical = model.canonical_link or next((part.name for part in (*model.links, *model.models)), None)
    if canonical is not None:
        groups.join(_key(inside, canonical), outside)
    for frame in model.frames:
        groups.join(_key(inside, frame.attached_to or "__model__"), _key(inside, frame.name))
    _join_fixed(model.joints, inside, groups)


def _join_fixed(joints: Iterable[Joint], scope: str, groups: "_Groups") -> None:
    for joint in joints:
        if joint.type == "fixed" and joint.parent and joint.child:
            groups.join(_key(scope, joint.parent), _key(scope, joint.child))


def _key(scope: str, name: str) -> str:
    return _GROUND if name == _GROUND else f"{scope}{name}"


class _Groups:
    """Disjoint sets of names."""

    def __init__(self) -> None:
        self._up: dict[str, str] = {}

    def find(self, name: str) -> str:
        """The name that stands for the set; paths are halved on the way, so that long chains stay cheap."""
        up = self._up
        while (above := up.setdefault(name, name)) != name:
            up[name] = up[above]
            name = above
        return name

    def join(self, one: str, other: str) -> None:
        self._up[self.find(other)] = self.find(one)
