"""Did you mean: the known name that is nearest to one that is not known, as the help of a finding."""

from collections.abc import Iterable
from difflib import get_close_matches
from itertools import islice

_LONGEST = 80
"""The longest name that is compared; longer ones are nobody's slip."""
_MOST = 400
"""The most names that are compared with one; a hostile file may have a hundred thousand of each."""
_ALIKE = 0.6
"""How much of two names is the same where one may be meant for the other, as `difflib` measures it."""


def did_you_mean(name: str, known: Iterable[str | None]) -> str | None:
    """The sentence that asks; None where nothing is near."""
    near = nearest_name(name, known)
    return f"did you mean {near!r}?" if near else None


def nearest_name(name: str, known: Iterable[str | None], alike: float = _ALIKE) -> str | None:
    """The known name that was probably meant: capitals and what stands between words count least, then letters.

    `alike` is how much of the two has to be the same, from 0 to 1.
    """
    folded = _folded(name)
    if not folded or len(name) > _LONGEST:
        return None
    others = dict.fromkeys(each for each in known if each and each != name and len(each) <= _LONGEST)
    same = next((each for each in others if _folded(each) == folded), None)
    if same is not None:
        return same
    forms: dict[str, str] = {}
    for each in islice(_likely(folded, others), _MOST):
        if _digits(each) and _digits(folded) and _digits(each) != _digits(folded):
            continue  # joint_1 is no slip of joint_2
        forms.setdefault(_folded(each), each)
    near = get_close_matches(folded, list(forms), n=1, cutoff=alike)
    return forms[near[0]] if near else None


def _folded(name: str) -> str:
    return name.casefold().replace("-", "_").replace(" ", "_").strip("_")


def _digits(name: str) -> str:
    return "".join(filter(str.isdigit, name))


def _likely(folded: str, names: Iterable[str]) -> Iterable[str]:
    """The names whose length alone does not rule them out."""
    least, most = len(folded) * _ALIKE / (2 - _ALIKE), len(folded) * (2 - _ALIKE) / _ALIKE
    return (each for each in names if least <= len(each) <= most)
