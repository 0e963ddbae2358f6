"""The report as one page of HTML, which opens from disk and loads nothing; its sections in order."""

from collections.abc import Callable, Iterator
from functools import cache
from typing import NamedTuple

import twinform
from twinform.compiler.compare.comparison_reporters import summary
from twinform.diagnostics import Severity
from twinform.package_files import package_files
from twinform.report.content import Converted, ModelReport
from twinform.report.difference_sections import conversion, differences
from twinform.report.findings_section import findings
from twinform.report.markup import Markup, breakable, count, element, fates, join
from twinform.report.number_sections import masses, meshes, reach, statistics
from twinform.report.tree_section import tree
from twinform.report.view_section import framed, policy, view


class Section(NamedTuple):
    """A section: its anchor, its heading, and the function that makes its content, or None if there is none."""

    anchor: str
    title: str
    content: Callable[[ModelReport], Markup | None]


SECTIONS = (
    Section("differences", "Differences", differences),
    Section("view", "3D view", view),
    Section("findings", "Findings", findings),
    Section("tree", "Links and joints", tree),
    Section("conversion", "Conversion", conversion),
    Section("statistics", "Statistics", statistics),
    Section("masses", "Masses and inertias", masses),
    Section("reach", "Reach", reach),
    Section("meshes", "Meshes", meshes),
)


def html(report: ModelReport) -> str:
    """Write a report as a page of HTML."""
    made = [(each, each.content(report)) for each in SECTIONS]
    sections = [(each, content) for each, content in made if content]
    title = f"{' and '.join(each.title for each in report.subjects)}: report"
    links = (element("li", element("a", each.title, href=f"#{each.anchor}")) for each, _ in sections)
    body = element(
        "body",
        element("a", "Skip to the content", href="#content", class_="skip"),
        element("header", element("h1", title), _files(report), element("ul", *_verdicts(report), class_="verdicts")),
        element("main",
            element("nav", element("ul", *links), aria_label="Sections"),
            *(element("section", element("h2", each.title, id=f"{each.anchor}-title"), content,
                      id=each.anchor, aria_labelledby=f"{each.anchor}-title") for each, content in sections),
            id="content",
        ),
        element("footer", f"Made by twinform {twinform.__version__}."),
        element("script", Markup(_data("report.js"))),
    )  # fmt: skip
    return f"<!DOCTYPE html>\n{element('html', _head(report, title), body, lang='en')}\n"


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
        yield element("li", outcome(report.converted), class_=None if report.converted.ledger else "error")


def outcome(converted: Converted) -> str:
    """Say in a line what becomes of the file in the other format."""
    target, ledger = converted.target.upper(), converted.ledger
    if ledger is None:
        return f"no {target} can be made of it: {count(len(converted.reasons), 'error')}"
    return f"in {target}: {fates(ledger)}"


def _files(report: ModelReport) -> Markup:
    names = [element("code", breakable(each.name)) for each in report.subjects]
    return element("p", join(names, " and "), class_="quiet")


@cache
def _data(name: str) -> str:
    return (package_files("twinform.report") / "data" / name).read_text(encoding="utf-8")
