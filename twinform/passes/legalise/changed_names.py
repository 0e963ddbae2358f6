"""Names that a conversion had to change or to give, and the annotations that restore them and the look of materials.

    <tf:name instead_of="arm_joint">arm</tf:name>                    in SDF
    <tf:name instead_of="arm" was="arm "/>                           where blanks are around the name
    <tf:scoped-name instead_of="arm__hand">arm::hand</tf:name>       in URDF

An annotation has the name that it was made for: where that was edited since, the edit counts. Those of materials:

<tf:colors ambient="0.1 0.1 0.1 1" of="1 0 0 1"/>   in a visual of URDF: SDF's other color, while `of` is this one's
<tf:scripts>file://a.material</tf:scripts>          in a visual of URDF: where the material of its link's tag is
<tf:material>rubber</tf:material>                   in a visual of SDF: the name that URDF has for its material
<tf:shared-material>rubber</tf:shared-material>     in a model of SDF: the robot defines this material
<tf:look>ambient script</tf:look>                   in a link of SDF: what URDF sets for all its visuals in a `<gazebo>`
"""

from collections.abc import Collection, Iterable, Iterator
from typing import ClassVar, NamedTuple, Self, TypeVar

from twinform.diagnostics import DiagnosticSink, rules
from twinform.diagnostics.rules import STALE_CARRIER
from twinform.ir import (
    Color,
    Format,
    Frame,
    Joint,
    Link,
    Model,
    Visual,
    map_references,
)
from twinform.ir.node import NOT_CONTENT
from twinform.ir.scopes import SCOPE
from twinform.passes.carriers.annotations import (
    came_from,
    find_annotation,
    with_annotation,
    without_annotation,
    wrote_scopes,
)
from twinform.passes.carriers.carriers import Keeper
from twinform.passes.carriers.old_names import NAME, annotated_name, with_old_name
from twinform.passes.framework.pass_base import ModelPass
from twinform.passes.legalise.to_urdf_pass import ToUrdfPass, UrdfKeeper
from twinform.passes.shared.nodes import reserve_name
from twinform.passes.shared.poses import FRAME, NESTED
from twinform.passes.structure.rename_parts import Part, follow_references, rename_model, scope_of

COLORS = "colors"
SCRIPTS = "scripts"
MATERIAL = "material"
SHARED_MATERIAL = "shared-material"
LOOK = "look"


def with_look(link: Link, fields: Iterable[str]) -> Link:
    """The link with an annotation on the material fields that the last extension with any sets in all visuals."""
    names = [field for field in fields if field not in NOT_CONTENT]
    return with_annotation(without_annotation(link, LOOK), LOOK, " ".join(names))


def look_of(link: Link) -> tuple[str, ...]:
    """The fields of materials that one extension sets for all visuals."""
    found = find_annotation(link, LOOK)
    return tuple((found.text or "").split()) if found else ()


def material_name(link: Link, visual: Visual) -> str:
    """The name of a material that has none in SDF; URDF asks for one."""
    return f"{link.name}_{visual.name}_material"


_WITH_ALPHA = 4


def urdf_color(color: Color) -> Color:
    """With alpha, and each part from 0 to 1, outside of which urdfdom refuses it."""
    clamped = tuple(min(1.0, max(0.0, part)) for part in color)
    return with_alpha(color if clamped == color else clamped)


def with_alpha(color: Color) -> Color:
    """Red, green, blue and alpha, which is 1 where it is not written."""
    return color if len(color) == _WITH_ALPHA else (*color, 1.0)


def seen_by_gazebo(color: Color, texture: str | None) -> str:
    """How Gazebo shows a material of URDF; empty where it is as it is written."""
    # it divides all by 0.8 and cuts off at 1, and reads no textures: parser_urdf.cc, CreateVisual
    brighter = "brighter, as it divides colors by 0.8" if any(0 < part < 1 for part in color[:3]) else ""
    bare = "without its texture" if texture is not None else ""
    return " and ".join(filter(None, (bare, brighter)))


