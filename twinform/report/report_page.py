"""The report as one page of HTML, which opens from disk and asks for nothing."""

from collections.abc import Iterator
from functools import cache

import twinform
from twinform.compiler.compare.comparison_reporters import summary
from twinform.diagnostics import Fate, Severity
from twinform.package_files import package_files
from twinform.report.content import Converted, ModelReport
from twinform.report.frame import framed, policy
from twinform.report.html_parts import count
from twinform.report.markup import Markup, breakable, element, join
from twinform.report.sections import SECTIONS


def html(report: ModelReport) -> str:
    """The whole page."""
    made = [(each, each.content(report)) for each in SECTIONS]
    sections = [(each, content) for each, content in made if content]
    title = f"{' and '.join(each.title for each in report.subjects)}: report"
    links = (element("li", element("a", each.title, href=f"#{each.anchor}")) for each, _ in sections)
    body = element(
        "body",
        element("a", "Skip to the content", href="#content", class_="skip"),
        element("header", element("h1", title), _files(report), element("ul", *verdicts(report), class_="verdicts")),
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


def verdicts(report: ModelReport) -> Iterator[Markup]:
    """What there is to know first, each in a few words."""
    for each in report.subjects:
        file = join((breakable(each.name), ": ")) if report.second else None
        errors, warnings = each.count(Severity.ERROR), each.count(Severity.WARNING)
        tone = "error" if errors else "warning" if warnings else None
        notes = each.count(Severity.INFO)
        words = ", ".join((count(errors, "error"), count(warnings, "warning"), count(notes, "note")))
        yield element("li", file, words, class_=tone)
    if report.comparison:
        yield element("li", summary(report.comparison), class_=None if report.comparison.same else "warning")
    if report.converted:
        yield element("li", outcome(report.converted), class_=None if report.converted.ledger else "error")


def outcome(converted: Converted) -> str:
    """What becomes of the file in the other format, in a line."""
    target, ledger = converted.target.upper(), converted.ledger
    if ledger is None:
        return f"no {target} can be made of it: {count(len(converted.reasons), 'error')}"
    fates = ", ".join(f"{ledger.count(fate):,} {fate.value}" for fate in Fate)
    return f"in {target}: {ledger.expressed:,} expressed, {fates}"


def _files(report: ModelReport) -> Markup:
    names = [element("code", breakable(each.name)) for each in report.subjects]
    return element("p", join(names, " and "), class_="quiet")


@cache
def _data(name: str) -> str:
    return (package_files("twinform.report") / "data" / name).read_text(encoding="utf-8")
