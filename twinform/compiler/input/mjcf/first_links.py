"""First links of models, with which the frames of these move: they stand before others again, whatever hangs from what.

In MJCF a body is in the one that it hangs from, so that a link which stood first may be the last body.
"""

from collections.abc import Iterator

from twinform.ir import Format, Link, Model
from twinform.ir.scopes import SCOPE, scope_in
from twinform.passes.carriers.annotations import came_from, find_annotation, without_annotation
from twinform.passes.carriers.mjcf_texts import FIRST
from twinform.passes.shared.poses import NESTED
from twinform.schemas import in_order


def with_first_links(model: Model) -> Model:
    """The flattened model with the first link of each of its models before the other links of that."""
    places = {link.name: float(place) for place, link in enumerate(model.links)}
    scopes = {frame.name + SCOPE for frame in model.frames if find_annotation(frame, NESTED) is not None}
    own: dict[str, list[Link]] = {}
    for link in model.links:
        own.setdefault(scope_in(link.name, scopes), []).append(link)
    moved: dict[str, Link] = {}
    for scope, name in _first_links(model):
        links = own.get(scope, [])
        wanted = next((each for each in links if each.name == name), None)
        if wanted is None:  # it is gone, or is in another model by now
            continue
        written, _ = in_order([(each, None) for each in links])[0]
        if written is not wanted:
            moved[name] = _placed_at(wanted, written)
            places[name] = places[links[0].name] - 0.5
    model = without_annotation(model, FIRST)
    if not moved:
        return model
    in_places = sorted(model.links, key=lambda link: places[link.name])
    return model.copy(links=tuple(moved.get(each.name, each) for each in in_places))


def keep_first_link(model: Model, *, can_be_named: bool) -> Model:
    """The model with its first link named as the canonical one, where the file has another link on an earlier line.

    Old SDF cannot name one: there all other links are written behind the first.
    """
    if came_from(model, Format.URDF) or model.canonical_link or not model.links:
        return model
    first, (written, _) = model.links[0], in_order([(each, None) for each in model.links])[0]
    if written is first:
        return model
    if can_be_named or first.source is None:
        return model.copy(canonical_link=first.name)
    line = first.source.line
    later = (
        each.copy(source=each.source._replace(line=max(line, each.source.line))) if each.source else each
        for each in model.links
    )
    return model.copy(links=tuple(later))


def _first_links(model: Model) -> Iterator[tuple[str, str]]:
    """Yield the scopes of models that name no canonical link, and the first link of each."""
    found = find_annotation(model, FIRST)
    if found is not None:
        yield "", found.get("link") or ""
    for frame in model.frames:
        nested = find_annotation(frame, NESTED)
        if nested is not None and nested.get("canonical_link") is None:
            yield frame.name + SCOPE, frame.attached_to or ""


def _placed_at(link: Link, other: Link) -> Link:
    """A link that is written where another one is: parts are written in the order of their lines."""
    if link.source is None or other.source is None:
        return link
    return link.copy(source=link.source._replace(line=other.source.line))
