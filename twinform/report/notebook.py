"""Documents and conversions in notebooks: a summary by default, and the 3D view on demand."""

from dataclasses import field
from typing import TYPE_CHECKING

from twinform.compiler.graph import build_graph
from twinform.compiler.graph.svg import svg
from twinform.dataclass import dataclass
from twinform.diagnostics import Fate, Severity
from twinform.diagnostics.reporters.file_findings import grouped
from twinform.ir import Document
from twinform.report.markup import Markup, count, element, fates, image, join, place

if TYPE_CHECKING:
    from twinform.compiler import Conversion
    from twinform.diagnostics import Diagnostic

_LISTED = 10
_DRAWN = 60
_CODE = "overflow-wrap:anywhere"


@dataclass(frozen=True, slots=True)
class Shown:
    """A page of HTML, which notebooks show in a frame."""

    page: str = field(repr=False)
    height: int

    # Not every notebook is IPython's, so this has to be a method of the value, and not a registered
    # formatter.
    def _repr_html_(self) -> str:
        return element(
            "iframe",
            srcdoc=self.page,
            sandbox="allow-scripts",
            title="3D view",
            width="100%",
            height=self.height,
            style="border:0",
        )


def show(first: Document, second: Document | None = None, *, height: int = 480, dark: bool = False) -> Shown:
    """Show a document in 3D in the last line of a cell, or two overlaid, with differences in red.

    The view takes about 0.8 MB, which the notebook keeps, so no document shows it by default.

    Raises:
        ViewError: the library that draws it is not installed.
        CompileError: the two documents cannot be compared.
    """
    from twinform.compiler.compare import diff  # noqa: PLC0415 - summaries have no view
    from twinform.view import standalone_page  # noqa: PLC0415 - see above

    comparison = diff(first, second) if second else None
    return Shown(standalone_page(first, second, comparison, dark=dark), height)


def document_html(document: Document) -> str:
    """Summarize a document: its numbers, its findings, and a drawing if it is small."""
    from twinform.compiler import check  # noqa: PLC0415 - `check` loads the whole compiler

    graph = build_graph(document, mimics=True)
    version = f" {document.version}" if document.version else ""
    head = element("p", element("b", graph.title), f": {document.format.upper()}{version}, {graph.summary()}")
    drawing = image(svg(graph), alt="links and joints", style="max-width:100%")
    picture = element("details", element("summary", "Links and joints"), drawing)
    found = check(document).diagnostics
    return join((head, _findings(found), picture if 1 < len(graph.nodes) <= _DRAWN else None))


def conversion_html(conversion: "Conversion") -> str:
    """Summarize a conversion: its result, its ledger, and its findings."""
    ledger, document = conversion.ledger, conversion.document
    version = f" {document.version}" if document.version else ""
    size = f"{document.format.upper()}{version}, {count(len(conversion.text.splitlines()), 'line')}"

    entries = sorted(ledger.entries, key=lambda entry: entry.fate is not Fate.DROPPED)
    rows = [f"{entry.fate.value}: {entry.message}" for entry in entries]
    return join((
        element("p", element("b", "Conversion"), f" to {size}"),
        element("p", fates(ledger)),
        _folded("What was not expressed", rows),
        _findings(conversion.diagnostics),
    ))  # fmt: skip


def _findings(found: "tuple[Diagnostic, ...]") -> Markup:
    worst = [each for each in found if each.severity > Severity.INFO]
    errors = sum(each.is_error for each in worst)
    words = (count(errors, "error"), count(len(worst) - errors, "warning"), count(len(found) - len(worst), "note"))
    rows = [
        f"{place(group.first.location, '')} {group.first.severity}: {group.first.message}".strip()
        for group in grouped(worst)
    ]
    return join((element("p", ", ".join(words)), _folded("Findings", rows)))


def _folded(title: str, rows: list[str]) -> Markup | None:
    if not rows:
        return None
    more = [f"and {len(rows) - _LISTED:,} more"] if len(rows) > _LISTED else []
    items = (element("li", row, style=_CODE) for row in (*rows[:_LISTED], *more))
    return element("details", element("summary", title), element("ul", *items))