SCOPED_NAME = "scoped-name"
"""The annotation on a link, joint or frame of URDF with the name, such as `arm::hand`, that it has in SDF."""
Names = dict[tuple[Part, str], str]
"""New names by the kind of part and its old name."""
_SHARED = "would share that name with another"
_FIELDS: dict[Part, str] = {"link": "links", "joint": "joints", "frame": "frames"}


def renamed(model: Model, names: Names, format_: Format) -> Model:
    """The model with parts renamed, and all references to them."""
    scope = scope_of(model, lambda part, name: names.get((part, name), name), deep=False)
    return rename_model(model, scope, format_, DiagnosticSink())


def with_old_names(model: Model, names: Names) -> Model:
    """The renamed model of URDF with annotations that give the old names."""
    old = {(part, new): name for (part, name), new in names.items()}

    def annotated(part: Part, node: Link | Joint | Frame) -> Link | Joint | Frame:
        name = old.get((part, node.name))
        return node if name is None else with_annotation(node, SCOPED_NAME, name, {"instead_of": node.name})

    update = {field: tuple(annotated(part, node) for node in getattr(model, field)) for part, field in _FIELDS.items()}
    return model.copy(**update)


def scoped_name(node: Link | Joint | Frame) -> str:
    """The name of a link, joint or frame of URDF in SDF: the annotated one, or else its own."""
    found = find_annotation(node, SCOPED_NAME)
    return found.text or "" if found and found.get("instead_of") == node.name else node.name


class _Surroundings(NamedTuple):
    """What tells whether a part may have its old name: links, those with sensors of their own, and models around it.

    `scopes` is None where a scope in a name is that of no model.
    """

    links: frozenset[str]
    sensed: frozenset[str | None]
    scopes: frozenset[str] | None

    @classmethod
    def of(cls, model: Model, *, in_models: bool) -> Self:
        """Look through a model."""
        sensed = (each.reference for each in model.extensions if any(one.name == "sensor" for one in each.content))
        links = (each.name for each in model.links)
        return cls(frozenset(links), frozenset(sensed), frozenset(_scopes(model)) if in_models else None)

    def why_not(self, name: str, given: str, old: str) -> str | None:
        """Why a part of this name, which it was given, does not get its old one back; None where it does."""
        if given != name:
            return "has another name now"
        if name in self.sensed and old in self.links:
            return "has a sensor now, which would be one of the link of that name"
        if self.scopes is not None and not self.scopes.issuperset(scopes_in(old)):
            return "is in a nested model that the file no longer describes"
        return None


class RestoreNames(ModelPass):
    """Give links, joints and frames the names that they had in the source.

    Changes: a name behind which an annotation stands becomes the one that the annotation gives, and all that names it
    follows. With `apart`, a joint may have the name of a link, as in URDF and in SDF before 1.7.
    Never touches: a name that was edited since, or where another part has the old name by now, or the scope in it is
    that of no nested model any more.
    Diagnostics: `stale-carrier` for these.
    """

    name: ClassVar[str] = "restore-names"
    to: Format
    apart: bool = False
    unique: bool = False
    """Whether no two parts may share a name, even in URDF; a joint that would keeps its name of SDF."""

    def run_model(self, model: Model, sink: DiagnosticSink) -> Model:
        """The model by its old names."""
        kind = SCOPED_NAME if self.to is Format.SDF and not self.apart else NAME
        if kind == NAME and self.to is Format.URDF:
            model = _model_by_its_name(model)
        back = kind == SCOPED_NAME or came_from(model, self.to)
        found = list(_annotated(model, kind)) if back else []
        annotated = [each for each in found if not self._is_of_mjcf(each[-1])]
        if not annotated:
            return model
        names: Names = {}
        sites = set[int]()
        around = _Surroundings.of(model, in_models=kind == SCOPED_NAME and not wrote_scopes(model))
        taken = {self._key(part, node.name) for part, field in _FIELDS.items() for node in getattr(model, field)}
        for part, node, now, old in annotated:
            if self.unique and part == "joint" and now == node.name and self._key(part, old) in taken:
                names[part, node.name] = f"{old.strip('_')}_joint"
                continue
            is_shared = now == node.name and self._key(part, old) in taken
            why = _SHARED if is_shared else around.why_not(node.name, now, old)
            if is_shared and find_annotation(node, FRAME) is not None:  # a site of MJCF may be called as a body is
                sites.add(id(node))
            elif why:
                message = f"{part} {node.name!r} was called {old!r}, and {why}"
                sink.report(STALE_CARRIER, message, node.location, found=old)
            else:
                taken.add(self._key(part, old))
                names[part, node.name] = old
        kept = sites | {id(node) for _, node, _, old in found if self._is_of_mjcf(old)}
        update = {
            field: tuple(node if id(node) in kept else without_annotation(node, kind) for node in getattr(model, field))
            for field in _FIELDS.values()
        }
        return renamed(model.copy(**update), names, self.to)

    def _is_of_mjcf(self, old: str) -> bool:
        """Whether only MJCF has such a name: a joint between two models has no scope in SDF."""
        return self.apart and SCOPE in old

    def _key(self, part: Part, name: str) -> tuple[Part, str]:
        return (part if (self.to is Format.URDF or self.apart) and not self.unique else "", name)


