"""Did you mean: suggests the known name that is nearest to one that is not known, as the help of a finding."""

import re
from collections import Counter, defaultdict
from collections.abc import Collection, Iterable, Mapping, Sequence
from functools import lru_cache
from itertools import islice

from twinform.lazy import lazy_pattern

# The longest name that is compared: a longer one is no typing mistake.
_LONGEST = 80
# Among more names nothing is suggested: a hostile file may have a hundred thousand, and as many
# unknown ones.
_MOST_KNOWN = 1000
_MOST_COMPARED = 200
"""The most names that are compared letter by letter."""
_ALIKE = 0.6
"""How much of two names is the same where one may be meant for the other, as `difflib` measures it."""
_ASKS = lazy_pattern(r"did you mean (?P<quote>['\"]?)(?P<name>.+)(?P=quote)\?", re.DOTALL)


def did_you_mean(name: str, known: Iterable[str | None], but: Collection[str | None] = ()) -> str | None:
    """Return the sentence that suggests a known name, `but` none of these; None if no name is near."""
    near = nearest_name(name, known, but=but)
    return f"did you mean {near!r}?" if near else None


def meant_name(sentence: str | None) -> str | None:
    """Return the name that such a sentence suggests; None for any other help."""
    found = _ASKS.fullmatch(sentence or "")
    return found["name"] if found else None


def nearest_name(
    name: str, known: Iterable[str | None], alike: float = _ALIKE, *, but: Collection[str | None] = ()
) -> str | None:
    """Return the known name that was probably meant: capitals and separators count least, then letters.

    `alike` is how much of the two has to be the same, from 0 to 1; names of `but` are not meant. The order of what is
    known does not matter.
    """
    others = list(islice(known, _MOST_KNOWN + 1))
    if len(name) > _LONGEST or len(others) > _MOST_KNOWN:
        return None
    names = frozenset(filter(None, others))
    return _nearest_of(name, names, alike, but) if but else _nearest_known(name, names, alike)


# A robot has the same unknown element in each of its joints.
@lru_cache(maxsize=64)
def _nearest_known(name: str, known: frozenset[str], alike: float) -> str | None:
    return _nearest_of(name, known, alike, ())


def _nearest_of(name: str, known: frozenset[str], alike: float, but: Collection[str | None]) -> str | None:
    folded = _folded(name)
    if not folded:
        return None
    by_digits = _by_digits(known)
    digits = _digits(folded)  # joint_1 is not a typo of joint_2
    groups = [by_digits.get(each, ()) for each in {"", digits}] if digits else by_digits.values()
    forms: dict[str, str] = {}
    for other, form in sorted(pair for group in groups for pair in group):
        if other != name and other not in but and _may_be(len(other), len(folded)):
            forms.setdefault(form, other)
    if folded in forms:
        return forms[folded]
    near = _nearest(folded, islice(forms, _MOST_COMPARED), alike)
    return forms[near] if near else None


# A file with a thousand unknown names asks for each of them among the same known ones.
@lru_cache(maxsize=4)
def _by_digits(known: frozenset[str]) -> Mapping[str, Sequence[tuple[str, str]]]:
    """Group known names, each with its folded form, by the digits in them."""
    groups = defaultdict[str, list[tuple[str, str]]](list)
    for each in known:
        if len(each) <= _LONGEST:
            form = _folded(each)
            groups[_digits(form)].append((each, form))
    return groups


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
