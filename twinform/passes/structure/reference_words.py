"""Which parameters, elements and attributes in plugins and extensions refer to links, joints and frames.

Nothing declares it, but the names of parameters show it: in the 1,600 blocks of the corpus whose texts or attributes
are names of links or joints, the word contains `joint`, `link`, `body` or `frame` wherever a reference is meant.
"""

from collections.abc import Iterator

from twinform.dataclass import dataclass
from twinform.ir import Element, Model, Node, Plugin, ReferenceKind, walk
from twinform.ir.references import REFERENCES

_WHOLE: dict[str, ReferenceKind] = {
    **{field: kind for kinds in REFERENCES.values() for field, kind in kinds.items() if kind != "material"},
    "ref": "link",
    "reference": "any",
    "mimic": "joint",
}
# The first of these that occurs in a word decides: `joint` before `link`, as in `jointLinkName`,
# and `link` before `frame`.
_PARTS: dict[str, ReferenceKind] = {"joint": "joint", "link": "link", "body": "link", "frame": "frame"}
_NOT_NAMES = frozenset({"frames", "framerate", "frame_rate", "update_frame", "joint_state_topic", "visualize_frame"})


def kind_of_word(word: str) -> ReferenceKind | None:
    """The kind of part that a parameter with this name refers to; None if it refers to none."""
    local = word.rpartition("}")[2].rpartition(":")[2]
    lower = local.lower()
    if lower in _NOT_NAMES:
        return None
    if lower in _WHOLE:
        return _WHOLE[lower]
    return next((kind for part, kind in _PARTS.items() if part in lower), None)


def kind_of_text(element: Element, holder: str) -> ReferenceKind | None:
    """The kind of part that the text of an element refers to; `holder` is the name of the element around it.

    For `<param name="mimic">` the attribute decides, for `<virtualJoint><name>` the element around it.
    """
    word = element.name
    if word in {"param", "parameter"}:
        word = element.get("name") or word
    if word == "name":
        word = holder
    return None if word == "collision" else kind_of_word(word)


def kind_of_attribute(element: Element, attribute: str) -> ReferenceKind | None:
    """The kind of part that an attribute refers to: for `name` its element decides, else its own name."""
    return kind_of_word(element.name if attribute == "name" else attribute)


@dataclass(frozen=True, slots=True)
class Mentions:
    """Who refers to a link or a joint, by the name of this link or joint."""

    links: dict[str, str]
    joints: dict[str, str]


def find_mentions(model: Model) -> Mentions:
    """The links and joints that plugins, transmissions and other untyped elements of a model refer to."""
    found = Mentions({}, {})
    for node in walk(model):
        for element in _untyped_elements(node):
            holder = f"plugin {node.name!r}" if isinstance(node, Plugin) else f"<{element.name}>"
            _collect_mentions(element, "", holder, found)
    return found


def _untyped_elements(node: Node) -> Iterator[Element]:
    content: tuple[Element, ...] = getattr(node, "content", ())
    yield from content
    for part in node.opaque:
        if part.element is not None:
            yield part.element


def _collect_mentions(element: Element, around: str, holder: str, found: Mentions) -> None:
    named = element.get("name")
    if element.name == "plugin":
        holder = f"plugin {named!r}"
    for attribute, value in element.attributes:
        if not (attribute == "name" and element.name == "sensor"):
            _note_mention(kind_of_attribute(element, attribute), value, holder, found)
    if element.text:
        _note_mention(kind_of_text(element, around), element.text, holder, found)
    for child in element.children:
        _collect_mentions(child, element.name, holder, found)


def _note_mention(kind: ReferenceKind | None, text: str, holder: str, found: Mentions) -> None:
    where = {"link": found.links, "joint": found.joints}.get(kind or "")
    if where is not None:
        # Some plugins take lists of names in one text.
        for name in (text, *text.replace(",", " ").split()):
            where.setdefault(name.rpartition("::")[2], holder)
