"""`Groups`: disjoint sets of names, such as the links that joints connect."""


class Groups:
    """Disjoint sets of names; each name is a set of its own until it is joined with others."""

    def __init__(self) -> None:
        self._up: dict[str, str] = {}

    def find(self, name: str) -> str:
        """The name that stands for the set of a name; paths are halved on the way, so that long chains stay cheap."""
        while (above := self._up.get(name, name)) != name:
            self._up[name] = self._up.get(above, above)
            name = above
        return name

    def join(self, one: str, other: str) -> bool:
        """Make one set of those of two names, for which the first one's stands; returns whether they were apart."""
        one, other = self.find(one), self.find(other)
        if one != other:
            self._up[other] = one
        return one != other
