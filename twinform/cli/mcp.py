"""`twinform mcp`."""

import os
from collections.abc import Callable, Coroutine
from functools import wraps
from inspect import getdoc
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from twinform import __version__
from twinform.cli.command import Command, Unusable
from twinform.file_access import CEILING

if TYPE_CHECKING:
    from mcp.server import MCPServer

    from twinform.cli.model_tools import Answer, ModelTools
    from twinform.server.worker import Worker

EXAMPLES = {
    "What an agent starts, for the files below its current folder": "twinform mcp",
    "For the files below another one": "twinform mcp models",
}
_INSTRUCTIONS = """\
Tools for robot models in URDF, SDF, MJCF and xacro. `check` says what is wrong with a file, at which line and \
column. `fix` shows what would fix it, and changes the file with write=true. Where it offers nothing, `explain` says \
what a rule wants, and `schema` what may stand in an element. After an edit, check the file again."""


@click.command("mcp", cls=Command, examples=EXAMPLES)
@click.argument("root", type=click.Path(exists=True, file_okay=False, path_type=Path), default=".")
def command(root: Path) -> None:
    """Serve agents and scripts by the Model Context Protocol.

    A program that speaks the protocol starts it, and talks to it on standard input and output. Its tools check,
    explain, fix, convert, compare and measure models, and say what may stand in an element. They take files below ROOT,
    by default the current folder; what a model names is read there and in the folders that ROS and Gazebo search.
    """
    os.chdir(root)
    os.environ[CEILING] = str(Path.cwd())  # for the process of the worker too
    from twinform.cli.model_tools import ModelTools  # noqa: PLC0415 - the help needs none of it
    from twinform.server.worker import Worker  # noqa: PLC0415 - as above

    worker = Worker()
    try:
        make_server(ModelTools(Path.cwd()), worker).run()
    except ImportError as error:
        from twinform.installation import install_command  # noqa: PLC0415 - most have what they need

        raise Unusable(f"the server needs {error.name or 'mcp'}; run: {install_command('mcp')}") from error
    finally:
        worker.stop()


def make_server(tools: "ModelTools", worker: "Worker") -> "MCPServer":
    """Return a server whose tools run in the process of a worker."""
    from mcp.server import MCPServer  # noqa: PLC0415 - an extra has its library
    from mcp.types import ToolAnnotations  # noqa: PLC0415 - as above

    from twinform.cli.model_tools import TOOLS, WRITERS  # noqa: PLC0415 - as above

    server = MCPServer("twinform", version=__version__, instructions=_INSTRUCTIONS, log_level="CRITICAL")
    for name in TOOLS:
        hints = ToolAnnotations(read_only_hint=name not in WRITERS, open_world_hint=False)
        tool = _run_in(worker, tools, name)
        server.add_tool(tool, name, description=getdoc(tool), annotations=hints)
    return server


def _run_in(worker: "Worker", tools: "ModelTools", name: str) -> "Callable[..., Coroutine[Any, Any, Answer]]":
    """Return a tool that is run in the process of a worker; its signature and docstring are what agents are told."""
    from mcp.server.mcpserver.exceptions import ToolError  # noqa: PLC0415 - an extra has its library

    from twinform.cli.model_tools import answer  # noqa: PLC0415 - as above
    from twinform.server.worker import TaskError  # noqa: PLC0415 - as above

    @wraps(getattr(tools, name))
    async def tool(**given: Any) -> "Answer":
        try:
            found = await worker.run(answer, tools, name, given)
        except TaskError as error:
            raise ToolError(str(error)) from error
        if isinstance(found, str):
            raise ToolError(found)
        return found

    return tool