def _scopes(model: Model) -> set[str]:
    """The names of the nested models whose frames are still in the model."""
    own = [frame for frame in model.frames if find_annotation(frame, NESTED) is not None]
    annotations = [(find_annotation(frame, SCOPED_NAME), frame.name) for frame in own]
    return {(annotation.text or "") if annotation else name for annotation, name in annotations}


def scopes_in(name: str) -> set[str]:
    """The models that a scoped name is in: `a` and `a::b` of `a::b::link`."""
    parts = name.split("::")[:-1]
    return {"::".join(parts[: count + 1]) for count in range(len(parts))}


def _annotated(model: Model, kind: str) -> Iterator[tuple[Part, Link | Joint | Frame, str, str]]:
    """Each annotated part: its kind, the node, the name that the conversion gave it, and the one to restore."""
    for part, field in _FIELDS.items():
        for node in getattr(model, field):
            found = find_annotation(node, kind)
            old = annotated_name(found) if found is not None else ""
            if found is not None and old:
                yield part, node, found.get("instead_of") or "", old


def fixed_joint_name(body: str) -> str:
    """The name that a fixed joint without one has, such as all of MJCF: that of the body that it holds."""
    return f"{body}_fixed_joint"


def _model_by_its_name(model: Model) -> Model:
    """The model with its annotated name restored, unless it was renamed since."""
    found = find_annotation(model, NAME)
    if found is None or not (annotated_name(found) or came_from(model, Format.URDF)):  # MJCF may call a model nothing
        return model
    model = without_annotation(model, NAME)
    return model.copy(name=annotated_name(found)) if found.get("instead_of") == model.name else model


Named = TypeVar("Named", Link, Joint, Model)
_NO_NAME = "robot"
"""The name of a robot without one, since SDF requires a name."""


