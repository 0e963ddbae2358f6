"""`twinform lsp`."""

import click

from twinform.cli.command import Command, Unusable

EXAMPLES = {"What an editor starts; editors/ has the settings of each": "twinform lsp"}


@click.command("lsp", cls=Command, examples=EXAMPLES)
@click.option(
    "--stdio", is_flag=True, help="Talk on standard input and output, which is the only way; for editors that insist."
)
def command(*, stdio: bool) -> None:
    """Be the language server of an editor.

    Editors start it, and talk to it on standard input and output. The settings of each are in the folder editors/.
    """
    del stdio
    try:
        from twinform.server.serving import serve  # noqa: PLC0415 - an extra has its library
    except ImportError as error:
        from twinform.installation import install_command  # noqa: PLC0415 - see above

        raise Unusable(f"the language server needs {error.name or 'pygls'}; run: {install_command('lsp')}") from error
    from twinform.cli.editor_settings import settings_of  # noqa: PLC0415 - see above

    click.get_current_context().exit(serve(settings_of))
