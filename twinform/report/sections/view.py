"""The 3D view: a page of its own in a frame without rights, and what it shows in words."""

from twinform.report.content import ModelReport
from twinform.report.frame import framed
from twinform.report.html_parts import count, table
from twinform.report.markup import Markup, element, join


def view(report: ModelReport) -> Markup | None:
    """The frame, or why there is none."""
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
        return join((frame, _boxes(report), _words(report)))
    return element("p", f"There is no 3D view: {report.without_view}.")


def _boxes(report: ModelReport) -> Markup | None:
    """What is not drawn and why, since boxes would else be taken for the robot."""
    missing = report.not_drawn
    if not missing:
        return None
    words = f"Wire boxes stand for {count(len(missing), 'shape')} that could not be drawn:"
    rows = ((each.link, f"{each.role} {each.name}".rstrip(), each.problem) for each in missing)
    listed = table("Shapes that are not drawn", ("Link", "Shape", "Reason"), rows)
    return join((element("p", words, class_="warning"), listed))


def _words(report: ModelReport) -> Markup:
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
