"""Print ledgers as tables: python examples/print_ledger.py LEDGER.json...

`twinform convert --ledger LEDGER.json` writes them.
"""

import json
import sys
from collections import Counter
from pathlib import Path


def table(ledger: dict) -> str:
    """What became of the elements and attributes of a model: the fate, how many, and why.

    Where nothing of the source is concerned, such as where a number was made up, there is no count.
    """
    counts = Counter({("expressed", "in elements of the target format"): ledger["expressed"]})
    for entry in ledger["entries"]:
        counts[entry["fate"], entry["message"]] += entry["weight"]
    rows = [("fate", "count", "what"), *((fate, count or "-", what) for (fate, what), count in counts.items())]
    return "\n".join(f"  {fate:<14}{count:>5}  {what}" for fate, count, what in rows)


for path in map(Path, sys.argv[1:]):
    print(f"{path}:\n{table(json.loads(path.read_text(encoding='utf-8')))}\n")
