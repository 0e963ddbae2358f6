"""Models for links that belong to none: a world of SDF holds no links, and bodies are added and renamed at will.

What bodies of MJCF are called tells which model they are in: `arm::hand` is the link `hand` in the model `arm`. A body
of any other name, with what joints connect to it, is a model of its own in a world, which is called after it.
"""

from collections.abc import Iterable, Iterator

from twinform.compiler.input.mjcf.carried_texts import report_stale
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Element, Format, Frame, Joint, Model, Opaque, replace_fields
from twinform.ir.frames import WORLD
from twinform.ir.scopes import SCOPE, scoped_models, scopes_of
from twinform.passes.carriers.annotations import (
    MADE_NAME,
    annotation,
    find_annotation,
    is_synthesized,
    without_annotation,
)
from twinform.passes.carriers.old_names import with_old_name
from twinform.passes.legalise.changed_names import Names, renamed
from twinform.passes.shared.nodes import unique_name
from twinform.passes.shared.poses import NESTED


def with_models(model: Model, *, in_models: bool) -> Model:
    """The flattened model of a world, in which each link has the name of a model before its own.

    Models that no carrier tells of have frames that stand for them, where their first links are; with `in_models`, so
    do those in these models.
    """
    loose = [each.name for each in model.links if SCOPE not in each.name]
    names: Names = {}
    frames: list[Frame] = []
    taken = {_top(each.name) for part in (model.links, model.joints, model.frames) for each in part} - {*loose}
    for links in _connected(model, loose):
        name = unique_name(links[0], taken)
        taken.add(name)
        names |= {("link", each): name + SCOPE + each for each in links}
        names |= {("joint", each.name): name + SCOPE + each.name for each in model.joints if _is_of(each, links)}
        inside = (each for each in model.frames if each.attached_to in links and SCOPE not in each.name)
        names |= {
            ("frame", each.name): name + SCOPE + each.name for each in inside if find_annotation(each, NESTED) is None
        }
        frames.append(_frame_of(name, name + SCOPE + links[0], is_made=True))
    model = renamed(model, names, Format.SDF) if names else model
    return with_nested(model.copy(frames=(*model.frames, *frames)) if frames else model, in_models=in_models)


def with_nested(model: Model, *, in_models: bool = True) -> Model:
    """The model with a frame for each model in it that only names tell of, where the first link of that is.

    Without `in_models`, a link is in one model; what else its name has before `::` is part of a name.
    """
    known = {each.name for each in model.frames}

    def scopes(link: str) -> Iterable[str]:
        found = [*scopes_of(link)]
        return found if in_models else found[: not known.intersection(found)]

    first = {scope: each.name for each in reversed(model.links) for scope in scopes(each.name)}
    frames = tuple(_frame_of(name, link, is_made=False) for name, link in first.items() if name not in known)
    model = model.copy(frames=(*model.frames, *reversed(frames))) if frames else model
    return with_joints_between(model, in_models=in_models)


def without_moved_statics(frames: Iterable[Frame], model: Model, sink: DiagnosticSink) -> Iterator[Frame]:
    """Yield frames of models, those of static ones as of others where a body of the model is not fixed any more.

    `model` is the flattened one with the joints that the file has. In a static model each body is fixed to the world,
    or to another body of it.
    """
    held: dict[str, list[str]] = {}
    for joint in model.joints:
        if joint.type == "fixed":
            held.setdefault(joint.child or "", []).append(joint.parent or "")
    inside: dict[str, list[str]] = {}
    for link in model.links:
        for scope in scopes_of(link.name):
            inside.setdefault(scope, []).append(link.name)
    for frame in frames:
        own = inside.get(frame.name, ())
        if is_static_frame(frame) and not all(_is_fixed_in(frame.name, held.get(each, ())) for each in own):
            report_stale(sink, f"model {frame.name!r} is not static any more: it can move", frame.source)
            nested = find_annotation(frame, NESTED) or Element.unchecked(name=NESTED)
            rest = tuple(each for each in nested.children if each.name != "static")
            mark = Opaque.unchecked(element=nested.copy(children=rest))
            frame = frame.copy(opaque=(*without_annotation(frame, NESTED).opaque, mark))  # noqa: PLW2901 - the same frame
        yield frame


def _is_fixed_in(model: str, parents: Iterable[str]) -> bool:
    return any(parent == WORLD or parent.startswith(model + SCOPE) for parent in parents)


def is_static_frame(frame: Frame) -> bool:
    """Whether the model that a frame stands for is static."""
    nested = find_annotation(frame, NESTED)
    found = nested.find("static") if nested is not None else None
    return found is not None and found.text in {"true", "1"}


def with_joints_between(model: Model, *, in_models: bool) -> Model:
    """The model whose joints between two models in it, which are in neither, have `_` for `::` in their names.

    They have notes of their names in the file. Without `in_models`, those models count that have frames.
    """
    known = {each.name for each in model.frames if find_annotation(each, NESTED) is not None}
    apart = (each for each in model.joints if _is_between(each) and (in_models or _top(each.name) in known))
    between = {each.name: each.name.replace(SCOPE, "_") for each in apart}
    if not between:
        return model
    noted = (with_old_name(each, between[each.name]) if each.name in between else each for each in model.joints)
    names: Names = {("joint", name): new for name, new in between.items()}
    return renamed(model.copy(joints=tuple(noted)), names, Format.SDF)


def _is_between(joint: Joint) -> bool:
    """Whether a joint connects what is not in the model that its name begins with."""
    scope = _top(joint.name) + SCOPE
    ends = (end for end in (joint.parent, joint.child) if end != WORLD)
    return SCOPE in joint.name and not all((end or "").startswith(scope) for end in ends)


def _top(name: str) -> str:
    return name.partition(SCOPE)[0]


def _connected(model: Model, loose: list[str]) -> Iterator[list[str]]:
    """Yield the loose links that joints connect to each other, in their order."""
    groups = {name: [name] for name in loose}
    for joint in model.joints:
        one, other = groups.get(joint.parent or ""), groups.get(joint.child or "")
        if one is not None and other is not None and one is not other:
            one += other
            groups |= dict.fromkeys(other, one)
    yield from {id(each): each for each in groups.values()}.values()


def _is_of(joint: Joint, links: list[str]) -> bool:
    return SCOPE not in joint.name and joint.child in links and joint.parent in {WORLD, *links}


def _frame_of(name: str, link: str, *, is_made: bool) -> Frame:
    """The frame that stands for a model; one whose name is made has none in the names of its bodies."""
    made = annotation(MADE_NAME, name).element
    nested = annotation(NESTED).element or Element.unchecked(name=NESTED)
    nested = nested.copy(children=(made,)) if is_made and made is not None else nested
    return Frame.unchecked(name=name, attached_to=link, opaque=(Opaque.unchecked(element=nested),))


def without_holds(model: Model) -> Model:
    """The model without joints that only hold the static models in it."""
    static = tuple(scope for scope, each in scoped_models(model) if scope and each.static)
    kept = tuple(
        each
        for each in model.joints
        if not (
            is_synthesized(each)
            and each.type == "fixed"
            and each.parent == WORLD
            and (each.child or "").startswith(static or "\0")
        )
    )
    return replace_fields(model, joints=kept)


def is_held(model: Model) -> bool:
    """Whether nothing in a model moves."""
    held = {each.child for each in model.joints if each.type == "fixed"}
    return all(each.name in held for each in model.links)
