"""Joints that other readers add to URDF: Drake's `<drake:joint>`, and elements that close a loop of joints."""

from collections.abc import Iterator
from typing import NamedTuple

from twinform.ir.element import Element, Opaque
from twinform.ir.joint import Joint
from twinform.ir.model import Model


class EndForm(NamedTuple):
    """How an element that closes a loop describes one of its ends.

    `link` and `attribute` lead to the name of the link; `place` is the element with the point on it, and `axis` the one
    with the axis that is fixed to it.
    """

    link: str
    attribute: str
    place: str
    axis: str = ""


class LoopForm(NamedTuple):
    """How a reader writes a joint that closes a loop: its two ends, and the attributes of the element."""

    parent: EndForm
    child: EndForm
    attributes: tuple[str, ...] = ("name", "type")


DRAKE_JOINT = "drake:joint"
BALL_CONSTRAINT = "drake:ball_constraint"
LOOP_FORMS = {
    "loop_joint": LoopForm(EndForm("link1", "link", "link1", "axis"), EndForm("link2", "link", "link2")),
    "constraint": LoopForm(
        EndForm("parent", "link", "parent_origin", "parent_axis"),
        EndForm("child", "link", "child_origin", "child_axis"),
    ),
    BALL_CONSTRAINT: LoopForm(
        EndForm(f"{BALL_CONSTRAINT}_body_A", "name", f"{BALL_CONSTRAINT}_p_AP"),
        EndForm(f"{BALL_CONSTRAINT}_body_B", "name", f"{BALL_CONSTRAINT}_p_BQ"),
        attributes=(),
    ),
}
"""The elements that close a loop, by their names with the usual prefix."""
_JOINT_ENDS = (EndForm("parent", "link", ""), EndForm("child", "link", ""))


class ForeignJoint(NamedTuple):
    """A joint of another reader in a robot.

    Attributes:
        part: what stands in the model.
        word: the name of the element with the usual prefix.
        joint: its name, type and ends, as far as they are written; nothing else of it.
        form: how its ends are written, if it closes a loop.
    """

    part: Opaque
    word: str
    joint: Joint
    form: LoopForm | None


def usual_word(element: Element) -> str:
    """The name of an element, with `drake:` for the namespace of Drake."""
    # Drake compares the text `drake:`, whatever it stands for; every namespace in use has the word.
    namespace, _, local = element.name.rpartition("}")
    return f"drake:{local}" if "drake" in namespace else element.name


def child_of(element: Element, word: str) -> Element | None:
    """The first child that has this name with the usual prefix."""
    return next((child for child in element.children if usual_word(child) == word), None)


def closes_loop(part: Opaque) -> bool:
    """Whether a part of a robot of URDF is an element that closes a loop."""
    return _word_of_joint(part) in LOOP_FORMS


def _word_of_joint(part: Opaque) -> str:
    """The name of an element that is a joint of another reader of URDF; empty for other parts."""
    word = usual_word(part.element) if part.element and not part.at else ""
    if part.element is None or (word != DRAKE_JOINT and word not in LOOP_FORMS):
        return ""
    # What Drake has in SDF names its ends by texts, and stands in a URDF that was made of it.
    return "" if any(usual_word(each).startswith("drake:") and each.text for each in part.element.children) else word


def ends_of(element: Element) -> tuple[str | None, str | None]:
    """The parent and child that an element of URDF names, which closes a loop or is a joint."""
    form = LOOP_FORMS.get(usual_word(element))
    parent, child = (form.parent, form.child) if form else _JOINT_ENDS
    return _named_link(element, parent), _named_link(element, child)


def foreign_joints(model: Model) -> Iterator[ForeignJoint]:
    """Yield the joints of other readers in a robot of URDF."""
    for part in model.opaque:
        word = _word_of_joint(part)
        if part.element and word:
            (parent, child), name = ends_of(part.element), part.element.get("name")
            joint = Joint.unchecked(
                name=name or "",
                type=part.element.get("type") or "",  # pyright: ignore[reportArgumentType] - any text may stand there
                parent=parent,
                child=child,
                source=part.source._replace(step=word, key=name) if part.source else None,
            )
            yield ForeignJoint(part, word, joint, LOOP_FORMS.get(word))


def _named_link(element: Element, end: EndForm) -> str | None:
    found = child_of(element, end.link)
    return found.get(end.attribute) if found else None
