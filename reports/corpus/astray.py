"""What does not come home from the other format, by kind and place."""

import re
from collections import Counter
from collections.abc import Iterable

from twinform.testing.round_trips import Astray

COLUMNS = ("files", "times", "kind", "place", "for example")
_PREDICATE = re.compile(r"\[[^]]*\]")
_LONGEST = 160


def place_of(one: Astray) -> str:
    """Where it is, without the names that are in the path."""
    return _PREDICATE.sub("", one.path)


def by_place(found: Iterable[tuple[str, Iterable[Astray]]]) -> list[tuple[object, ...]]:
    """A row for each kind and place, those of most files first, of what is astray in files of these names."""
    files: Counter[tuple[str, str]] = Counter()
    times: Counter[tuple[str, str]] = Counter()
    examples: dict[tuple[str, str], str] = {}
    for name, astray in sorted(found, key=lambda each: each[0]):
        messages = [((one.kind, place_of(one)), one.message) for one in astray]
        times.update(key for key, _ in messages)
        files.update({key for key, _ in messages})
        for key, message in messages:
            examples.setdefault(key, f"{name}: {message}"[:_LONGEST])
    rows = sorted(files, key=lambda key: (-files[key], -times[key], key))
    return [(files[key], times[key], *key, examples[key]) for key in rows]
