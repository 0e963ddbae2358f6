"""The report as one page of HTML, which opens from disk and loads nothing: its sections in order.

The sections with the 3D view and the kinematic tree are made here; the others have modules of their own.
"""

import hashlib
from base64 import b64encode
from collections import defaultdict
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cache
from typing import NamedTuple

import twinform
from twinform.compiler.compare.comparison_reporters import summary
from twinform.compiler.graph import Graph, GraphJoint, GraphNode
from twinform.compiler.graph.layout import depth_first
from twinform.compiler.graph.svg import svg
from twinform.diagnostics import Diagnostic, Severity
from twinform.diagnostics.diagnostic import WORST_FIRST
from twinform.diagnostics.reporters.file_findings import Group, grouped
from twinform.diagnostics.reporters.text import excerpt
from twinform.ir.motion import spanning_tree
from twinform.package_files import package_files
from twinform.report.content import Converted, ModelReport, ReportSubject
from twinform.report.markup import Markup, Part, breakable, count, element, fates, folded, image, join, place, table
from twinform.report.number_sections import conversion, differences, masses, meshes, reach, statistics
from twinform.view import NotDrawn

MOST = 300
"""The most groups of a severity that are listed."""


_SHOWN = 5


def findings(report: ModelReport) -> Markup:
    """List the findings of each file, the worst first; notes are folded."""
    several = report.second is not None
    return join(_list_findings(subject, number, several=several) for number, subject in enumerate(report.subjects))


def _list_findings(subject: ReportSubject, number: int, *, several: bool) -> Markup:
    heading = element("h3", subject.name) if several else None
    if not subject.findings.diagnostics:
        return join((heading, element("p", "Nothing was found.")))
    return join((heading, *(_list_severity(subject, number, severity) for severity in WORST_FIRST)))


def _list_severity(subject: ReportSubject, number: int, severity: Severity) -> Markup | None:
    groups = _groups_of(subject, severity)
    if not groups:
        return None
    left = len(groups) - MOST
    more = element("p", f"and {count(left, f'more {severity.word}')}: twinform check lists all") if left > 0 else None
    items = (_item(each, subject, _anchor(severity, index, number)) for index, each in enumerate(groups[:MOST]))
    title = count(subject.count(severity), severity.word)
    return folded(
        title, element("ul", *items, class_="findings"), more, open_=severity > Severity.INFO, class_=severity.word
    )


def _item(group: Group, subject: ReportSubject, anchor_: str) -> Markup:
    one, others = group
    where, path, word = one.location, subject.findings.path, one.severity.word
    times = element("span", f" {len(others) + 1} times", class_="quiet") if others else None
    return element(
        "li",
        element("p", element("strong", word, class_=f"badge {word}"), " ", one.message.strip(), times),
        element(
            "p",
            element("code", breakable(place(where, path))),
            " ",
            element("code", breakable(where.path)),
            class_="quiet",
        ),
        _excerpt(one, subject),
        element("p", f"also at {_other_lines(others)}", class_="quiet") if others else None,
        *(element("p", f"see {place(each, path)}", class_="quiet") for each in one.related),
        element("p", "Help: ", one.help) if one.help else None,
        element("p", f"Fix ({one.fix.safety}): {one.fix.title}") if one.fix else None,
        folded(
            join(("Rule ", element("code", one.rule.name))),
            element("p", one.rule.finds),
            element("p", one.rule.matters),
        ),
        id=anchor_,
    )


def _other_lines(others: tuple[Diagnostic, ...]) -> str:
    lines = ", ".join(f"line {each.location.line}" for each in others[:_SHOWN])
    more = len(others) - _SHOWN
    return f"{lines} and {more} more" if more > 0 else lines


def _excerpt(one: Diagnostic, subject: ReportSubject) -> Markup | None:
    where, texts = one.location, subject.findings.texts
    line = texts.line(where.file or subject.findings.path, where.line)
    lines = [join((text, element("mark", marks) if marks else None, "\n")) for text, marks in excerpt(where, line)]
    return element("pre", element("code", *lines), tabindex="0") if lines else None


def _groups_of(subject: ReportSubject, severity: Severity) -> list[Group]:
    """Group the findings of a severity by cause, in the order of the file."""
    return grouped(each for each in subject.findings.diagnostics if each.severity is severity)


def _anchor(severity: Severity, number: int, subject: int = 0) -> str:
    """Name the anchor of a group of findings in the file number `subject`."""
    return f"{severity.word}-{'ab'[subject]}{number}"


def anchors(subject: ReportSubject) -> Mapping[int, str]:
    """Map the identity of each finding that is listed for the first file to the anchor of its group."""
    return {
        id(finding): _anchor(severity, number)
        for severity in WORST_FIRST
        for number, group in enumerate(_groups_of(subject, severity)[:MOST])
        for finding in (group.first, *group.others)
    }


# Browsers flatten elements nested deeper than about 500, and a chain of 1,000 links is nothing
# unusual in tests. Below this level the rest is one list.
_DEEPEST = 40
_OPEN = 300
"""Larger trees begin folded."""
_DRAWN = 400
"""Larger trees have no drawing."""


