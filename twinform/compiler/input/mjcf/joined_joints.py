"""Several joints of one body that were one joint with two axes, or of another kind, before it was written as MJCF."""

from collections.abc import Iterable

from twinform.ir import Joint, Link, Model
from twinform.passes.carriers.annotations import find_annotation
from twinform.passes.carriers.mjcf_texts import LOOP
from twinform.passes.carriers.partial_nodes import written_names


def join_joints(model: Model, partials: Iterable[Joint]) -> Model:
    """The model with one joint for the chain of those that a carrier names, as long as they are still one."""
    for partial in partials:
        names = written_names(partial)
        if len(names) > 1 and find_annotation(partial, LOOP) is None:
            model = _joined(model, partial, names)
    return model


def _joined(model: Model, partial: Joint, names: list[str]) -> Model:
    by_name = {each.name: each for each in model.joints}
    chain = [by_name[name] for name in names if name in by_name]
    between = [each.child for each in chain[:-1]]
    if len(chain) != len(names) or between != [each.parent for each in chain[1:]]:
        return model
    if not all(_is_bare(link) for link in model.links if link.name in between):
        return model
    last = chain[-1]
    joint = last.copy(
        name=partial.name,
        type=partial.type,
        parent=chain[0].parent,
        axis=chain[0].axis,
        axis2=last.axis if partial.axis2 is not None or len(chain) > 1 else None,
        opaque=tuple(part for each in chain for part in each.opaque),
    )
    joints = tuple(joint if each is last else each for each in model.joints if each is last or each not in chain)
    links = tuple(each for each in model.links if each.name not in between)
    return model.copy(links=links, joints=joints)


def _is_bare(link: Link) -> bool:
    return not (link.visuals or link.collisions or link.sensors or link.lights)
