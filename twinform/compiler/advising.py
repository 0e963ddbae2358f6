"""`twinform advise`: which format a robot is best kept in, and what each consumer makes of every one.

The file is converted into the other formats that consumers read. A table of reasons, each measured on the file itself,
decides which format it is best kept in, and the profiles of all consumers are asked about each.
"""

from collections import Counter
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
from twinform.compiler.read_otherwise import read_otherwise
from twinform.compiler.request import ConversionRequest
from twinform.dataclass import dataclass
from twinform.diagnostics import Diagnostic, Fate, LedgerEntry, rules
from twinform.diagnostics.rules import MODEL_NOT_CHOSEN
from twinform.diagnostics.wording import plural
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
_LANGUAGES: dict[Format, Language] = {Format.URDF: "urdf", Format.SDF: "sdf", Format.MJCF: "mjcf"}


def own_form(loaded: LoadResult, document: Document) -> Form:
    """Return the file itself as a form."""
    return Form(loaded.format or document.format, loaded.content or b"")


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
    """What the choice depends on: the document, its format, the forms to choose from, and whether macros make it."""

    document: Document
    own: Format
    rivals: Mapping[Format, Form]
    macros: bool = False

    def losses(self, format_: Format) -> tuple[Loss, ...]:
        """Return what a format does not express; nothing for that of the file itself, and for one that is no choice."""
        form = self.rivals.get(format_)
        return () if format_ is self.own or form is None else tuple(form.losses())


class Choice(NamedTuple):
    """The format that the model is best edited in, and the reasons."""

    format: Format
    reasons: tuple[str, ...]


class _Reason(NamedTuple):
    """A reason for a format; its `words` are empty where it does not hold. Decisive reasons outweigh others.

    Without a format, it is one for that of the file itself. A `told` reason is said whatever is chosen.
    """

    format: Format | None
    decisive: bool
    words: Callable[[Facts], str]
    told: bool = False


def choose(facts: Facts) -> Choice:
    """Choose the format of the first decisive reason that holds, or else of the first one, with all reasons for it."""
    # `min` keeps the first of equals, so the order of the table is the order of reasons.
    found = [(each.format or facts.own, each, words) for each in _REASONS if (words := each.words(facts))]
    holding = [one for one in found if one[0] in facts.rivals]
    kept = min(holding, key=lambda one: not one[1].decisive)[0] if holding else facts.own
    return Choice(kept, tuple(words for format_, each, words in holding if format_ is kept or each.told))


def _is_a_scene(facts: Facts) -> str:
    if facts.own is Format.MJCF:  # which holds worlds as well
        return ""
    number = sum(1 for _ in candidates(facts.document))
    if facts.document.worlds:
        return f"it is a world of {plural(number, 'model')}; URDF holds one robot, and nothing around it"
    return f"it has {number} models; URDF holds one" if number > 1 else ""


def _cannot_be(facts: Facts, format_: Format) -> str:
    form = facts.rivals.get(format_)
    # That several models are in a file is a reason of its own, and no fault of the model.
    errors = [each for each in form.errors if each.rule is not MODEL_NOT_CHOSEN] if form else []
    return f"it cannot be written as {format_.upper()}: {errors[0].message}" if errors else ""


def _has_macros(facts: Facts) -> str:
    return "its macros are the source, and other formats are made from them" if facts.macros else ""


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


def _is_read_otherwise(facts: Facts) -> str:
    found = read_otherwise(facts.document) if Format.MJCF in facts.rivals else ()
    return f"MuJoCo reads the URDF otherwise than the MJCF: it {', '.join(found)}" if found else ""


def _is_mjcf(facts: Facts) -> str:
    return "MuJoCo reads it as it is" if facts.own is Format.MJCF else ""


def _is_a_robot(_: Facts) -> str:
    return "ROS, RViz and MoveIt read URDF alone, and Gazebo reads the SDF that is made from it"


