"""Did you mean: suggests the known name that is nearest to one that is not known, as the help of a finding."""

import re
from collections import Counter
from collections.abc import Iterable, Mapping
from itertools import islice

# The longest name that is compared: a longer one is no typing mistake.
_LONGEST = 80
# Among more names nothing is suggested: a hostile file may have a hundred thousand, and as many
# unknown ones.
_MOST_KNOWN = 1000
_MOST_COMPARED = 200
"""The most names that are compared letter by letter."""
_ALIKE = 0.6
"""How much of two names is the same where one may be meant for the other, as `difflib` measures it."""
_ASKS = re.compile(r"did you mean (?P<quote>['\"]?)(?P<name>.+)(?P=quote)\?", re.DOTALL)


def did_you_mean(name: str, known: Iterable[str | None]) -> str | None:
    """Return the sentence that suggests a name; None if no name is near."""
    near = nearest_name(name, known)
    return f"did you mean {near!r}?" if near else None


def meant_name(sentence: str | None) -> str | None:
    """Return the name that such a sentence suggests; None for any other help."""
    found = _ASKS.fullmatch(sentence or "")
    return found["name"] if found else None


def nearest_name(name: str, known: Iterable[str | None], alike: float = _ALIKE) -> str | None:
    """Return the known name that was probably meant: capitals and separators count least, then letters.

    `alike` is how much of the two has to be the same, from 0 to 1. The order of what is known does not matter.
    """
    folded = _folded(name) if len(name) <= _LONGEST else ""
    others = list(islice(known, _MOST_KNOWN + 1))
    if not folded or len(others) > _MOST_KNOWN:
        return None
    forms: dict[str, str] = {}
    for each in sorted(each for each in others if each and each != name and _may_be(len(each), len(folded))):
        forms.setdefault(_folded(each), each)
    if folded in forms:
        return forms[folded]
    digits = _digits(folded)  # joint_1 is not a typo of joint_2
    likely = (each for each in forms if not digits or _digits(each) in {"", digits})
    near = _nearest(folded, islice(likely, _MOST_COMPARED), alike)
    return forms[near] if near else None


def _nearest(name: str, others: Iterable[str], alike: float) -> str:
    """Return the most similar name; of several the last in the alphabet, empty if none is similar enough.

    Which letters there are bounds how much alike two names can be. The order of letters takes much longer to compare,
    so that is done from the highest bound on, until no other name can be nearer.
    """
    from difflib import SequenceMatcher  # noqa: PLC0415 - most files have no typo

    matcher = SequenceMatcher(b=name)
    letters = Counter(name)
    bounds = [(_most_alike(name, letters, each), each) for each in others]
    best = alike, ""
    for bound, other in sorted((pair for pair in bounds if pair[0] >= alike), reverse=True):
        if bound < best[0]:
            break
        matcher.set_seq1(other)
        best = max(best, (matcher.ratio(), other))
    return best[1]


def _most_alike(name: str, letters: Mapping[str, int], other: str) -> float:
    """Return an upper bound of similarity, by the letters that two names share: `quick_ratio` of `difflib`."""
    shared = sum(map(min, letters.values(), map(other.count, letters)))
    return 2 * shared / (len(name) + len(other))


def _folded(name: str) -> str:
    return name.casefold().replace("-", "_").replace(" ", "_").strip("_")


def _digits(name: str) -> str:
    return "".join(filter(str.isdigit, name))


def _may_be(length: int, wanted: int) -> bool:
    """Tell whether two names can be similar by their lengths."""
    return length <= _LONGEST and wanted * _ALIKE <= length * (2 - _ALIKE) and length * _ALIKE <= wanted * (2 - _ALIKE)
