"""What came of a run, in a line and for programs."""

import json
from collections import Counter
from collections.abc import Iterable
from dataclasses import asdict

from twinform.compiler.batch.record import Outcome, Record

_LEFT_OUT = ("digest", "request", "made", "alone")
"""What only the manifest needs."""


def summary(records: Iterable[Record], known: int) -> str:
    """How many models met each end; `known` of them in an earlier run."""
    counts = Counter(record.outcome for record in records)
    words = [f"{counts[outcome]} {outcome}" for outcome in Outcome if counts[outcome]]
    total = counts.total()
    before = f" ({known} known from before)" if known else ""
    return f"{total} model{'' if total == 1 else 's'}{': ' if words else ''}{', '.join(words)}{before}"


def report(records: Iterable[Record], to: str) -> str:
    """One JSON object: how many models met each end, and all models in the order of their names."""
    found = sorted(records, key=lambda record: record.source)
    counts = Counter(record.outcome for record in found)
    rows = [{key: value for key, value in asdict(record).items() if key not in _LEFT_OUT} for record in found]
    whole = {"to": to, "summary": {str(each): counts[each] for each in Outcome}, "models": rows}
    return json.dumps(whole, indent=2) + "\n"
