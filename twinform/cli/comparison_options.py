"""The options on how robots are compared."""

import click

from twinform.cli.flags import group
from twinform.compiler.compare import TOLERANCE, ComparisonOptions


def _options(tolerance: float, *, read_carriers: bool) -> ComparisonOptions:
    return ComparisonOptions(tolerance, read_carriers)


comparison_options = group(
    "comparison",
    _options,
    click.option(
        "--tolerance",
        type=click.FloatRange(min=0),
        default=TOLERANCE,
        show_default=True,
        help="The relative difference that counts as rounding; absolute for positions (m) and angles (rad).",
    ),
    click.option(
        "--carriers/--no-carriers",
        "read_carriers",
        default=False,
        help="Whether what only carriers say counts as written, or is a difference of its own kind.",
    ),
)
"""Gives a command the options."""
