"""The report for code scanning: SARIF 2.1.0."""

from collections.abc import Sequence
from pathlib import Path
from urllib.parse import quote

from twinform.diagnostics.catalog import catalog
from twinform.diagnostics.diagnostic import Diagnostic
from twinform.diagnostics.location import Location
from twinform.diagnostics.reporters.findings import Findings
from twinform.diagnostics.rule import Rule, Severity

_SCHEMA = "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json"
_LEVELS = {Severity.ERROR: "error", Severity.WARNING: "warning", Severity.INFO: "note"}


def sarif(files: Sequence[Findings]) -> str:
    """A log of one run: all rules of the catalog, and a result for each finding."""
    import json  # noqa: PLC0415 - few runs write it
    from importlib.metadata import version  # noqa: PLC0415 - see above

    rules = _rules(files)
    order = {name: index for index, name in enumerate(rules)}
    driver = {"name": "twinform", "version": version("twinform"), "rules": [_rule(rule) for rule in rules.values()]}
    results = [_result(each, file.path, order) for file in files for each in file.diagnostics]
    run = {"tool": {"driver": driver}, "columnKind": "unicodeCodePoints", "results": results}
    return json.dumps({"$schema": _SCHEMA, "version": "2.1.0", "runs": [run]}, indent=2) + "\n"


def _rules(files: Sequence[Findings]) -> dict[str, Rule]:
    """The catalog, and the rules of third-party passes that found something."""
    used = {each.rule.name: each.rule for file in files for each in file.diagnostics}
    return dict(sorted((used | catalog()).items()))


def _rule(rule: Rule) -> dict[str, object]:
    return {
        "id": rule.name,
        "shortDescription": {"text": rule.finds},
        "fullDescription": {"text": rule.matters},
        "help": {"text": f"Example: {rule.example}\nBetter: {rule.better}"},
        "defaultConfiguration": {"level": _LEVELS[rule.severity]},
    }


def _result(diagnostic: Diagnostic, file: str, order: dict[str, int]) -> dict[str, object]:
    message = f"{diagnostic.message}\n{diagnostic.help}" if diagnostic.help else diagnostic.message
    related = [{"id": number, **_location(each, file)} for number, each in enumerate(diagnostic.related)]
    return {
        "ruleId": diagnostic.rule.name,
        "ruleIndex": order[diagnostic.rule.name],
        "level": _LEVELS[diagnostic.severity],
        "message": {"text": message},
        "locations": [_location(diagnostic.location, file)],
        **({"relatedLocations": related} if related else {}),
    }


def _location(location: Location, file: str) -> dict[str, object]:
    region = {"region": {"startLine": location.line}} if location.line else {}
    physical: dict[str, object] = {"artifactLocation": {"uri": _uri(location.file or file)}, **region}
    logical = {"logicalLocations": [{"fullyQualifiedName": location.path}]} if location.path else {}
    return {"physicalLocation": physical, **logical}


def _uri(file: str) -> str:
    """A relative path stays relative: the readers of SARIF resolve it against the root of the repository."""
    path = Path(file)
    if path.is_absolute():
        return path.as_uri()
    return quote(path.as_posix(), errors="surrogateescape")
