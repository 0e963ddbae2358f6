"""What does not come back from the other format, by kind and path."""

from collections import Counter
from collections.abc import Iterable

from testbed.markdown import without_names
from twinform.testing.properties import Mismatch

COLUMNS = ("files", "times", "kind", "path", "for example")
_LONGEST = 160


def by_path(found: Iterable[tuple[str, Iterable[Mismatch]]]) -> list[tuple[object, ...]]:
    """A row for each kind and path, those of most files first, of what does not match in files of these names."""
    files: Counter[tuple[str, str]] = Counter()
    times: Counter[tuple[str, str]] = Counter()
    examples: dict[tuple[str, str], str] = {}
    for name, mismatches in sorted(found, key=lambda each: each[0]):
        messages = [((one.kind, without_names(one.path)), one.message) for one in mismatches]
        times.update(key for key, _ in messages)
        files.update({key for key, _ in messages})
        for key, message in messages:
            examples.setdefault(key, f"{name}: {message}"[:_LONGEST])
    rows = sorted(files, key=lambda key: (-files[key], -times[key], key))
    return [(files[key], times[key], *key, examples[key]) for key in rows]
