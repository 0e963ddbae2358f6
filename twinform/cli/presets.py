"""Presets: names for settings that belong together, which single settings and options go before."""

from collections.abc import Mapping
from dataclasses import field
from typing import Literal, get_args

import click

from twinform.cli.rule_settings import RuleSettings
from twinform.dataclass import dataclass
from twinform.diagnostics.sink import WARNINGS

PresetName = Literal["default", "strict", "doctor"]
_KEY = f"{__name__}.preset"


@dataclass(frozen=True, slots=True)
class Preset:
    """What a preset says: the defaults of options by their names, and the rules that count."""

    defaults: Mapping[str, object] = field(default_factory=dict[str, object])
    rules: RuleSettings = RuleSettings()


PRESETS: Mapping[PresetName, Preset] = {
    "default": Preset(),
    "strict": Preset({"strict": True}, RuleSettings(deny=(WARNINGS,))),
    "doctor": Preset({"notes": True, "check_passes": "check-inertia,check-limits,check-plugins"}),
}
"""The presets: what is usual; nothing that is unknown, and no warning; all that there is to find."""


def preset_of(ctx: click.Context) -> Preset | None:
    """Return the preset that was given on the command line."""
    found = ctx.meta.get(_KEY)
    return found if isinstance(found, Preset) else None


def with_preset(ctx: click.Context, defaults: Mapping[str, object]) -> dict[str, object]:
    """Return the defaults of options with those of the preset on the command line, which wins over a configuration."""
    preset = preset_of(ctx)
    return {**defaults, **(preset.defaults if preset else {})}


def _use(ctx: click.Context, _option: click.Parameter, value: PresetName | None) -> None:
    if value is not None:
        ctx.meta[_KEY] = PRESETS[value]
        ctx.default_map = with_preset(ctx, ctx.default_map or {})


preset_option = click.option(
    "--preset",
    type=click.Choice(get_args(PresetName)),
    is_eager=True,
    expose_value=False,
    callback=_use,
    help="Settings that belong together: 'strict' refuses what is unknown and takes warnings for errors, 'doctor' has "
    "notes and all passes that only look.",
)
