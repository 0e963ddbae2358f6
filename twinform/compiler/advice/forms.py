"""Both forms of a model, URDF and SDF: the text of each, and what it could not express of the source."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import groupby
from typing import NamedTuple

from twinform.compiler.conversion_error import CompileError
from twinform.compiler.driver import run_conversion
from twinform.compiler.input.load_options import Input, LoadOptions, LoadResult
from twinform.compiler.request import ConversionRequest
from twinform.compiler.request_options import Language
from twinform.diagnostics import Diagnostic, Fate, LedgerEntry, rules
from twinform.ir import Document, Format


class Loss(NamedTuple):
    """Parts of one kind that a format does not express: how many there are, and what is said of the first."""

    rule: str
    fate: Fate
    number: int
    example: str


@dataclass(frozen=True, slots=True)
class Form:
    """A model in one format: its text and what that does not express, or the errors for which there is none."""

    format: Format
    text: bytes = b""
    entries: tuple[LedgerEntry, ...] = ()
    errors: tuple[Diagnostic, ...] = ()

    @property
    def exists(self) -> bool:
        """Whether the model can be written in this format."""
        return not self.errors

    def losses(self) -> Iterator[Loss]:
        """What other readers of this format do not see, or see otherwise: the gravest and most frequent kinds first."""
        told = sorted(filter(_is_of_the_robot, self.entries), key=_kind)
        groups = [(kind, list(entries)) for kind, entries in groupby(told, _kind)]
        for (rule, fate), entries in sorted(groups, key=lambda group: _gravity(group[1]), reverse=True):
            yield Loss(rule, Fate(fate), len(entries), entries[0].message)


def _is_of_the_robot(entry: LedgerEntry) -> bool:
    return entry.rule not in _THE_SAME_ROBOT and entry.location.path != _VERSION


def _gravity(entries: list[LedgerEntry]) -> tuple[int, int]:
    return entries[0].rule.severity, len(entries)


def _kind(entry: LedgerEntry) -> tuple[str, str]:
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
    """The file as it stands."""
    return Form(document.format, loaded.content or b"")


def converted_form(source: Input, name: str, to: Format, load_options: LoadOptions, model: str | None = None) -> Form:
    """The model converted into a format; `model` is the one of several."""
    # The file is converted and its losses are counted, instead of judging it by its kind: a world,
    # a <plugin> or a frame may be lost or not.
    request = ConversionRequest(to=_LANGUAGES[to], model=model, comments=False)
    try:
        made = run_conversion(request, source, load_options, name=name)
    except CompileError as error:
        return Form(to, errors=tuple(each for each in error.diagnostics if each.is_error))
    return Form(to, made.text.encode(), made.ledger.entries)
