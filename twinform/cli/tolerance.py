"""The option for what counts as rounding when robots are compared."""

import click

from twinform.compiler.compare import TOLERANCE

tolerance_option = click.option(
    "--tolerance",
    type=click.FloatRange(min=0),
    default=TOLERANCE,
    show_default=True,
    help="The relative difference that counts as rounding; absolute for positions (m) and angles (rad).",
)
