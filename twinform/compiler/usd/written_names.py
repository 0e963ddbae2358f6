"""Names of prims: they are identifiers, and stand for the names of links and joints, which may be any text."""

import re
from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator

from twinform.compiler.usd.stage import Prim

_NOT_IN_IDENTIFIERS = re.compile(r"[^A-Za-z0-9_]")
_NUMBERED = re.compile(r"_\d+$")
_RESERVED = frozenset({"world"})


class WrittenNames:
    """The names that a model was written with, of which some may be `known`."""

    def __init__(self, known: frozenset[str] | None = None) -> None:
        self.known = known
        self._spelled = defaultdict[str, list[str]](list)
        for name in known or ():
            for spelling in set(_spellings(name)):
                self._spelled[spelling].append(name)

    def of(self, prims: Iterable[Prim]) -> dict[str, str]:
        """Return the names of prims by their paths: of those that share one, the paths."""
        found = {prim.path: self._written(prim.name) for prim in prims}
        counts = Counter(found.values())
        return {path: name if counts[name] == 1 else path for path, name in found.items()}

    def is_frame(self, name: str) -> bool:
        """Whether a transform of this name is a frame of the model: most only hold other prims."""
        return name not in _RESERVED and not name.startswith("/") and (self.known is None or name in self.known)

    def _written(self, name: str) -> str:
        """Return the one known name that is spelled like an identifier, or the identifier itself."""
        if self.known is None or name in self.known:
            return name
        for spelling in (name, _NUMBERED.sub("", name)):  # a number tells names apart that are spelled alike
            if len(self._spelled[spelling]) == 1:
                return self._spelled[spelling][0]
        return name


def _spellings(name: str) -> Iterator[str]:
    """Yield how converters spell a name as an identifier: as USD does (TfMakeValidIdentifier), or with a letter."""
    spelled = _NOT_IN_IDENTIFIERS.sub("_", name)
    if not spelled[:1].isdigit():
        yield spelled
        return
    yield from (f"_{spelled[1:]}", f"_{spelled}", f"a_{spelled}")
