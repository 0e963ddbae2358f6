"""The report for programs: one JSON object."""

from collections.abc import Sequence

from twinform.diagnostics.diagnostic import Diagnostic
from twinform.diagnostics.location import Location
from twinform.diagnostics.reporters.findings import Findings


def json(files: Sequence[Findings]) -> str:
    """`{"files": [{"path", "diagnostics": [...]}]}`; every key is always there, and line 0 means unknown.

    Only a finding in another file than the one that was asked for, such as an included one, names its `file`.
    """
    import json as jsonlib  # noqa: PLC0415 - few runs write it

    rows = [{"path": path, "diagnostics": [row(each, path) for each in found]} for path, found in files]
    return jsonlib.dumps({"files": rows}, indent=2) + "\n"


def row(diagnostic: Diagnostic, file: str) -> dict[str, object]:
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
    }


def _place(location: Location, file: str) -> dict[str, object]:
    place: dict[str, object] = {"line": location.line, "path": location.path}
    return place if location.file in {"", file} else {**place, "file": location.file}
