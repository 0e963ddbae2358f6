"""What becomes of a row in the other format, in words: `destinations.json`, which `make generate` makes."""

import json
from functools import cache
from typing import NamedTuple

from twinform.package_files import package_files
from twinform.server.mapping.rows import FormatName, MappingRow


class Destination(NamedTuple):
    """Where a row goes, and its fates in the case files, the most frequent first; one of both may be empty."""

    goes: str
    fates: str


def destination(row: MappingRow) -> Destination:
    """Look up where a row of the facts tables goes in the other format."""
    goes, fates = _table()[row.format].get(row.path, ("", ""))
    return Destination(goes, fates)


@cache
def _table() -> dict[FormatName, dict[str, tuple[str, str]]]:
    text = package_files("twinform.server.mapping").joinpath("destinations.json").read_text(encoding="utf-8")
    return json.loads(text)
