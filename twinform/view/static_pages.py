"""Pages with a 3D view that open without a server and ask for nothing: for reports and notebooks."""

from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from twinform.compiler.compare.comparison import Comparison
from twinform.compiler.input.load_options import unexpanded_name
from twinform.compiler.resolve_uris import SearchPath
from twinform.compiler.scene import build_scene
from twinform.dataclass import dataclass
from twinform.ir import Document
from twinform.view.subject import ViewerMissingError, ViewSubject

if TYPE_CHECKING:
    from twinform.view.viewer import Viewer


class NotDrawn(NamedTuple):
    """A shape that is drawn as a box of wire instead, and why; `robot` is 0 in the first document, 1 in the second."""

    link: str
    role: str
    name: str
    problem: str
    robot: int = 0


@dataclass(frozen=True, slots=True)
class StandaloneView:
    """A page with a 3D view, and the shapes that are not drawn in it."""

    page: str
    not_drawn: tuple[NotDrawn, ...] = ()


def new_viewer(port: int = 0) -> "Viewer":
    """Start a viewer, and import the libraries that it needs.

    Raises:
        ViewerMissingError: the libraries are not installed.
        PortTakenError: the port is not free.
    """
    try:
        import viser  # noqa: F401, PLC0415 # pyright: ignore[reportUnusedImport] - an extra

        from twinform.view.viewer import Viewer  # noqa: PLC0415 - it needs the extra
    except ImportError as error:
        raise ViewerMissingError(error.name or "viser") from error
    return Viewer(port)


def standalone_page(
    first: Document,
    second: Document | None = None,
    comparison: Comparison | None = None,
    *,
    dark: bool = False,
    search: SearchPath | None = None,
) -> str:
    """Return an HTML page that shows a document, or two overlaid, with every joint at zero.

    Differences that the comparison found are red. Meshes are looked for beside the files that the documents were read
    from, and in the folders of `search`.

    Raises:
        ViewerMissingError: the libraries are not installed.
    """
    return standalone_view(first, second, comparison, dark=dark, search=search).page


def standalone_view(
    first: Document,
    second: Document | None = None,
    comparison: Comparison | None = None,
    *,
    dark: bool = False,
    search: SearchPath | None = None,
) -> StandaloneView:
    """Return the page of `standalone_page`, with the shapes that could not be drawn.

    Raises:
        ViewerMissingError: the libraries are not installed.
    """
    viewer = new_viewer()
    try:
        folders = search or SearchPath.of()
        viewer.show([_make_subject(each, folders) for each in (first, second) if each is not None], comparison)
        not_drawn = tuple(
            NotDrawn(link, shape.role, shape.name, problem, robot)
            for robot, figure in enumerate(viewer.figures)
            for link, shape, problem in figure.problems()
        )
        return StandaloneView(viewer.page(dark=dark), not_drawn)
    finally:
        viewer.stop()


def _make_subject(document: Document, search: SearchPath) -> ViewSubject:
    file = unexpanded_name(document.location.file)
    return ViewSubject(document, build_scene(document), file if file and Path(file).is_file() else "", search)
