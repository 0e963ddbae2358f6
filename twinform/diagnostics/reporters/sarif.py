"""The report for code scanning: SARIF 2.1.0."""

from collections import Counter, defaultdict
from collections.abc import Sequence
from pathlib import Path
from urllib.parse import quote

from twinform.diagnostics.catalog import HOME, more_about, rule_address
from twinform.diagnostics.diagnostic import Diagnostic, Location, Rule, Safety
from twinform.diagnostics.reporters.file_findings import FileFindings, PlacedEdit, placed_edits

_SCHEMA = "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json"
_FINGERPRINT = "finding/v1"


def sarif(files: Sequence[FileFindings]) -> str:
    """A log of one run: the rules that were found, and a result for each finding."""
    import json  # noqa: PLC0415 - few runs write it
    from importlib.metadata import version  # noqa: PLC0415 - see above

    rules = dict(sorted({each.rule.name: each.rule for file in files for each in file.diagnostics}.items()))
    order = {name: index for index, name in enumerate(rules)}
    driver = {
        "name": "twinform",
        "version": version("twinform"),
        **({"informationUri": HOME} if HOME else {}),
        "rules": [_rule(rule) for rule in rules.values()],
    }
    seen: Counter[str] = Counter()
    results = [_result(each, file, order, seen) for file in files for each in file.diagnostics]
    run = {"tool": {"driver": driver}, "columnKind": "unicodeCodePoints", "results": results}
    return json.dumps({"$schema": _SCHEMA, "version": "2.1.0", "runs": [run]}, indent=2) + "\n"


def _rule(rule: Rule) -> dict[str, object]:
    from twinform.diagnostics.rule_page import sections  # noqa: PLC0415 - few runs write it

    page = [*sections(rule), ("More", more_about(rule.name))]
    text = "\n".join(f"{heading}: {body}" for heading, body in page)
    markdown = "\n\n".join(f"**{heading}.** {body}" for heading, body in page)
    address = rule_address(rule.name)
    return {
        "id": rule.name,
        "shortDescription": {"text": rule.finds},
        "fullDescription": {"text": rule.matters},
        "help": {"text": text, "markdown": markdown},
        **({"helpUri": address} if address else {}),
        "defaultConfiguration": {"level": rule.severity.word},
    }


def _result(diagnostic: Diagnostic, file: FileFindings, order: dict[str, int], seen: Counter[str]) -> dict[str, object]:
    message = f"{diagnostic.message}\n{diagnostic.help}" if diagnostic.help else diagnostic.message
    related = [{"id": number, **_location(each, file.path)} for number, each in enumerate(diagnostic.related)]
    fixes = _fixes(diagnostic, file)
    return {
        "ruleId": diagnostic.rule.name,
        "ruleIndex": order[diagnostic.rule.name],
        "level": diagnostic.severity.word,
        "message": {"text": message},
        "locations": [_location(diagnostic.location, file.path)],
        "partialFingerprints": {_FINGERPRINT: _fingerprint(diagnostic, file.path, seen)},
        **({"relatedLocations": related} if related else {}),
        **({"fixes": fixes} if fixes else {}),
    }


def _fingerprint(diagnostic: Diagnostic, file: str, seen: Counter[str]) -> str:
    """Return what stays when lines move: file, rule, path and message, numbered if they recur."""
    from hashlib import sha256  # noqa: PLC0415 - few runs write it

    where = diagnostic.location
    parts = (_uri(where.file or file), diagnostic.rule.name, where.path, diagnostic.message)
    found = sha256("\0".join(parts).encode(errors="surrogatepass")).hexdigest()[:32]
    seen[found] += 1
    return f"{found}:{seen[found]}"


def _location(location: Location, file: str) -> dict[str, object]:
    region = {"region": _region(location)} if location.line else {}
    physical: dict[str, object] = {"artifactLocation": {"uri": _uri(location.file or file)}, **region}
    logical = {"logicalLocations": [{"fullyQualifiedName": location.path}]} if location.path else {}
    return {"physicalLocation": physical, **logical}


def _region(location: Location) -> dict[str, int]:
    begin = {"startLine": location.line}
    if not location.column:
        return begin
    end = {"endLine": location.end_line, "endColumn": location.end_column} if location.end_line else {}
    return {**begin, "startColumn": location.column, **end}


def _fixes(diagnostic: Diagnostic, file: FileFindings) -> list[dict[str, object]]:
    edits = placed_edits(diagnostic, file.path, file.texts)
    if diagnostic.fix is None or not edits:
        return []
    by_file: defaultdict[str, list[PlacedEdit]] = defaultdict(list)
    for edit in edits:
        by_file[edit.file].append(edit)
    changes = [
        {"artifactLocation": {"uri": _uri(name)}, "replacements": [*map(_replacement, found)]}
        for name, found in by_file.items()
    ]
    # SARIF has no field for it, and a reader that shows only the text has to know it too.
    safety = str(diagnostic.fix.safety)
    title = diagnostic.fix.title if diagnostic.fix.safety is Safety.SAFE else f"{diagnostic.fix.title} ({safety})"
    return [{"description": {"text": title}, "artifactChanges": changes, "properties": {"safety": safety}}]


def _replacement(edit: PlacedEdit) -> dict[str, object]:
    region = {
        "startLine": edit.start[0],
        "startColumn": edit.start[1],
        "endLine": edit.end[0],
        "endColumn": edit.end[1],
    }
    return {"deletedRegion": region, "insertedContent": {"text": edit.new}}


def _uri(file: str) -> str:
    """A relative path stays relative: the readers of SARIF resolve it against the root of the repository."""
    path = Path(file)
    if path.is_absolute():
        return path.as_uri()
    return quote(path.as_posix(), errors="surrogateescape")