def tree(report: ModelReport) -> Markup | None:
    """List the tree of the first file, with a folded drawing."""
    graph = report.first.graph
    if graph is None or not graph.nodes:
        return None
    listed = element("ul", *_list_tree(report.first, graph), class_="tree")
    return join((element("p", graph.summary()), listed, _drawing(graph)))


def _drawing(graph: Graph) -> Markup | None:
    if len(graph.nodes) > _DRAWN:
        return None
    picture = image(svg(graph), alt=f"{graph.title}: {graph.summary()}")
    scroller = element("div", picture, class_="scroller", tabindex="0", role="region", aria_label="Drawing of the tree")
    return folded("Drawing", scroller)


def _list_tree(subject: ReportSubject, graph: Graph) -> Iterator[Markup]:
    """Yield an item for each root, made from the leaves up so that nothing recurses."""
    held = spanning_tree(joint for joint in graph.joints if joint.type != "gearbox")
    across: dict[str, list[GraphJoint]] = defaultdict(list)
    children: dict[str, list[str]] = defaultdict(list)
    for joint in graph.joints:
        if held.get(joint.child) is not joint:
            across[joint.parent].append(joint)
    for node in graph.nodes:
        if node.id in held:
            children[held[node.id].parent].append(node.id)
    nodes = {node.id: node for node in graph.nodes}
    about, places = _findings_by_node(subject, graph), anchors(subject)
    masses = {link.name: link.mass.mass for link in (subject.scene.links if subject.scene else ()) if link.mass}
    order = depth_first([node.id for node in graph.nodes if node.id not in held], children)
    is_open = len(graph.nodes) <= _OPEN
    made: dict[str, list[Markup]] = {}
    for name, level in reversed(order):
        node = nodes[name]
        loops = (f"{each.name} ({each.type}) closes a loop to {nodes[each.child].name}" for each in across[name])
        words = _words(node, held.get(node.id), masses.get(node.name), _badge(about[node.id], places), loops)
        below = [item for child in children[node.id] for item in made.pop(child)]
        if not below or level >= _DEEPEST:
            own = element(
                "li", *words, element("span", f" level {level}", class_="quiet") if level > _DEEPEST else None
            )
            made[node.id] = [own, *below]
        else:
            made[node.id] = [element("li", folded(join(words), element("ul", *below), open_=is_open))]
    for name, level in order:
        if level == 0:
            yield from made[name]


def _words(
    node: GraphNode, joint: GraphJoint | None, mass: float | None, badge: Markup | None, loops: Iterator[str]
) -> list[Part]:
    words: list[Part] = [element("b", node.name, class_=node.kind)]
    if node.kind != "link":
        words.append(f" ({node.kind})")
    if joint:
        words.append(element("span", f" {joint.name}: {', '.join((joint.type, *joint.details))}", class_="quiet"))
    if mass is not None:
        words.append(element("span", f" {mass:.4g} kg", class_="quiet"))
    if badge:
        words += [" ", badge]
    words += [element("span", f" {each}", class_="quiet") for each in loops]
    return words


def _badge(about: Sequence[Diagnostic], places: Mapping[int, str]) -> Markup | None:
    """Say how many findings there are about a node, with a link to the first of the worst."""
    if not about:
        return None
    first = max(about, key=lambda each: each.severity)
    href = f"#{places.get(id(first), 'findings')}"
    return element("a", count(len(about), "finding"), href=href, class_=f"badge {first.severity.word}")


def _findings_by_node(subject: ReportSubject, graph: Graph) -> Mapping[str, list[Diagnostic]]:
    """Collect the findings about each node; those about a joint count for its child."""
    parts = {node.where.path: node.id for node in graph.nodes} | {each.where.path: each.child for each in graph.joints}
    parts.pop("", None)
    found: dict[str, list[Diagnostic]] = defaultdict(list)
    for each in subject.findings.diagnostics:
        path = each.location.path
        while path and path not in parts:
            path = path.rpartition("/")[0]
        if path:
            found[parts[path]].append(each)
    return found


# viser's client puts its program into a script element that it makes itself, and evaluates strings.
# Without a view, the policy of a report has no `unsafe` word at all.
_MAKES_SCRIPTS = (
    "(()=>{const make=document.createElement.bind(document);document.createElement=(name,...more)=>{"
    "const made=make(name,...more);if(String(name).toLowerCase()==='script')made.nonce='%s';return made}})()"
)

# The client of viser is told once whether it is dark, and the report is as the browser prefers it.
_FOLLOWS_BROWSER = (
    "<script>(window.__VISER_EMBED_CONFIG__??={}).darkMode=matchMedia('(prefers-color-scheme: dark)').matches</script>"
)

_REST = "base-uri 'none'; form-action 'none'"


