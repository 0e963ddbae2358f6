"""Makes the reference page of the commands from their help."""

from collections.abc import Iterator

import click

from twinform.cli import main as program
from twinform.cli.command import Command

_INTRODUCTION = """\
# Commands

Every command with its options and examples, as `twinform COMMAND --help` prints them.
"""
_WIDTH = 10_000
"""The width of help texts, whose lines must not be broken."""


def commands_page() -> str:
    """Write all commands as Markdown."""
    return "\n".join([_INTRODUCTION, *(_chapter(name, command) for name, command in _commands(program, ()))])


def _commands(group: click.Group, above: tuple[str, ...]) -> Iterator[tuple[str, click.Command]]:
    context = click.Context(group)
    for name in group.list_commands(context):
        found = group.get_command(context, name)
        if isinstance(found, click.Group):
            yield from _commands(found, (*above, name))
        elif found is not None:
            yield " ".join(("twinform", *above, name)), found


def _chapter(name: str, command: click.Command) -> str:
    around = program.make_context("twinform", [], resilient_parsing=True)  # whose settings count in all commands
    context = click.Context(command, around, name, max_content_width=_WIDTH, terminal_width=_WIDTH)
    usage = " ".join([name, *command.collect_usage_pieces(context)])
    records = (parameter.get_help_record(context) for parameter in command.get_params(context))
    options = "\n".join(f"| `{_cell(names)}` | {_cell(text)} |" for names, text in filter(None, records) if text)
    shown = command.examples.items() if isinstance(command, Command) else ()
    examples = "\n".join(f"{what}:\n\n```sh\n{typed}\n```\n" for what, typed in shown)
    about = "\n\n".join(_escape_paragraph(part) for part in (command.help or "").split("\n\n"))
    listed = f"| option | what it does |\n| --- | --- |\n{options}"
    return f"## {name}\n\n```text\n{usage}\n```\n\n{about}\n\n{listed}\n\n{examples}"


def _escape_paragraph(text: str) -> str:
    """Write a paragraph in one line, and escape Markdown and HTML."""
    words = " ".join(text.replace("\b", "").split())
    return words.replace("<", "&lt;").replace("*", "\\*").replace("_", "\\_")


def _cell(text: str) -> str:
    return " ".join(text.split()).replace("|", "\\|").replace("<", "&lt;")
