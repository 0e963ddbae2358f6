"""Groups of names, such as the links that joints connect, and the name that each hangs from."""

from collections.abc import Iterable, Mapping


class Groups:
    """Disjoint sets of names (union-find); each name begins as a set of its own."""

    def __init__(self) -> None:
        self._up: dict[str, str] = {}

    def find(self, name: str) -> str:
        """Return the representative of a name's set; paths are halved on the way, so that long chains stay cheap."""
        while (above := self._up.get(name, name)) != name:
            self._up[name] = self._up.get(above, above)
            name = above
        return name

    def join(self, one: str, other: str) -> bool:
        """Join the sets of two names under the first one's representative; returns whether they were apart."""
        one, other = self.find(one), self.find(other)
        if one != other:
            self._up[other] = one
        return one != other


def tops(names: Iterable[str], above: Mapping[str, str]) -> dict[str, str]:
    """Return the topmost name above each name; in a circle, the first one that is met again.

    A way that is known is not walked again, so that a long chain takes linear time.
    """
    found: dict[str, str] = {}
    for name in names:
        way, top = dict[str, None](), name
        while top in above and top not in found and top not in way:
            way[top] = None
            top = above[top]
        found.update(dict.fromkeys((*way, top), found.get(top, top)))
    return found
