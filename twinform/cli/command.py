"""`Command`: a command whose help ends with examples."""

from collections.abc import Mapping
from typing import Any

import click


class Command(click.Command):
    """A command with `examples`: what they do, and how they are typed."""

    def __init__(self, *args: Any, examples: Mapping[str, str], **extra: Any) -> None:
        super().__init__(*args, **extra)
        self.examples = examples

    def format_epilog(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Print the examples; their lines are never broken, so that they can be copied."""
        super().format_epilog(ctx, formatter)
        with formatter.section("Examples"):
            for what, typed in self.examples.items():
                formatter.write_text(f"{what}:")
                formatter.write(f"{'':{formatter.current_indent + 2}}{typed}\n")
