"""Access to the 3D view: only for a page that was opened by its address, which has a token, on this machine."""

import dataclasses
import importlib
import logging
import secrets
from collections.abc import Callable, Generator, Sequence
from contextlib import contextmanager
from functools import partial
from http import HTTPStatus
from typing import Any

# The port is not compared: it may be forwarded from another machine by SSH.
_LOCAL_HOSTS = frozenset({"127.0.0.1", "localhost"})
_REFUSAL = "Open the address that twinform view has printed.\n"
_server: Any = importlib.import_module("websockets.asyncio.server")


class Access:
    """The token of a server, and the checks that every request has to pass."""

    def __init__(self) -> None:
        self.token = secrets.token_urlsafe(24)

    def allows(self, path: str, hosts: Sequence[str], origins: Sequence[str]) -> bool:
        """Return whether a request for a path is allowed; `hosts` and `origins` are the values of these headers.

        Any web page can make a browser send requests to this server. It does not know the token; where it asks for a
        WebSocket, the origin is its own; and where it has its own name lead to this machine, that name is the host.
        """
        host = hosts[0] if len(hosts) == 1 else ""
        # Every web page can make a browser connect to a port of its own machine, and WebSockets are
        # not bound to one origin. The check of `Host` is against names that an attacker makes
        # resolve to this machine (DNS rebinding).
        is_local = host.partition(":")[0] in _LOCAL_HOSTS
        is_own = all(origin in {f"http://{host}", f"https://{host}"} for origin in origins)
        # viser's client opens its WebSocket at the address that it was loaded from, so one token
        # covers both. Users of the same machine who can list processes see it in the command line
        # of the browser; --no-open keeps it out.
        given = path.partition("?")[0].removeprefix("/").partition("/")[0]
        has_token = secrets.compare_digest(given.encode(errors="surrogateescape"), self.token.encode())
        return is_local and is_own and has_token

    @contextmanager
    def guard(self) -> Generator[None]:
        """Make WebSocket servers that are started in the block refuse all other requests, including those for pages."""
        # what it refuses, or cannot read, is nothing for the terminal
        logging.getLogger("websockets.server").addHandler(logging.NullHandler())
        # viser makes its server deep inside, and has no hook for requests
        serve = _server.serve
        _server.serve = partial(self._serve, serve)
        try:
            yield
        finally:
            _server.serve = serve

    def _serve(self, serve: Callable[..., Any], *arguments: Any, process_request: Any, **options: Any) -> Any:
        return serve(*arguments, process_request=partial(self._process, process_request), **options)

    def _process(self, process_request: Callable[..., Any], connection: Any, request: Any) -> Any:
        headers = request.headers
        if not self.allows(request.path, headers.get_all("Host"), headers.get_all("Origin")):
            return connection.respond(HTTPStatus.FORBIDDEN, _REFUSAL)
        inside = request.path.removeprefix("/").removeprefix(self.token) or "/"
        return process_request(connection, dataclasses.replace(request, path=inside))
