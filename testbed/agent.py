"""A client of `twinform mcp`, by the official SDK, over standard input and output."""

import sys
from collections.abc import Awaitable, Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from mcp import Client, StdioServerParameters, stdio_client
from mcp.types import TextContent


@dataclass(frozen=True)
class Agent:
    """A session with a server."""

    session: Client

    async def ask(self, tool: str, **given: object) -> dict[str, Any]:
        """Return the answer of a tool.

        Raises:
            ValueError: it has none; the message says why.
        """
        result = await self.session.call_tool(tool, given)
        if result.is_error or result.structured_content is None:
            raise ValueError("\n".join(each.text for each in result.content if isinstance(each, TextContent)))
        return result.structured_content


async def agent(root: Path, work: Callable[[Agent], Awaitable[None]]) -> None:
    """Start a server for a folder, and let somebody work with it."""
    program = StdioServerParameters(command=sys.executable, args=["-P", "-m", "twinform", "mcp", str(root)])
    async with Client(stdio_client(program)) as session:
        await work(Agent(session))
