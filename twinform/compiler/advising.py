"""`twinform advise`: which format a robot is best kept in, and what each consumer makes of both.

The file is converted into the other format. A table of reasons, each measured on the file itself, decides which format
it is best kept in, and the profiles of all consumers are asked about both.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import partial
from itertools import groupby
from typing import NamedTuple

from twinform.compiler.conversion_error import CompileError
from twinform.compiler.driver import run_conversion
from twinform.compiler.input.load_options import XACRO, Input, LoadOptions, LoadResult
from twinform.compiler.input.loading import read
from twinform.compiler.inspect_for_consumers import subject_of
from twinform.compiler.inspection import inspect
from twinform.compiler.request import ConversionRequest
from twinform.dataclass import dataclass
from twinform.diagnostics import Diagnostic, Fate, LedgerEntry, rules
from twinform.diagnostics.rules import MODEL_NOT_CHOSEN
from twinform.ir import Document, Format, Joint, walk
from twinform.passes.joints.transmission import urdf_elements
from twinform.passes.shared.candidates import candidates
from twinform.profiles import Assessment, Effect, Profile, assess
from twinform.request_options import Language


class Loss(NamedTuple):
    """Parts of one kind that a format does not express: their number, and the message about the first."""

    rule: str
    fate: Fate
    number: int
    example: str


@dataclass(frozen=True, slots=True)
class Form:
    """A model in one format: its text and the ledger, or the errors for which there is no text."""

    format: Format
    text: bytes = b""
    entries: tuple[LedgerEntry, ...] = ()
    errors: tuple[Diagnostic, ...] = ()

    @property
    def exists(self) -> bool:
        """Whether the model can be written in this format."""
        return not self.errors

    def losses(self) -> Iterator[Loss]:
        """Yield what other readers of this format do not see, or misread: the gravest and most frequent kinds first."""
        told = sorted(filter(_is_of_the_robot, self.entries), key=_rule_and_fate)
        groups = [(kind, list(entries)) for kind, entries in groupby(told, _rule_and_fate)]
        for (rule, fate), entries in sorted(groups, key=lambda group: _gravity(group[1]), reverse=True):
            yield Loss(rule, Fate(fate), len(entries), entries[0].message)


def _is_of_the_robot(entry: LedgerEntry) -> bool:
    return entry.rule not in _THE_SAME_ROBOT and entry.location.path != _VERSION


def _gravity(entries: list[LedgerEntry]) -> tuple[int, int]:
    return entries[0].rule.severity, len(entries)


def _rule_and_fate(entry: LedgerEntry) -> tuple[str, str]:
    return entry.rule.name, entry.fate


# Rules about what is only written differently: whoever reads the other format sees the same robot.
_THE_SAME_ROBOT = frozenset(
    {
        rules.LEFT_COMMENT,
        rules.FRAME_LINK,
        rules.MATERIAL_NAME,
        rules.NO_JOINT,
        rules.RENAMED,
        rules.TINY_MASS,
        rules.AXIS_FRAME,
        rules.COMPUTED_INERTIA,
        rules.FRAME_MADE_LINK,
        rules.HUNG_ROOT,
        rules.JOINT_END,
        rules.MOVED_FRAME,
        rules.NESTED_MODEL,
        rules.UNBOUNDED_LIMIT,
    }
)
_VERSION = "/sdf/@version"
_LANGUAGES: dict[Format, Language] = {Format.URDF: "urdf", Format.SDF: "sdf"}


def own_form(loaded: LoadResult, document: Document) -> Form:
    """Return the file itself as a form."""
    return Form(document.format, loaded.content or b"")


def converted_form(source: Input, name: str, to: Format, load_options: LoadOptions, model: str | None = None) -> Form:
    """Convert the file into a format; `model` chooses one of several."""
    # The file is converted and its losses are counted, instead of judging it by its kind: a world,
    # a <plugin> or a frame may be lost or not.
    request = ConversionRequest(to=_LANGUAGES[to], model=model, comments=False)
    try:
        made = run_conversion(request, source, load_options, name=name)
    except CompileError as error:
        return Form(to, errors=tuple(each for each in error.diagnostics if each.is_error))
    return Form(to, made.text.encode(), made.ledger.entries)


@dataclass(frozen=True, slots=True)
class ConsumerReading:
    """One consumer, and what it makes of each form that it reads."""

    profile: Profile
    forms: Mapping[Format, Assessment]

    def best(self, preferred: Format) -> Assessment | None:
        """Return the assessment of the form with the least loss; of the preferred one where both are equal."""
        ranked = sorted(self.forms, key=lambda each: (_total_loss(self.forms[each]), each is not preferred))
        return self.forms[ranked[0]] if ranked else None


def readings(
    forms: Mapping[Format, Form], profiles: Sequence[Profile], load_options: LoadOptions, name: str
) -> Iterator[ConsumerReading]:
    """Yield every consumer, with what it makes of the forms that exist and that it reads."""
    found = {
        format_: assess_file(form.text, profiles, load_options, name=name)
        for format_, form in forms.items()
        if form.exists
    }
    for number, profile in enumerate(profiles):
        of_it = {format_: each[number] for format_, each in found.items()}
        yield ConsumerReading(profile, {format_: one for format_, one in of_it.items() if one.reads})


def _total_loss(assessment: Assessment) -> tuple[int, int]:
    """Return how often a consumer refuses the form, and how much it drops or misreads."""
    refused = len(assessment.by(Effect.REFUSES))
    return refused, len(assessment.by(Effect.DROPS)) + len(assessment.by(Effect.MISREADS))


@dataclass(frozen=True, slots=True)
class Facts:
    """What the choice depends on: the document, both forms of it, and whether it is made by macros."""

    document: Document
    forms: Mapping[Format, Form]
    macros: bool = False

    def losses(self, format_: Format) -> tuple[Loss, ...]:
        """Return what a format does not express; nothing for the format of the file itself."""
        return () if self.document.format is format_ else tuple(self.forms[format_].losses())


class Choice(NamedTuple):
    """The format that the model is best edited in, and the reasons."""

    format: Format
    reasons: tuple[str, ...]


class _Reason(NamedTuple):
    """A reason for a format; its `words` are empty where it does not hold. Decisive reasons outweigh others."""

    format: Format
    decisive: bool
    words: Callable[[Facts], str]


def choose(facts: Facts) -> Choice:
    """Choose the format of the first decisive reason that holds, or else of the first one, with all reasons for it."""
    holding = [(each, words) for each in _REASONS if (words := each.words(facts))]
    # `min` keeps the first of equals, so the order of the table is the order of reasons.
    first = min(holding, key=lambda one: not one[0].decisive)[0]
    return Choice(first.format, tuple(words for each, words in holding if each.format is first.format))


def _is_a_scene(facts: Facts) -> str:
    number = sum(1 for _ in candidates(facts.document))
    if facts.document.worlds:
        return f"it is a world of {_count(number, 'model')}; URDF holds one robot, and nothing around it"
    return f"it has {number} models; URDF holds one" if number > 1 else ""


def _cannot_be(facts: Facts, format_: Format) -> str:
    # That several models are in a file is a reason of its own, and no fault of the model.
    errors = [each for each in facts.forms[format_].errors if each.rule is not MODEL_NOT_CHOSEN]
    return f"it cannot be written as {format_.upper()}: {errors[0].message}" if errors else ""


def _has_macros(facts: Facts) -> str:
    return "its macros are the source, and both formats are made from them" if facts.macros else ""


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


def _losses_in(facts: Facts, format_: Format) -> str:
    """Sum up losses, such as `7 parts have no URDF equivalent (5 sdf-only, 2 cut-loop)`."""
    losses = facts.losses(format_)
    if not losses:
        return ""
    total = sum(each.number for each in losses)
    alone = len(losses) == 1
    kinds = ", ".join(each.rule if alone else f"{each.number} {each.rule}" for each in losses[:3])
    more = f" and {_count(len(losses) - 3, 'other kind')}" if len(losses) > 3 else ""
    return f"{_count(total, 'part')} {'has' if total == 1 else 'have'} no {format_.upper()} equivalent ({kinds}{more})"


def _count(number: int, word: str) -> str:
    return f"{number} {word}{'' if number == 1 else 's'}"


_REASONS = (
    _Reason(Format.SDF, True, _is_a_scene),
    _Reason(Format.SDF, True, partial(_cannot_be, format_=Format.URDF)),
    _Reason(Format.URDF, True, _has_macros),
    _Reason(Format.URDF, True, partial(_cannot_be, format_=Format.SDF)),
    _Reason(Format.SDF, True, partial(_losses_in, format_=Format.URDF)),
    _Reason(Format.URDF, True, _is_driven),
    _Reason(Format.URDF, True, partial(_losses_in, format_=Format.SDF)),
    _Reason(Format.SDF, False, _is_scenery),
    _Reason(Format.URDF, False, _is_a_robot),
)


@dataclass(frozen=True, slots=True)
class Advice:
    """The format that a robot is best kept in and why, its other form, and what each consumer makes of both."""

    path: str
    format: Format
    version: str | None
    name: str
    choice: Choice
    other: Form
    consumers: tuple[ConsumerReading, ...]


def advise(
    source: Input,
    profiles: Iterable[Profile],
    load_options: LoadOptions,
    *,
    name: str = "",
    model: str | None = None,
) -> Advice:
    """Say which format a robot is best kept in, and what each consumer would lose; `model` chooses one of several.

    Raises:
        CompileError: the file has errors that leave no model.
    """
    loaded = read(source, load_options, name=name)
    document = loaded.document
    if document is None or not loaded.accepted:
        raise loaded.error()
    macros = loaded.path.lower().endswith(XACRO) or bool(loaded.origins)
    other = document.format.counterpart
    converted = partial(converted_form, source, loaded.path, load_options=load_options, model=model)
    forms = {
        document.format: converted(document.format) if loaded.is_mjcf else own_form(loaded, document),
        other: converted(other),
    }
    return Advice(
        loaded.path,
        loaded.format or document.format,
        None if loaded.is_mjcf else document.version,
        next((each.name for each in (*document.models, *document.worlds)), ""),
        choose(Facts(document, forms, macros)),
        forms[other],
        tuple(readings(forms, tuple(profiles), load_options, loaded.path)),
    )


def assess_file(
    source: Input, profiles: Iterable[Profile], load_options: LoadOptions, *, name: str = ""
) -> tuple[Assessment, ...]:
    """Return what each consumer makes of a file, the bytes of one or a document; it is read once."""
    loaded = inspect(read(source, load_options, name=name), load_options)
    return assess(subject_of(loaded, load_options), profiles)
