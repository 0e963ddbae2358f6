"""Progress of passes on meshes: a terminal shows which mesh is worked on, since a large one takes minutes."""

import sys
from collections.abc import Generator, Iterable
from contextlib import contextmanager
from importlib.util import find_spec

from twinform.diagnostics.reporters import printable
from twinform.passes import FilesPass, Pass


@contextmanager
def mesh_progress(passes: Iterable[Pass]) -> Generator[None]:
    """Show which mesh the passes work on, if stderr is a terminal and rich is installed."""
    if not (sys.stderr.isatty() and any(isinstance(step, FilesPass) for step in passes) and find_spec("rich")):
        yield
        return
    from rich.console import Console  # noqa: PLC0415 - scripts do without
    from rich.markup import escape  # noqa: PLC0415 - as above

    from twinform.passes.meshes.mesh_pass import watched_by  # noqa: PLC0415 - few runs have meshes

    with Console(stderr=True).status("passes") as status:

        def show(uri: str | None) -> None:
            if uri is not None:
                status.update(escape(f"mesh {printable(uri)}"))

        with watched_by(show):
            yield
