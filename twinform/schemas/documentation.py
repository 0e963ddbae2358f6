"""Documentation texts in the schemas: an element's or attribute's meaning, unit, default and versions."""

from collections.abc import Iterable, Sequence

from twinform.schemas.facts import Fact, Table, parse_version, print_version
from twinform.schemas.meanings import Path, meanings

_UNIT_WORDS = {"kg*m^2": "kg m^2", "N*m": "N m", "kg*m": "kg m"}


class Documentation:
    """The documentation of one format."""

    def __init__(self, facts: Table) -> None:
        self.table = facts
        self.texts = meanings(facts.format)

    def of(self, path: Path, row: Fact, like: Sequence[Fact] = ()) -> str:
        """The documentation of a row; `like` are all rows of its name, one for each group of versions."""
        sentences = [self.texts.get(path, "")]
        if row.unit is not None:
            sentences.append(f"Unit: {_UNIT_WORDS.get(row.unit, row.unit)}.")
        if row.default is not None:
            sentences.append(f"Default: {row.default}.")
        sentences += self._range(row)
        sentences += self._versions(like or (row,))
        if row.deprecated:
            sentences.append("Deprecated.")
        return " ".join(filter(None, sentences))

    def of_definition(self, name: str) -> str:
        """The documentation of a definition, wherever it is used."""
        return self.texts.get((name,), "")

    def _range(self, row: Fact) -> Iterable[str]:
        if row.min is not None and row.max is not None:
            yield f"From {row.min:g} to {row.max:g}."
        elif row.min is not None:
            yield f"At least {row.min:g}."
        elif row.max is not None:
            yield f"At most {row.max:g}."

    def _versions(self, rows: Sequence[Fact]) -> Iterable[str]:
        since, until = min(row.since for row in rows), max(row.until for row in rows)
        name, first = self.table.format.upper(), parse_version(self.table.versions[0])
        if since > first:
            yield f"Since {name} {print_version(since)}."
        if until < self.table.newest:
            yield f"Until {name} {print_version(until)}."
