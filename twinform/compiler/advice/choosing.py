"""Which format a robot is best kept in, and why: a table of reasons, each measured on the file itself."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import NamedTuple

from twinform.compiler.advice.forms import Form, Loss
from twinform.diagnostics.rules import MODEL_NOT_CHOSEN
from twinform.ir import Document, Format, Joint, walk
from twinform.passes.control.carried_elements import urdf_elements
from twinform.passes.shared.candidates import candidates


@dataclass(frozen=True, slots=True)
class Facts:
    """What a choice depends on: the document, both forms of it, and whether macros make it."""

    document: Document
    forms: Mapping[Format, Form]
    macros: bool = False

    def losses(self, format_: Format) -> tuple[Loss, ...]:
        """What a format does not express of a file that is in the other one."""
        return () if self.document.format is format_ else tuple(self.forms[format_].losses())


class Choice(NamedTuple):
    """The format that the model is best edited in, and the reasons."""

    format: Format
    reasons: tuple[str, ...]


class _Reason(NamedTuple):
    """A reason for a format: what it says about a file, empty where it does not hold. Decisive ones outweigh others."""

    format: Format
    decisive: bool
    words: Callable[[Facts], str]


def choose(facts: Facts) -> Choice:
    """The format of the first decisive reason that holds, else of the first that holds, and all reasons for it."""
    holding = [(each, words) for each in _REASONS if (words := each.words(facts))]
    # `min` keeps the first of equals, so the order of the table is the order of reasons.
    first = min(holding, key=lambda one: not one[0].decisive)[0]
    return Choice(first.format, tuple(words for each, words in holding if each.format is first.format))


def _is_a_scene(facts: Facts) -> str:
    number = sum(1 for _ in candidates(facts.document))
    if facts.document.worlds:
        return f"it is a world of {_count(number, 'model')}; URDF holds one robot, and nothing around it"
    return f"it has {number} models; URDF holds one" if number > 1 else ""


def _has_no_urdf(facts: Facts) -> str:
    return _refusal(facts.forms[Format.URDF])


def _has_no_sdf(facts: Facts) -> str:
    return _refusal(facts.forms[Format.SDF])


def _refusal(form: Form) -> str:
    # That several models are in a file is a reason of its own, and no fault of the model.
    errors = [each for each in form.errors if each.rule is not MODEL_NOT_CHOSEN]
    return f"it cannot be written as {form.format.upper()}: {errors[0].message}" if errors else ""


def _has_macros(facts: Facts) -> str:
    return "its macros are the source, and both formats are made from them" if facts.macros else ""


def _loses_in_urdf(facts: Facts) -> str:
    return _unsaid(facts.losses(Format.URDF), "URDF")


def _loses_in_sdf(facts: Facts) -> str:
    return _unsaid(facts.losses(Format.SDF), "SDF")


def _is_driven(facts: Facts) -> str:
    names = ("transmission", "ros2_control")
    found = [
        name
        for model in facts.document.models
        for name in names
        for _ in urdf_elements(model, facts.document.format, name)
    ]
    kinds = " and ".join(f"<{name}>" for name in names if name in found)
    return f"it has {kinds}, which ROS reads from URDF only" if found else ""


def _is_scenery(facts: Facts) -> str:
    moves = any(isinstance(node, Joint) and node.type != "fixed" for node in walk(facts.document))
    return "" if moves else "no joint of it moves: it is a thing of a world, and no robot that ROS drives"


def _is_a_robot(_: Facts) -> str:
    return "ROS, RViz and MoveIt read URDF alone, and Gazebo reads the SDF that is made from it"


_REASONS = (
    _Reason(Format.SDF, True, _is_a_scene),
    _Reason(Format.SDF, True, _has_no_urdf),
    _Reason(Format.URDF, True, _has_macros),
    _Reason(Format.URDF, True, _has_no_sdf),
    _Reason(Format.SDF, True, _loses_in_urdf),
    _Reason(Format.URDF, True, _is_driven),
    _Reason(Format.URDF, True, _loses_in_sdf),
    _Reason(Format.SDF, False, _is_scenery),
    _Reason(Format.URDF, False, _is_a_robot),
)


def _unsaid(losses: tuple[Loss, ...], format_: str) -> str:
    """Such as `7 parts have no URDF equivalent (5 sdf-only, 2 cut-loop)`."""
    if not losses:
        return ""
    total = sum(each.number for each in losses)
    alone = len(losses) == 1
    kinds = ", ".join(each.rule if alone else f"{each.number} {each.rule}" for each in losses[:3])
    more = f" and {_count(len(losses) - 3, 'other kind')}" if len(losses) > 3 else ""
    return f"{_count(total, 'part')} {'has' if total == 1 else 'have'} no {format_} equivalent ({kinds}{more})"


def _count(number: int, word: str) -> str:
    return f"{number} {word}{'' if number == 1 else 's'}"
