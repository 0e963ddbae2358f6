"""The report for programs: one JSON object."""

from collections.abc import Sequence

from twinform.diagnostics.diagnostic import Diagnostic, Location
from twinform.diagnostics.reporters.file_findings import NO_TEXTS, FileFindings, FileTexts, placed_edits


def json(files: Sequence[FileFindings]) -> str:
    """`{"files": [{"path", "diagnostics": [...]}]}`; every key is always there, and 0 means an unknown line or column.

    Columns count characters from 1, and ends are behind the piece. Only what is in another file than the one that was
    asked for, such as an included one, names its `file`: findings, and edits of fixes.
    """
    import json as jsonlib  # noqa: PLC0415 - few runs write it

    rows = [
        {"path": each.path, "diagnostics": [row(one, each.path, each.texts) for one in each.diagnostics]}
        for each in files
    ]
    return jsonlib.dumps({"files": rows}, indent=2) + "\n"


def row(diagnostic: Diagnostic, file: str, texts: FileTexts = NO_TEXTS) -> dict[str, object]:
    """One finding about a file."""
    return {
        "rule": diagnostic.rule.name,
        "severity": str(diagnostic.severity),
        "message": diagnostic.message,
        **_place(diagnostic.location, file),
        "help": diagnostic.help,
        "found": diagnostic.found,
        "expected": diagnostic.expected,
        "related": [_place(location, file) for location in diagnostic.related],
        "fix": _fix(diagnostic, file, texts),
    }


def _place(location: Location, file: str) -> dict[str, object]:
    place: dict[str, object] = {
        "line": location.line,
        "column": location.column,
        "end_line": location.end_line,
        "end_column": location.end_column,
        "path": location.path,
    }
    return place if location.file in {"", file} else {**place, "file": location.file}


def _fix(diagnostic: Diagnostic, file: str, texts: FileTexts) -> dict[str, object] | None:
    replacements = placed_edits(diagnostic, file, texts)
    if diagnostic.fix is None or replacements is None:
        return None
    edits = [
        {
            "line": start[0],
            "column": start[1],
            "end_line": end[0],
            "end_column": end[1],
            "new": new,
            **({} if name == file else {"file": name}),
        }
        for start, end, new, name in replacements
    ]
    return {"title": diagnostic.fix.title, "safety": str(diagnostic.fix.safety), "edits": edits}
