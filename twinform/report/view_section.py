"""The 3D view: a page of its own in a frame without rights, and what it shows in words."""

import hashlib
from base64 import b64encode
from typing import NamedTuple

from twinform.report.content import ModelReport
from twinform.report.markup import Markup, count, element, join, table

# viser's client puts its program into a script element that it makes itself, and evaluates strings.
# Without a view, the policy of a report has no `unsafe` word at all.
_MAKES_SCRIPTS = (
    "(()=>{const make=document.createElement.bind(document);document.createElement=(name,...more)=>{"
    "const made=make(name,...more);if(String(name).toLowerCase()==='script')made.nonce='%s';return made}})()"
)

_REST = "base-uri 'none'; form-action 'none'"


def view(report: ModelReport) -> Markup | None:
    """Show the page of the 3D view in a frame without rights, or say why there is none."""
    if report.view:
        both = " and ".join(each.name for each in report.subjects)
        frame = element(
            "iframe",
            srcdoc=framed(report.view).page,
            sandbox="allow-scripts",
            loading="lazy",
            title=f"3D view of {both}",
            aria_describedby="view-in-words",
        )
        return join((frame, _list_missing_shapes(report), _describe_view(report)))
    return element("p", f"There is no 3D view: {report.without_view}.")


def _list_missing_shapes(report: ModelReport) -> Markup | None:
    """List the shapes that a box stands for in the view, which would otherwise be taken for the robot."""
    missing = report.not_drawn
    if not missing:
        return None
    words = f"Wire boxes stand for {count(len(missing), 'shape')} that could not be drawn:"
    rows = ((each.link, f"{each.role} {each.name}".rstrip(), each.problem) for each in missing)
    listed = table("Shapes that are not drawn", ("Link", "Shape", "Reason"), rows)
    return join((element("p", words, class_="warning"), listed))


def _describe_view(report: ModelReport) -> Markup:
    graph = report.first.graph
    summary = f"It shows {graph.summary()}, with every joint at zero. " if graph else ""
    if report.comparison and not report.comparison.same:
        summary = "The second robot is blue over the first one, and what differs is red, with every joint at zero. "
    return element(
        "p",
        f"{summary}Drag to turn, scroll to come nearer. The same parts are listed under ",
        element("a", "links and joints", href="#tree"),
        " and ",
        element("a", "masses and inertias", href="#masses"),
        ".",
        id="view-in-words",
        class_="quiet",
    )


class Framed(NamedTuple):
    """A page with nonces, and the nonce."""

    page: str
    nonce: str


def framed(page: str) -> Framed:
    """Give the scripts of a page a nonce, which they need to run in the frame."""
    nonce = b64encode(hashlib.sha256(page.encode()).digest(), b"-_").decode().rstrip("=")
    first = f'<script nonce="{nonce}">{_MAKES_SCRIPTS % nonce}</script>'
    return Framed(page.replace("<script", f'<script nonce="{nonce}"').replace("<head>", f"<head>{first}", 1), nonce)


def policy(style: str, script: str, nonce: str | None) -> str:
    """Return the Content-Security-Policy of a report: it loads nothing from elsewhere and runs no other script."""
    own = f"'sha256-{_hash(script)}'"
    if nonce is None:
        return f"default-src 'none'; img-src data:; style-src 'sha256-{_hash(style)}'; script-src {own}; {_REST}"
    # the client of the view evaluates strings, computes in WebAssembly and in workers, and sets styles
    return (
        f"default-src 'none'; img-src data: blob:; font-src data:; connect-src data: blob:; worker-src blob:; "
        f"style-src 'unsafe-inline'; script-src {own} 'nonce-{nonce}' 'unsafe-eval'; {_REST}"
    )


def _hash(text: str) -> str:
    return b64encode(hashlib.sha256(text.encode()).digest()).decode()
