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

from collections.abc import Iterable, Iterator
from typing import Any, ClassVar

from twinform.diagnostics import DiagnosticSink
from twinform.diagnostics.rules import STALE_CARRIER
from twinform.ir import Collision, Color, Element, Format, Frame, Joint, Light, Link, Model, Opaque, Sensor, Visual
from twinform.ir.node import NOT_CONTENT
from twinform.passes.carriers.annotations import (
    AnyNode,
    annotation,
    came_from,
    find_annotation,
    with_annotation,
    without_annotation,
    wrote_scopes,
)
from twinform.passes.framework.pass_base import ModelPass
from twinform.passes.shared.poses import NESTED
from twinform.passes.structure.rename_parts import Part, rename_model, scope_of

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


NAME = "name"
"""The annotation on a link, joint, frame or shape of SDF with the name that it has in URDF."""
SCOPED_NAME = "scoped-name"
"""The annotation on a link, joint or frame of URDF with the name, such as `arm::hand`, that it has in SDF."""
Names = dict[tuple[Part, str], str]
"""New names by the kind of part and its old name."""
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
        annotated = list(_annotated(model, kind)) if back else []
        if not annotated:
            return model
        names: Names = {}
        taken = {self._key(part, node.name) for part, field in _FIELDS.items() for node in getattr(model, field)}
        scopes = _scopes(model)
        sensed = {each.reference for each in model.extensions if any(one.name == "sensor" for one in each.content)}
        for part, node, now, old in annotated:
            why = None
            if self.unique and part == "joint" and now == node.name and self._key(part, old) in taken:
                names[part, node.name] = f"{old.strip('_')}_joint"
                continue
            if now != node.name:
                why = "has another name now"
            elif self._key(part, old) in taken:
                why = "would share that name with another"
            elif node.name in sensed and any(old == link.name for link in model.links):
                why = "has a sensor now, which would be one of the link of that name"
            elif kind == SCOPED_NAME and not (wrote_scopes(model) or scopes.issuperset(scopes_in(old))):
                why = "is in a nested model that the file no longer describes"
            if why:
                message = f"{part} {node.name!r} was called {old!r}, and {why}"
                sink.report(STALE_CARRIER, message, node.location, found=old)
                continue
            taken.add(self._key(part, old))
            names[part, node.name] = old
        update = {
            field: tuple(without_annotation(node, kind) for node in getattr(model, field)) for field in _FIELDS.values()
        }
        return renamed(model.copy(**update), names, self.to)

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
            old = _old_name(found) if found is not None else ""
            if found is not None and old:
                yield part, node, found.get("instead_of") or "", old


def _old_name(found: Element) -> str:
    """The name that an annotation gives back."""
    return found.get("was") or found.text or ""


def source_name(node: Link | Joint | Frame | Collision | Visual | Light | Sensor) -> str:
    """The name that a part had in the source, where SDF could not have it: the annotated one, or else its own."""
    found = find_annotation(node, NAME)
    return _old_name(found) if found and found.get("instead_of") == node.name else node.name or ""


def with_old_name(node: AnyNode, name: str) -> AnyNode:
    """The node with an annotation of its name, before it is renamed."""
    old: Any = getattr(node, "name", None)
    return node.copy(opaque=(old_name(old, name), *node.opaque))


def old_name(old: str, name: str) -> Opaque:
    """The annotation of the name that a part had before this one; blanks around it need an attribute."""
    is_plain = old == old.strip()
    return annotation(NAME, old if old and is_plain else None, {"instead_of": name, "was": None if is_plain else old})


def _model_by_its_name(model: Model) -> Model:
    """The model with its annotated name restored, unless it was renamed since."""
    found = find_annotation(model, NAME)
    if found is None:
        return model
    model = without_annotation(model, NAME)
    return model.copy(name=_old_name(found)) if found.get("instead_of") == model.name else model
