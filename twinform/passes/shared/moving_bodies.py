"""Rigid bodies, the links that fixed joints hold together, and which of them and of the models can move."""

from collections.abc import Iterable, Iterator
from typing import NamedTuple

from twinform.ir import Document, Joint, Link, Model
from twinform.ir.groups import Groups
from twinform.ir.scopes import outer_models

# Both formats call what never moves `world`: SDF as the end of a joint, URDF as a root link.
_GROUND = "world"


Body = tuple[Link, ...]
"""The links that fixed joints hold together, in document order."""


class ConnectedBodies(NamedTuple):
    """A joint that moves, and the two bodies that it connects."""

    joint: Joint
    parent: Body
    child: Body


def movable_models(document: Document) -> Iterator[Model]:
    """Every model that is not static, nor in a static one; nested ones after those around them."""
    models = [*outer_models(document)]
    for model in models:  # grows while it is walked
        if not model.static:
            yield model
            models.extend(model.models)


def moving_bodies(document: Document) -> list[Body]:
    """The links that fixed joints hold together, for each body that is not held by the world, in document order."""
    bodies, ground, _ = _grouped(document)
    return [tuple(body) for root, body in bodies.items() if root != ground]


def neighbors(document: Document) -> Iterator[ConnectedBodies]:
    """The joints that move a body, in document order, with the bodies; the parent is empty for the world."""
    grouped, ground, groups = _grouped(document)
    bodies: dict[str, Body] = {root: tuple(body) for root, body in grouped.items()}
    for joint, scope in _joints(document):
        if joint.type == "fixed" or not joint.parent or not joint.child:
            continue
        parent, child = (groups.find(_key(scope, name)) for name in (joint.parent, joint.child))
        if child != ground and child in bodies and (parent == ground or parent in bodies):
            yield ConnectedBodies(joint, () if parent == ground else bodies[parent], bodies[child])


def _grouped(document: Document) -> tuple[dict[str, list[Link]], str, Groups]:
    """The links of each body by the key of the body, the key of the body fixed to the world, and the groups."""
    groups, links = Groups(), dict[str, Link]()
    for model in document.models:
        _collect(model, "", groups, links, static=False)
    for world in document.worlds:
        for model in world.models:
            _collect(model, "", groups, links, static=False)
        _join_fixed(world.joints, "", groups)
    bodies: dict[str, list[Link]] = {}
    for name, link in links.items():
        bodies.setdefault(groups.find(name), []).append(link)
    return bodies, groups.find(_GROUND), groups


def _joints(document: Document) -> Iterator[tuple[Joint, str]]:
    """Every joint, and the scope of the names in it."""
    for world in document.worlds:
        yield from ((joint, "") for joint in world.joints)
    models = [(model, "") for model in outer_models(document)]
    for model, scope in models:  # grows while it is walked, so that nothing recurses
        inside = f"{scope}{model.name}::"
        yield from ((joint, inside) for joint in model.joints)
        models.extend((nested, inside) for nested in model.models)


def _collect(model: Model, scope: str, groups: Groups, links: dict[str, Link], *, static: bool) -> None:
    """Add the links of a model by their scoped names, and join those that cannot move apart."""
    outside, inside = f"{scope}{model.name}", f"{scope}{model.name}::"
    static = static or bool(model.static)
    for link in model.links:
        key = _key(inside, link.name)
        links[key] = link
        if static:
            groups.join(_GROUND, key)
    for nested in model.models:
        _collect(nested, inside, groups, links, static=static)
    # A model's frame moves with its canonical link, so what is attached to the frame is in the same
    # body.
    groups.join(f"{inside}__model__", outside)
    canonical = model.canonical_link or next((part.name for part in (*model.links, *model.models)), None)
    if canonical is not None:
        groups.join(_key(inside, canonical), outside)
    for frame in model.frames:
        groups.join(_key(inside, frame.attached_to or "__model__"), _key(inside, frame.name))
    _join_fixed(model.joints, inside, groups)


def _join_fixed(joints: Iterable[Joint], scope: str, groups: Groups) -> None:
    for joint in joints:
        if joint.type == "fixed" and joint.parent and joint.child:
            groups.join(_key(scope, joint.parent), _key(scope, joint.child))


def _key(scope: str, name: str) -> str:
    return _GROUND if name == _GROUND else f"{scope}{name}"
