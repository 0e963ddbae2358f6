"""The Damerau-Levenshtein distance of two words: how many letters were typed wrongly."""

from collections import Counter
from collections.abc import Iterable


def edit_distance(one: str, other: str, most: int) -> int:
    """Return how many letters are missing, too many, wrong or exchanged with the next one; `most` + 1 beyond `most`.

    An exchanged pair of letters is one mistake, and is not edited again (optimal string alignment).
    """
    if abs(len(one) - len(other)) > most:
        return most + 1
    before: list[int] = []
    last = [*range(len(other) + 1)]
    for row, letter in enumerate(one, 1):
        here = [row]
        for column, wanted in enumerate(other, 1):
            cost = min(last[column - 1] + (letter != wanted), last[column] + 1, here[-1] + 1)
            if row > 1 and column > 1 and letter == other[column - 2] and one[row - 2] == wanted:
                cost = min(cost, before[column - 2] + 1)
            here.append(cost)
        if min(here) > most and min(last) > most:
            return most + 1
        before, last = last, here
    return min(last[-1], most + 1)


def nearest_words(word: str, others: Iterable[str], alike: float) -> list[tuple[int, str]]:
    """Return the nearest words with their distances, the nearest first, and those less than twice as far away.

    `alike` is the share of the longer word that has to be right in the nearest one; none is found without.
    """
    # Which letters there are bounds how near two words can be. Their order takes much longer to
    # compare, so that is done from the lowest bound on, until no other word can be near.
    letters = Counter(word)
    bounds = sorted((_least_distance(letters, word, each), each) for each in others)
    most = max((2 * _most_typos(word, each, alike) - 1 for _, each in bounds), default=0)
    found: list[tuple[int, str]] = []
    for bound, other in bounds:
        if bound > most:
            break
        distance = edit_distance(word, other, most)
        if distance <= most:
            found.append((distance, other))
            most = min(most, max(2 * distance - 1, 0))
    found = sorted(each for each in found if each[0] <= most)
    return found if found and found[0][0] <= _most_typos(word, found[0][1], alike) else []


def _most_typos(word: str, other: str, alike: float) -> int:
    return int((1 - alike) * max(len(word), len(other)) + 1e-9)  # 0.4 * 5 is less than 2


def _least_distance(letters: Counter[str], word: str, other: str) -> int:
    """Return a lower bound of the distance, by the letters that two words share."""
    shared = sum(min(count, other.count(letter)) for letter, count in letters.items())
    return max(len(word), len(other)) - shared
