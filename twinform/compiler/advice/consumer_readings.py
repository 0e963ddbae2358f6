"""What each consumer makes of a robot: of the file as it stands, of the other format, and once passes have helped."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from twinform.compiler.advice.forms import Form
from twinform.compiler.input.load_options import LoadOptions
from twinform.compiler.profiling import assess_file
from twinform.ir import Format
from twinform.profiles import Assessment, Effect, Profile


@dataclass(frozen=True, slots=True)
class ConsumerReading:
    """One consumer, and what it makes of each form that it reads."""

    profile: Profile
    forms: Mapping[Format, Assessment]

    def best(self, preferred: Format) -> Assessment | None:
        """What it makes of the form that it takes with the least loss; the preferred one where both are alike."""
        ranked = sorted(self.forms, key=lambda each: (_loss(self.forms[each]), each is not preferred))
        return self.forms[ranked[0]] if ranked else None


def readings(
    forms: Mapping[Format, Form], profiles: Sequence[Profile], load_options: LoadOptions, name: str
) -> Iterator[ConsumerReading]:
    """Every consumer, with what it makes of the forms that exist and that it reads."""
    found = {
        format_: assess_file(form.text, profiles, load_options, name=name)
        for format_, form in forms.items()
        if form.exists
    }
    for number, profile in enumerate(profiles):
        of_it = {format_: each[number] for format_, each in found.items()}
        yield ConsumerReading(profile, {format_: one for format_, one in of_it.items() if one.reads})


def _loss(assessment: Assessment) -> tuple[int, int]:
    """Whether it refuses the form, and how much it drops or reads otherwise."""
    refused = len(assessment.by(Effect.REFUSES))
    return refused, len(assessment.by(Effect.DROPS)) + len(assessment.by(Effect.MISREADS))