def _losses_in(facts: Facts, format_: Format) -> str:
    """Sum up losses, such as `7 parts have no URDF equivalent (5 sdf-only, 2 cut-loop)`."""
    losses = facts.losses(format_)
    if not losses:
        return ""
    numbers = Counter[str]()  # of one rule, some parts may be approximated and others dropped
    for each in losses:
        numbers[each.rule] += each.number
    total = numbers.total()
    alone = len(numbers) == 1
    kinds = ", ".join(rule if alone else f"{number} {rule}" for rule, number in [*numbers.items()][:3])
    more = f" and {plural(len(numbers) - 3, 'other kind')}" if len(numbers) > 3 else ""
    return f"{plural(total, 'part')} {'has' if total == 1 else 'have'} no {format_.upper()} equivalent ({kinds}{more})"


_REASONS = (
    _Reason(Format.SDF, True, _is_a_scene),
    *(_Reason(None, True, partial(_cannot_be, format_=each)) for each in (Format.URDF, Format.MJCF)),
    _Reason(Format.URDF, True, _has_macros),
    _Reason(None, True, partial(_cannot_be, format_=Format.SDF)),
    _Reason(None, True, partial(_losses_in, format_=Format.URDF)),
    _Reason(Format.URDF, True, _is_driven),
    *(_Reason(None, True, partial(_losses_in, format_=each)) for each in (Format.SDF, Format.MJCF)),
    _Reason(Format.MJCF, False, _is_read_otherwise, told=True),
    _Reason(Format.MJCF, False, _is_mjcf),
    _Reason(Format.SDF, False, _is_scenery),
    _Reason(Format.URDF, False, _is_a_robot),
)


@dataclass(frozen=True, slots=True)
class Advice:
    """The format that a robot is best kept in and why, its forms, and what each consumer makes of them.

    `rivals` are the forms to choose from, and `formats` all that consumers were asked about.
    """

    path: str
    format: Format
    version: str | None
    name: str
    choice: Choice
    rivals: Mapping[Format, Form]
    formats: tuple[Format, ...]
    consumers: tuple[ConsumerReading, ...]

    @property
    def other(self) -> Form:
        """The form that the file is first made into."""
        return next(form for format_, form in self.rivals.items() if format_ is not self.format)


def rivals_of(own: Format, profiles: Sequence[Profile]) -> tuple[Format, ...]:
    """Return the formats to choose from: URDF and SDF, or MJCF where all consumers read that."""
    if profiles and all(Format.MJCF in each.formats for each in profiles):
        return tuple(dict.fromkeys((own, Format.MJCF, Format.URDF)))
    return tuple(dict.fromkeys((own, own.counterpart, Format.URDF, Format.SDF)))


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
    document, profiles = loaded.document, tuple(profiles)
    if document is None or not loaded.accepted:
        raise loaded.error()
    own = loaded.format or document.format
    # What MJCF includes has its origins too, and no macros.
    macros = loaded.path.lower().endswith(XACRO) or (bool(loaded.origins) and own is not Format.MJCF)
    rivals = rivals_of(own, profiles)
    asked = {*rivals, *(format_ for each in profiles for format_ in each.formats)}
    forms = {own: own_form(loaded, document)}
    for format_ in (*rivals, *sorted(asked.difference(rivals))):
        if format_ is not own:
            forms[format_] = converted_form(source, loaded.path, format_, load_options, model)
    among = {format_: forms[format_] for format_ in rivals}
    return Advice(
        loaded.path,
        own,
        document.version if own is document.format else None,
        next((each.name for each in (*document.models, *document.worlds)), ""),
        choose(Facts(document, own, among, macros)),
        among,
        tuple(each for each in Format if each in forms),
        tuple(readings(forms, profiles, load_options, loaded.path)),
    )


def assess_file(
    source: Input, profiles: Iterable[Profile], load_options: LoadOptions, *, name: str = ""
) -> tuple[Assessment, ...]:
    """Return what each consumer makes of a file, the bytes of one or a document; it is read once."""
    loaded = inspect(read(source, load_options, name=name), load_options)
    return assess(subject_of(loaded, load_options), profiles)