def view(report: ModelReport) -> Markup | None:
    """Show the page of the 3D view in a frame without rights, or say why there is none."""
    if report.view:
        frame = element(
            "iframe",
            srcdoc=framed(report.view).page,
            sandbox="allow-scripts",
            loading="lazy",
            title=f"3D view of {' and '.join(report.robots)}",
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
    rows = ((_link_of(each, report), f"{each.role} {each.name}".rstrip(), each.problem) for each in missing)
    listed = table("Shapes that are not drawn", ("Link", "Shape", "Reason"), rows)
    return join((element("p", words, class_="warning"), listed))


def _link_of(shape: NotDrawn, report: ModelReport) -> str:
    return f"{shape.link} in {report.files[shape.robot]}" if report.second else shape.link


def _describe_view(report: ModelReport) -> Markup:
    graph = report.first.graph
    summary = f"It shows {graph.summary()}, with every joint at zero. " if graph else ""
    if report.comparison and not report.comparison.same:
        summary = "The second robot is blue over the first one, and what differs is red, with every joint at zero. "
    if report.second and not report.second.loaded.accepted:
        summary += f"{report.files[1]} has errors and is not drawn. "
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
    """Give the scripts of a page a nonce, which they need to run in the frame, and let it be dark if the browser is."""
    page = page.replace("</head>", f"{_FOLLOWS_BROWSER}</head>", 1)
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


class Section(NamedTuple):
    """A section: its anchor, its heading, and the function that makes its content, or None if there is none.

    `of_first` sections are about the first file alone.
    """

    anchor: str
    title: str
    content: Callable[[ModelReport], Markup | None]
    of_first: bool = False


SECTIONS = (
    Section("differences", "Differences", differences),
    Section("view", "3D view", view),
    Section("findings", "Findings", findings),
    Section("tree", "Links and joints", tree, of_first=True),
    Section("conversion", "Conversion", conversion, of_first=True),
    Section("statistics", "Statistics", statistics),
    Section("masses", "Masses and inertias", masses, of_first=True),
    Section("reach", "Reach", reach, of_first=True),
    Section("meshes", "Meshes", meshes, of_first=True),
)


def html(report: ModelReport) -> str:
    """Write a report as a page of HTML."""
    made = [(each, each.content(report)) for each in SECTIONS]
    sections = [(each, content) for each, content in made if content]
    title = f"{report.title}: report"
    links = (element("li", element("a", each.title, href=f"#{each.anchor}")) for each, _ in sections)
    body = element(
        "body",
        element("a", "Skip to the content", href="#content", class_="skip"),
        element("header", element("h1", title), _files(report), element("ul", *_verdicts(report), class_="verdicts")),
        element("main",
            element("nav", element("ul", *links), aria_label="Sections"),
            *(element("section", element("h2", each.title, id=f"{each.anchor}-title"), _whose(each, report), content,
                      id=each.anchor, aria_labelledby=f"{each.anchor}-title") for each, content in sections),
            id="content",
        ),
        element("footer", f"Made by twinform {twinform.__version__}."),
        element("script", Markup(_data("report.js"))),
    )  # fmt: skip
    return f"<!DOCTYPE html>\n{element('html', _head(report, title), body, lang='en')}\n"


def _whose(section: Section, report: ModelReport) -> Markup | None:
    """Say which of two files a section is about, if it is about one."""
    if section.of_first and report.second:
        return element("p", breakable(f"Of {report.robots[0]}."), class_="quiet")
    return None


def _head(report: ModelReport, title: str) -> Markup:
    style, script = _data("report.css"), _data("report.js")
    nonce = framed(report.view).nonce if report.view else None
    return element(
        "head",
        element("meta", charset="utf-8"),
        element("meta", http_equiv="Content-Security-Policy", content=policy(style, script, nonce)),
        element("meta", name="viewport", content="width=device-width, initial-scale=1"),
        element("meta", name="color-scheme", content="light dark"),
        element("title", title),
        element("style", Markup(style)),
    )


def _verdicts(report: ModelReport) -> Iterator[Markup]:
    """Yield the most important results: findings, differences, and whether the file can be converted."""
    for each in report.subjects:
        file = join((breakable(each.name), ": ")) if report.second else None
        errors, warnings = each.count(Severity.ERROR), each.count(Severity.WARNING)
        yield element("li", file, each.counts, class_="error" if errors else "warning" if warnings else None)
    if report.comparison:
        yield element("li", summary(report.comparison), class_=None if report.comparison.same else "warning")
    if report.converted:
        yield element(
            "li",
            outcome(report.converted, report.files[0] if report.second else ""),
            class_=None if report.converted.ledger else "error",
        )


def outcome(converted: Converted, file: str = "") -> str:
    """Say in a line what becomes of a file in the other format; with `file` where there are several."""
    target, ledger = converted.target.upper(), converted.ledger
    if ledger is None:
        return f"no {target} can be made of {file or 'it'}: {count(len(converted.reasons), 'error')}"
    return f"{file} in {target}: {fates(ledger)}".lstrip()


def _files(report: ModelReport) -> Markup:
    names = [element("code", breakable(each.name)) for each in report.subjects]
    return element("p", join(names, " and "), class_="quiet")


@cache
def _data(name: str) -> str:
    return (package_files("twinform.report") / "data" / name).read_text(encoding="utf-8")
