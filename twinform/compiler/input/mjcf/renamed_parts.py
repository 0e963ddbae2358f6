"""The names that links, joints and frames had before they were written as MJCF, which has names for each kind."""

from collections.abc import Mapping, Sequence

from twinform.ir import Format, Frame, Joint, Link, Model, replace_fields
from twinform.ir.frames import WORLD
from twinform.ir.scopes import SCOPE, scopes_of
from twinform.passes.carriers.annotations import MADE_NAME, find_annotation, is_synthesized, without_annotation
from twinform.passes.carriers.mjcf_texts import LOOP
from twinform.passes.carriers.old_names import NAME, annotated_name, old_name
from twinform.passes.carriers.partial_nodes import written_name, written_names
from twinform.passes.legalise.changed_names import Names, fixed_joint_name, renamed
from twinform.passes.shared.nodes import unique_name
from twinform.passes.shared.poses import NESTED
from twinform.passes.structure.rename_parts import Part

Node = Link | Joint | Frame
_FIELDS: tuple[tuple[Part, str], ...] = (("link", "links"), ("joint", "joints"), ("frame", "frames"))


def renamed_parts(
    model: Model,
    links: Sequence[Link],
    joints: Sequence[Joint],
    frames: Sequence[Frame],
    *,
    has_scopes: bool,
    is_free: bool,
) -> Model:
    """The model with the names of its partial nodes, and otherwise those of the file.

    With `has_scopes`, what a body is called tells which model in the model it is in; where names are `is_free`, `::`
    may stand in any of them and means nothing.

    A joint that is fixed, and a link between two joints of one body, have no names there: they are known by what they
    hold, and by what holds them.
    """
    scopes = {each.name for each in frames if find_annotation(each, NESTED) is not None}
    if has_scopes:
        scopes.update(scope for each in model.links for scope in scopes_of(name_in_file(each)))
    names: Names = {}
    free: list[tuple[Part, Node]] = []
    if any(each.parent == WORLD for each in model.joints):  # which a link of this name would hold
        links = [each for each in links if each.name != WORLD]
    for (part, field), partials in zip(_FIELDS, (links, joints, frames), strict=True):
        # Several joints that stand for one are joined later, under the names that they have.
        known = {written_name(each): each.name for each in partials if len(written_names(each)) == 1}
        for node in getattr(model, field):
            old = known.get(name_in_file(node))
            if old is None:
                free.append((part, node))
            else:
                names[part, node.name] = old
    _name_hidden(model, joints, names)
    _name_fixed(model, joints, names)
    taken, between, shared = set(names.values()), _between(model), dict[tuple[Part, str], str]()
    for part, node in free:
        if (part, node.name) not in names:
            written = between.get(node.name) or name_in_file(node)
            scope = written.rpartition(SCOPE)[0]
            is_kept = written == written.strip() and (is_free or not scope or scope in scopes)
            wish = written if is_kept else node.name
            new = unique_name(wish, taken)
            names[part, node.name] = new
            taken.add(new)
            if is_kept and new != written and node.name not in between:  # a name that a part of another kind has
                shared[part, new] = written
    # Nothing refers to a joint that has no name in the file, so that nothing has to follow it.
    unnamed = {
        ("joint", each.name) for each in model.joints if is_synthesized(each) or find_annotation(each, MADE_NAME)
    }
    changed = {key: new for key, new in names.items() if key[1] != new and key not in unnamed}
    bare = _with_own_names(model, {})
    whole = renamed(bare, changed, Format.SDF) if changed else bare
    pairs = ((("joint", old.name), new) for old, new in zip(model.joints, whole.joints, strict=True))
    joints = tuple(new.copy(name=names[key]) if key in unnamed and key in names else new for key, new in pairs)
    return _with_own_names(replace_fields(whole, joints=joints), shared)


def _with_own_names(model: Model, names: Mapping[tuple[Part, str], str]) -> Model:
    """The model without annotations of names in the file, but on parts that cannot have these `names`."""

    def named(part: Part, node: Node) -> Node:
        bare, written = without_annotation(node, NAME, MADE_NAME), names.get((part, node.name))
        return bare if written is None else bare.copy(opaque=(old_name(written, node.name), *bare.opaque))

    return replace_fields(
        model, **{field: tuple(named(part, each) for each in getattr(model, field)) for part, field in _FIELDS}
    )


def with_hidden_names(model: Model, partials: Sequence[Joint]) -> Model:
    """The model with the names that partial joints give to the links between joints of one body, if these are free."""
    names: Names = {}
    _name_hidden(model, partials, names)
    taken = {each.name for each in (*model.links, *model.joints, *model.frames)}
    changed = {key: new for key, new in names.items() if new not in taken}
    return renamed(model, changed, Format.SDF) if changed else model


def name_in_file(node: Node) -> str:
    """The name of a part in the file."""
    found = find_annotation(node, NAME)
    return (annotated_name(found) if found is not None else "") or node.name


def _name_hidden(model: Model, partials: Sequence[Joint], names: Names) -> None:
    """Name the links between joints of one body."""
    hidden = {each.name for each in model.links if is_synthesized(each)}
    # Of several joints that stand for one, the last has its child.
    children = {written_names(each)[-1]: each.child for each in partials if each.child}
    for joint in model.joints:
        old = children.get(name_in_file(joint))
        if joint.child in hidden and old is not None:
            names["link", joint.child] = old


def _between(model: Model) -> dict[str, str]:
    """The names of links between joints of one body, beside that of the body: those in the file know no scopes."""
    written = {each.name: name_in_file(each) for each in model.links}
    hidden = {each.name for each in model.links if is_synthesized(each)}
    below = {joint.parent: joint.child or "" for joint in model.joints if joint.parent in hidden}
    named: dict[str, str] = {}
    for joint in model.joints:
        if joint.child in hidden:
            body = joint.child
            while body in below:
                body = below[body]
            scope, mark, _ = written.get(body, "").rpartition(SCOPE)
            named[joint.child] = f"{scope}{mark}{name_in_file(joint).rpartition(SCOPE)[2]}_link"
    return named


def _name_fixed(model: Model, partials: Sequence[Joint], names: Names) -> None:
    """Name the fixed joints, by the links that they hold."""
    tree = (each for each in partials if find_annotation(each, LOOP) is None)
    fixed = {each.child: each.name for each in tree if each.type == "fixed"}
    written = {each.name: name_in_file(each) for each in model.links}
    # A weld may hold the same link as the body around that does, and closes a loop.
    for joint in sorted(model.joints, key=lambda each: not each.name.startswith(fixed_joint_name(each.child or ""))):
        link = joint.child or ""
        child = names.get(("link", link)) or written.get(link)
        if joint.type == "fixed" and child in fixed and ("joint", joint.name) not in names:
            names["joint", joint.name] = fixed.pop(child)
