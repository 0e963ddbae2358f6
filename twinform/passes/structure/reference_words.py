"""Parameter and element names in plugins and extensions that refer to links, joints and frames.

Nobody declares it, but the names of parameters show it: of the 1,600 blocks of the corpus whose texts or attributes are
names of links or joints, the word has `joint`, `link`, `body` or `frame` in it wherever a reference is meant.
"""

from typing import NamedTuple

from twinform.ir import Element, ReferenceKind
from twinform.ir.references import REFERENCES

_WHOLE: dict[str, ReferenceKind] = {
    **{field: kind for kinds in REFERENCES.values() for field, kind in kinds.items() if kind != "material"},
    "ref": "link",
    "reference": "any",
    "mimic": "joint",
}
# The first part that occurs in a word decides: `joint` before `link`, as in `jointLinkName`, and
# `link` before `frame`.
_PARTS: dict[str, ReferenceKind] = {"joint": "joint", "link": "link", "body": "link", "frame": "frame"}
_NOT_NAMES = frozenset({"frames", "framerate", "frame_rate", "update_frame", "joint_state_topic", "visualize_frame"})


class WordReference(NamedTuple):
    """A text or attribute of an element; `attribute` is empty for its text."""

    element: Element
    attribute: str
    kind: ReferenceKind
    value: str


def kind_of_word(word: str) -> ReferenceKind | None:
    """What a word names, as the name of a parameter; None for one that names nothing that is known here."""
    local = word.rpartition("}")[2].rpartition(":")[2]
    lower = local.lower()
    if lower in _NOT_NAMES:
        return None
    if lower in _WHOLE:
        return _WHOLE[lower]
    return next((kind for part, kind in _PARTS.items() if part in lower), None)


def kind_of_text(element: Element, holder: str) -> ReferenceKind | None:
    """What the text of an element names; `holder` is the name of the element around it.

    `<param name="mimic">` is called by its attribute, `<virtualJoint><name>` by what is around it.
    """
    word = element.name
    if word in {"param", "parameter"}:
        word = element.get("name") or word
    if word == "name":
        word = holder
    return None if word == "collision" else kind_of_word(word)


def kind_of_attribute(element: Element, attribute: str) -> ReferenceKind | None:
    """What an attribute names: `name` is called by its element, all others by themselves."""
    return kind_of_word(element.name if attribute == "name" else attribute)
