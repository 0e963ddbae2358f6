"""Exit codes, and the exception that ends a command with a message."""

import click

FINDINGS = 1
"""Exit code: the files could be read, and there are errors in them."""

UNUSABLE = 2
"""Exit code: a file could not be read or written, or the command line is wrong."""


class Unusable(click.ClickException):
    """Ends the command with a message and the exit code of wrong usage."""

    exit_code = UNUSABLE