class UniqueNames(ModelPass):
    """Give joints names that no link has, and links names that SDF does not keep for itself.

    Changes: 1. a joint with a link's name becomes `NAME_joint` (with a number if that is taken too), and mimics and
    poses follow; 2. a link called `world`, or with two underscores at both ends, becomes `NAME_link`, and joints and
    poses follow; 3. names lose the blanks around them, which libsdformat drops where it reads them; 4. a robot without
    a name is called `robot`.
    References follow, also those in frames, sensors and plugins of `<gazebo>`, as in the pass `rename`.
    Never touches: a floating joint, which SDF does not have; a text that may be something else than a reference.
    Diagnostics: `renamed`, and `unfollowed-name` for such a text. The old name is carried.
    """

    name: ClassVar[str] = "unique-names"
    carriers: bool = True
    silent: bool = False
    """For a target that gives the old names back: nothing is reported."""

    def run_model(self, model: Model, sink: DiagnosticSink) -> Model:
        """The model with one name for each thing."""
        if not model.name.strip():
            model = self._rename(model, _NO_NAME, sink)
        names = {link.name for link in model.links}
        taken = names | {joint.name for joint in model.joints}
        links = {name: reserve_name(_legal_name(name, "link"), taken) for name in sorted(names) if _is_reserved(name)}
        kept = (joint.name for joint in model.joints if joint.type != "floating")  # SDF has no joint there
        clashes = [name for name in kept if name in names or _is_reserved(name)]
        joints = {name: reserve_name(_legal_name(name, "joint", names), taken) for name in clashes}
        if not links and not joints:
            return model
        new: dict[str, dict[str, str]] = {"link": links, "joint": joints}
        # typed references mean links and joints here, also one called `world`, which means something else in SDF
        followed = map_references(model, lambda kind, name: new.get(kind, {}).get(name, name), Format.URDF)
        scope = scope_of(model, lambda part, name: new.get(part, {}).get(name, name), deep=False)
        followed = follow_references(followed, scope, Format.URDF, sink)
        update = {
            "links": tuple(self._rename_if_new(link, links, sink) for link in followed.links),
            "joints": tuple(self._rename_if_new(joint, joints, sink) for joint in followed.joints),
        }
        return followed.copy(**update)

    def _rename_if_new(self, node: Named, names: dict[str, str], sink: DiagnosticSink) -> Named:
        return self._rename(node, names[node.name], sink) if node.name in names else node

    def _rename(self, node: Named, name: str, sink: DiagnosticSink) -> Named:
        if not self.silent:
            kind = type(node).__name__.lower()
            message = f"{kind} {node.name!r} is called {name!r} in SDF"
            sink.report(rules.RENAMED, message, node.location, found=node.name)
            Keeper(sink, self.carriers).account(rules.RENAMED, message, node.location.at("@name"))
        if self.carriers:
            node = with_old_name(node, name)
        return node.copy(name=name)


def _is_reserved(name: str) -> bool:
    return name == "world" or (name.startswith("__") and name.endswith("__")) or name != name.strip()


def _legal_name(name: str, kind: str, links: Collection[str] = ()) -> str:
    """The name to take instead of one that is reserved or that a link has."""
    bare = name.strip()
    # libsdformat drops blanks around names where it reads them, so a link "a " would lose the
    # joints that name it.
    return f"{bare.strip('_')}_{kind}" if bare == name or bare in links or _is_reserved(bare) else bare


class NameJointsApart(ToUrdfPass):
    """Give joints names that no link has.

    Changes: a joint with the name of a link becomes `NAME_joint`, as it does where libsdformat reads such an SDF file;
    it refuses a URDF in which they share a name. What names the joint follows.
    Never touches: names that a URDF gave.
    Diagnostics: `renamed`. The old name is carried.
    """

    name: ClassVar[str] = "name-joints-apart"

    def run_model(self, model: Model, keeper: UrdfKeeper) -> Model:
        """The model with one name for each link and joint."""
        links = {link.name for link in model.links}
        clashes = [joint.name for joint in model.joints if joint.name in links]
        if keeper.back or not clashes:
            return model
        taken = links | {joint.name for joint in model.joints}
        # Model.cc (Load) renames the joint of an SDF file before 1.7 in the same way, so the URDF has the
        # name that Gazebo has for the joint of the source.
        new = {name: reserve_name(f"{name}_joint", taken) for name in clashes}
        names: Names = {("joint", old): made for old, made in new.items()}
        joints = tuple(self._rename_joint(joint, new, keeper) if joint.name in new else joint for joint in model.joints)
        return renamed(model.copy(joints=joints), names, Format.URDF)

    def _rename_joint(self, joint: Joint, new: dict[str, str], keeper: UrdfKeeper) -> Joint:
        message = f"joint {joint.name!r} is called {new[joint.name]!r} in URDF: a link has its name"
        keeper.sink.report(rules.RENAMED, message, joint.location, found=joint.name)
        keeper.account(rules.RENAMED, message, joint.location.at("@name"), 1)
        return with_old_name(joint, new[joint.name]) if self.carriers else joint
