"""From the facts about a stage to a document: a model of SDF for each articulation, as the joints place it at zero.

USD writes where bodies are at the moment, and the joints say where they are at zero, which is what URDF and SDF write.
So bodies that hang on joints are placed by these, and only the others by their own transforms.
"""

from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator, Mapping

from twinform.compiler.usd.joints import StageJoint, joint_of, joints_of
from twinform.compiler.usd.shapes import collisions_of
from twinform.compiler.usd.stage import Prim, Stage, paths_up, scaled
from twinform.compiler.usd.written_names import WrittenNames
from twinform.ir import Collision, Document, Format, Frame, Inertia, Inertial, Joint, Link, Model, Pose
from twinform.ir.transform import Transform
from twinform.passes.legalise.to_sdf.joint_types import planar_chain, planar_names
from twinform.schemas import versions_of

_ROOT = "PhysicsArticulationRootAPI"


def build_document(stage: Stage, known: frozenset[str] | None = None, *, apart: bool = False) -> Document:
    """Build the document of a stage, with a model for each articulation, that with the most links first.

    Transforms are frames where their names are `known`, or where nothing is. Articulations with known names are one
    model, such as a robot of two arms, unless they are wanted `apart`.
    """
    joints = sorted(joints_of(stage), key=lambda each: each.is_loop)  # of several joints of a link, the first holds it
    shapes = defaultdict[str, list[Collision]](list)
    for body, collision in collisions_of(stage):
        shapes[body].append(collision)
    groups = sorted(_articulations(stage, joints), key=len, reverse=True)
    written = WrittenNames(known)
    groups = groups if apart else _together(stage, groups, written)
    holders = _holders(stage, groups)
    models = (
        _model(stage, holder, group, joints, shapes, written) for holder, group in zip(holders, groups, strict=True)
    )
    return Document.unchecked(format=Format.SDF, version=versions_of("sdf")[-1], models=tuple(models))


def _articulations(stage: Stage, joints: Iterable[StageJoint]) -> list[list[str]]:
    """Group the bodies by joints and by what they are in: all are one model, unless there are several articulations."""
    bodies = [path for path in stage.prims if path in stage.bodies]
    if sum(prim.has(_ROOT) for prim in stage.prims.values()) <= 1:
        return [bodies] if bodies else []
    group_of = {body: [body] for body in bodies}
    pairs = [(joint.parent.body, joint.child.body) for joint in joints]
    pairs += [(stage.body_of(body.rpartition("/")[0]), body) for body in bodies]
    for pair in pairs:
        one, other = (group_of.get(body or "") for body in pair)
        if one is not None and other is not None and one is not other:
            large, small = (one, other) if len(one) >= len(other) else (other, one)
            large += small
            group_of |= dict.fromkeys(small, large)
    return [*{id(group): group for group in group_of.values()}.values()]


def _together(stage: Stage, groups: list[list[str]], written: WrittenNames) -> list[list[str]]:
    """Join the groups with known names that no larger one of them has."""
    joined, rest, seen = list[str](), list[list[str]](), set[str]()
    for group in groups:
        names = set(written.of(stage.prims[path] for path in group).values())
        if names & (written.known or set()) and not names & seen:
            joined += group
            seen |= names
        else:
            rest.append(group)
    return [joined, *rest] if joined else groups


def _holders(stage: Stage, groups: list[list[str]]) -> list[str]:
    """Return the path of the prim that each model is called by: the highest that holds no other model, or all."""
    if len(groups) == 1 and stage.default:
        return [stage.default]
    counts = Counter(path for group in groups for path in {above for body in group for above in paths_up(body)})
    ways = ([*paths_up(group[0])][::-1] for group in groups)
    return [next((path for path in way if counts[path] == 1), way[0]) for way in ways]


def _model(
    stage: Stage,
    holder: str,
    bodies: list[str],
    joints: Iterable[StageJoint],
    shapes: Mapping[str, list[Collision]],
    written: WrittenNames,
) -> Model:
    inside = frozenset(bodies)
    own = [joint for joint in joints if joint.child.body in inside]
    names = written.of([stage.prims[path] for path in bodies]) | written.of([joint.prim for joint in own])
    places = _places(stage, bodies, own)
    top = stage.prims[holder]
    base = top.place if holder not in inside else stage.root
    links = tuple(_link(stage, path, names, base.inverse().compose(places[path]), shapes[path]) for path in bodies)
    between, moving = _unfolded([joint_of(stage, joint, names) for joint in own], set(names.values()))
    return Model.unchecked(
        name=top.name,
        pose=base.to_pose() if base != Transform() else None,
        links=(*links, *between),
        joints=tuple(moving),
        frames=tuple(_frames(stage, holder, names, written)),
        source=top.source,
    )


