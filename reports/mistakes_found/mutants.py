"""The mutants that mutmut made, room by room, and what became of them."""

import re
import tomllib
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from random import Random

from mutmut.mutation.data import SourceFileMutationData
from mutmut.mutation.diff_apply import get_diff_for_mutant
from mutmut.stats import status_by_exit_code
from mutmut.utils.format_utils import get_module_from_key, orig_function_and_class_names_from_key

from testbed.corpus.files import ROOT

NOTICED = ("killed", "timeout")
UNTRIED = "not checked"
_EQUIVALENT = tomllib.loads(Path(__file__).with_name("equivalent_mutants.toml").read_text(encoding="utf-8"))
_FOLDERS = {"ir": ("ir",), "passes": ("passes",), "readers": ("schemas", "compiler")}
_STRICT = re.compile(r",\s*(?:strict=\w+)?(?=\))")
_CAST = re.compile(r'\bcast\((?:"[^"]*"|\w+)')
_LITERAL = re.compile(r'"(?:[^"\\]|\\.)*"')


@dataclass(frozen=True)
class Mutant:
    """One change of one function."""

    name: str
    path: Path

    @cached_property
    def status(self) -> str:
        """What mutmut found out: killed, survived, no tests, timeout."""
        data = SourceFileMutationData(path=self.path)
        data.load()
        return status_by_exit_code[data.exit_code_by_key[self.name]]

    @property
    def function(self) -> str:
        """The function that is changed, with its module."""
        function, owner = orig_function_and_class_names_from_key(self.name)
        return ".".join(filter(None, (get_module_from_key(self.name), owner, function)))

    @cached_property
    def diff(self) -> tuple[str, ...]:
        """The lines that differ."""
        lines = get_diff_for_mutant(self.name, path=self.path).splitlines()
        return tuple(line for line in lines if line[:1] in "+-" and line[:3] not in {"+++", "---"})

    @property
    def change(self) -> str:
        """The lines that differ as one line, which stays the same when the function has more mutants."""
        return " ".join(f"{line[0]} {line[1:].strip()}" for line in self.diff)

    @property
    def equivalent(self) -> str:
        """Why the program does the same with it; empty where it does not, or nobody has examined it."""
        return _EQUIVALENT.get(self.function, {}).get(self.change, "")


def mutants(room: str) -> list[Mutant]:
    """All of a room, in the order of their names."""
    return sorted(_found(room), key=lambda each: each.name)


def draw(room: str, size: int, seed: int) -> list[Mutant]:
    """So many of a room, or all; those that only change wording or assertions are passed over."""
    drawn = mutants(room)
    Random(seed).shuffle(drawn)
    telling = (each for each in drawn if not (is_wording(each.diff) or is_assertion(each.diff)))
    return [each for each, _ in zip(telling, range(size), strict=False)]


def is_wording(diff: Sequence[str]) -> bool:
    """Whether it only rewords a message: a literal with a blank, in other letters or between XX."""
    before, after = (_LITERAL.findall("\n".join(line for line in diff if line[0] == sign)) for sign in "-+")
    changed = [(old, new.lower()) for old, new in zip(before, after, strict=False) if old != new]
    return len(changed) == 1 and all(
        " " in old and new in {old.lower(), f'"xx{old[1:-1].lower()}xx"'} for old, new in changed
    )


def is_assertion(diff: Sequence[str]) -> bool:
    """Whether it only takes `strict=True` from a `zip`, or the type from a `cast`: both only assert what is so."""
    before, after = (
        [_CAST.sub("cast(", _STRICT.sub("", line[1:])) for line in diff if line[0] == sign] for sign in "-+"
    )
    return before == after


def _found(room: str) -> Iterator[Mutant]:
    for folder in _FOLDERS[room]:
        for meta in (ROOT / "mutants" / "twinform" / folder).rglob("*.py.meta"):
            path = meta.relative_to(ROOT / "mutants").with_suffix("")
            data = SourceFileMutationData(path=path)
            data.load()
            yield from (Mutant(name, path) for name in data.exit_code_by_key)
