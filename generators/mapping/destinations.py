"""Makes the table of where rows go for the hovers of editors.

It has for each path of both formats what the page of the mapping says: where it goes, and what became of it.
"""

import json
import re

from generators.mapping.cells import became, where
from generators.mapping.measure import Seen, measured
from twinform.server.mapping import FORMATS, FormatName, rows

_LINK = re.compile(r"\[(?P<text>[^\]]*)\]\([^)]*\)")
_NOWHERE = ("", "by its rows")


def destinations_table() -> str:
    """The table as JSON; rows about which there is nothing to say are left out."""
    found = {name: _of_format(name) for name in FORMATS}
    return json.dumps(found, indent=1, ensure_ascii=False, sort_keys=True) + "\n"


def _of_format(name: FormatName) -> dict[str, list[str]]:
    seen = measured()
    found: dict[str, list[str]] = {}
    for row in rows(name):
        own = seen.get(row, Seen())
        goes = _LINK.sub(r"\g<text>", where(row, own)[1])
        old_goes, old_fates = found.get(row.path, ["", ""])
        fates = [*filter(None, old_fates.split(" or ")), *filter(None, became(own).split(" or "))]
        found[row.path] = [old_goes or ("" if goes in _NOWHERE else goes), " or ".join(dict.fromkeys(fates))]
    return {path: entry for path, entry in found.items() if any(entry)}
