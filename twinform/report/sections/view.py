"""The 3D view: a page of its own in a frame without rights, and what it shows in words."""

from twinform.report.content import Report
from twinform.report.frame import framed
from twinform.report.markup import Markup, element, join
from twinform.report.parts import count


def view(report: Report) -> Markup | None:
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


def _boxes(report: Report) -> Markup | None:
    """That boxes stand for meshes, which would else be taken for the robot."""
    missing = sum(bool(each.problem and each.visuals) for each in report.first.meshes)
    if not missing:
        return None
    words = f"Wire boxes stand for {count(missing, 'mesh file')} that could not be read: "
    return element("p", words, element("a", "why", href="#meshes"), ".", class_="warning")


def _words(report: Report) -> Markup:
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