def _unfolded(joints: Iterable[Joint], taken: set[str]) -> tuple[list[Link], list[Joint]]:
    """Return the joints with a chain for each planar one, as conversions from URDF make it, and the links in these."""
    links, found = list[Link](), list[Joint]()
    for joint in joints:
        chain = planar_chain(joint, planar_names(joint.name, taken)) if joint.type == "planar" else None
        links += chain.links if chain else ()
        found += chain.joints if chain else (joint,)
    return links, found


def _places(stage: Stage, bodies: Iterable[str], joints: Iterable[StageJoint]) -> dict[str, Transform]:
    """Return where the bodies are in the world when all joints are at zero."""
    below = defaultdict[str | None, list[StageJoint]](list)
    for joint in joints:
        below[joint.parent.body].append(joint)
    moved = {joint.child.body for joint in joints}
    places: dict[str, Transform] = {}

    def hang(top: str | None) -> None:
        waiting = [top]
        for parent in waiting:
            at = places[parent] if parent is not None else Transform()
            for joint in below[parent]:
                child = joint.child.body
                if child is not None and child not in places:
                    places[child] = at.compose(joint.parent.frame).compose(joint.child.frame.inverse())
                    waiting.append(child)

    hang(None)
    for path in sorted(bodies, key=lambda each: each in moved):  # what hangs on nothing, and then what hangs in circles
        if path not in places:
            places[path] = stage.prims[path].place
            hang(path)
    return places


def _link(stage: Stage, path: str, names: Mapping[str, str], place: Transform, collisions: Iterable[Collision]) -> Link:
    prim, shapes = stage.prims[path], tuple(collisions)
    return Link.unchecked(
        name=names[path],
        pose=place.to_pose(),
        inertial=_inertial(stage, prim, has_shapes=bool(shapes)),
        collisions=_with_own_names(shapes),
        source=prim.source,
    )


def _with_own_names(collisions: tuple[Collision, ...]) -> tuple[Collision, ...]:
    counts = Counter(each.name for each in collisions)
    numbered = enumerate(collisions)
    return tuple(each if counts[each.name] == 1 else each.copy(name=f"{each.name}_{at}") for at, each in numbered)


def _inertial(stage: Stage, prim: Prim, *, has_shapes: bool) -> Inertial:
    """Return mass and inertia as they are written; what is not is computed from the shapes, if there are any."""
    mass = prim.number("physics:mass") or 0.0
    if not mass and has_shapes:
        return Inertial.unchecked(auto=True, source=prim.source)
    unit = stage.kilograms * stage.meters**2
    xx, yy, zz = scaled(prim.numbers("physics:diagonalInertia", (0.0, 0.0, 0.0)), (unit, unit, unit))
    w, x, y, z = prim.numbers("physics:principalAxes", (1.0, 0.0, 0.0, 0.0))
    center = prim.numbers("physics:centerOfMass", (0.0, 0.0, 0.0))
    is_written = all(abs(number) < _UNWRITTEN for number in center)
    return Inertial.unchecked(
        pose=Pose.unchecked(
            xyz=scaled(center, prim.scale) if is_written else None,
            quat_xyzw=(x, y, z, w) if (x, y, z, w) != (0.0,) * 4 else None,
            rotation_format="quat_xyzw",
        ),
        mass=mass * stage.kilograms,
        inertia=Inertia.unchecked(ixx=xx, iyy=yy, izz=zz, ixy=0.0, ixz=0.0, iyz=0.0),
        source=prim.source,
    )


_UNWRITTEN = 3e38
"""UsdPhysics has infinity for a center of mass that is not given."""


def _frames(stage: Stage, holder: str, names: Mapping[str, str], written: WrittenNames) -> Iterator[Frame]:
    """Yield the transforms below a model that are no bodies as frames, those whose names are used once."""
    free = [
        prim
        for path, prim in stage.prims.items()
        if prim.type == "Xform" and path.startswith(f"{holder}/") and path not in stage.bodies
    ]
    found, taken = written.of(free), frozenset(names.values())
    for prim in free:
        body, name = stage.body_of(prim.path), found[prim.path]
        if (body is None or body in names) and written.is_frame(name) and name not in taken:
            host = stage.prims[body or holder]
            place = host.place.inverse().compose(prim.place)
            attached = names[body] if body else None
            yield Frame.unchecked(name=name, attached_to=attached, pose=place.to_pose(), source=prim.source)
