"""The 3D view of robots in a browser, on viser: `twinform view`, and pages that open without a server."""

from twinform.view.static_pages import (
    NotDrawn,
    StandaloneView,
    new_viewer,
    standalone_page,
    standalone_view,
)
from twinform.view.subject import PortTakenError, ViewerMissingError, ViewError, ViewSubject, read_subject

__all__ = [
    "NotDrawn",
    "PortTakenError",
    "StandaloneView",
    "ViewError",
    "ViewSubject",
    "ViewerMissingError",
    "new_viewer",
    "read_subject",
    "standalone_page",
    "standalone_view",
]
