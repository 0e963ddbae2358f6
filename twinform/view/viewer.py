"""The 3D view in a browser: a server on this machine alone, which shows one robot, or two overlaid.

Only a page that was opened by its address gets in: the address has a token.
"""

import contextlib
import dataclasses
import importlib
import io
import logging
import math
import secrets
import socket
from collections.abc import Callable, Generator, Iterable, Sequence
from contextlib import AbstractContextManager, contextmanager
from functools import partial
from http import HTTPStatus
from pathlib import Path
from threading import RLock
from typing import Any

from twinform.compiler.compare.comparison import Comparison
from twinform.compiler.graph.graph import shortened
from twinform.compiler.kinematics import Positions
from twinform.view import words
from twinform.view.figure import Figure, Handle, Look, aim
from twinform.view.joint_controls import Choices
from twinform.view.panel import Panel
from twinform.view.subject import PortTakenError, ViewSubject
from twinform.view.triangles import MeshDrawings

np: Any = importlib.import_module("numpy")
viser: Any = importlib.import_module("viser")

# There is no option for another address, and a port that is taken is an error and not the next one.
HOST = "127.0.0.1"
_SECOND = Look(color=(60, 130, 220), opacity=0.45)
"""How B is drawn over A."""


class Viewer:
    """A server that shows subjects; with `port` 0 at any free port.

    Raises:
        PortTakenError: the port is not free.
    """

    def __init__(self, port: int = 0) -> None:
        self._access = Access()
        with _silence_output(), self._access.guard():
            # viser (MIT, 9 MB) has controls, clicks, and pages that open without a server. meshcat
            # had its last release in 2021 and has neither sliders nor clicks; rerun is an
            # application of its own for recordings; three.js with urdf-loader would read the file a
            # second time by its own rules and knows no SDF.
            self.server: Any = viser.ViserServer(host=HOST, port=_find_port(port), label="twinform", verbose=False)
        self._lock = RLock()
        self.panel: Panel | None = None
        self._shown = 0
        self.server.gui.configure_theme(control_width="large", show_logo=False, show_share_button=False)

    @property
    def address(self) -> str:
        """The address for a browser; requests that do not know all of it are refused."""
        return f"http://{HOST}:{self.server.get_port()}/{self._access.token}"

    @property
    def figures(self) -> Sequence[Figure]:
        """The figures that are shown."""
        return self.panel.figures if self.panel else ()

    def show(self, subjects: Sequence[ViewSubject], comparison: Comparison | None = None) -> None:
        """Show one subject, or two overlaid, in place of what is shown; joints and cameras stay."""
        with self._lock, self.server.atomic():
            choices = self.panel.choices if self.panel else Choices()
            is_first = self.panel is None
            if self.panel is not None:
                self.panel.ended = True
            self.server.scene.reset()
            self.server.gui.reset()
            self._shown += 1
            figures, grid = draw(self.server.scene, subjects, self._root, self._listen)
            self.panel = Panel(self.server.gui, subjects, figures, grid, comparison, choices, self._lock)
            self.panel.build()
            self.server.gui.set_panel_label(words.title(subjects))
            self.server.gui.main_panel.dock_right()
            for figure in figures:
                figure.move(choices.positions)
            if is_first:
                self.aim()
        self.server.flush()

    @property
    def _root(self) -> str:
        """The root node, which is new each time: browsers keep the poses of names that they know."""
        return f"/{self._shown}"

    def aim(self) -> None:
        """Move the cameras of all browsers, also of later ones, to where everything is seen."""
        if not self.figures:
            return
        for each in (self.server.initial_camera, *(it.camera for it in self.server.get_clients().values())):
            aim(each, self.figures)

    def move(self, positions: Positions) -> None:
        """Move joints to positions, as the sliders do."""
        if self.panel is not None:
            self.panel.move(positions)

    def select(self, link: str) -> None:
        """Mark a link, as a click on it does."""
        if self.panel is not None:
            self.panel.select([link])

    def warn(self, title: str, lines: Iterable[str] = ()) -> None:
        """Show above the controls what has gone wrong, until something else is shown."""
        if self.panel is not None:
            self.panel.warn(title, lines)

    def page(self, *, dark: bool = False) -> str:
        """Return a page that shows the same without a server, with joints at their positions."""
        labels = {name: text for figure in self.figures for name, text in figure.labels.items()}
        return words.with_script(self.server.scene.as_html(dark_mode=dark), labels)

    def _listen(self, figure: Figure, handle: Handle, link: str) -> None:
        if self.panel is not None:
            self.panel.listen(figure, handle, link)

    def stop(self) -> None:
        """Stop the server; browsers show that it is gone."""
        with _silence_output():
            self.server.stop()


def draw(
    api: Any, subjects: Sequence[ViewSubject], root: str, listen: Callable[[Figure, Handle, str], None] | None = None
) -> tuple[list[Figure], Handle]:
    """Draw subjects below a node of viser, the second one in a color of its own, and a grid under them."""
    figures: list[Figure] = []
    for subject, name, look in zip(subjects, "AB", (Look(), _SECOND), strict=False):
        meshes = MeshDrawings(subject.search, subject.beside)
        title = f"{name}: {shortened(Path(subject.path).name)}" if len(subjects) > 1 else ""
        figures.append(Figure(api, f"{root}/{name}", subject.scene, meshes, look, listen, title))
    size = max(figure.size for figure in figures)
    floor = min(float(figure.bounds()[0][2]) for figure in figures)
    cell = _power_of_ten(size / 4)
    where = (0.0, 0.0, min(floor, 0.0))
    grid = api.add_grid(f"{root}/grid", size * 6, size * 6, cell_size=cell, section_size=10 * cell, position=where)
    return figures, grid


def _power_of_ten(length: float) -> float:
    """Return the largest power of ten that is not longer."""
    return 10.0 ** math.floor(math.log10(length))


def _silence_output() -> AbstractContextManager[object]:
    """Suppress standard output: viser prints when it begins and ends."""
    return contextlib.redirect_stdout(io.StringIO())


def _find_port(port: int) -> int:
    """Return the port, or a free one for port 0.

    Raises:
        PortTakenError: it is not free.
    """
    with socket.socket() as probe:
        try:
            probe.bind((HOST, port))
        except (OSError, OverflowError) as error:
            raise PortTakenError(port) from error
        return int(probe.getsockname()[1])


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
