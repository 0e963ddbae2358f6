"""Settings of some files of a project, by patterns: the tables `[[files]]` of a configuration."""

import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple, TypeVar

from twinform.cli.config.config_error import ConfigError

Value = TypeVar("Value")

if TYPE_CHECKING:
    from twinform.cli.config.settings import FileSettings


class RuleSettings(NamedTuple):
    """The rules that a table allows and denies, and their keys without the last word."""

    allow: Sequence[str]
    deny: Sequence[str]
    key: str = ""


@dataclass(frozen=True, slots=True)
class OwnSettings:
    """The settings of one file beyond those of the project; `None` and nothing where there are none.

    Pipelines have the key that they come from, and rules come table by table.
    """

    arguments: Mapping[str, str] = field(default_factory=dict[str, str])
    strict: bool | None = None
    passes: tuple[str, str] | None = None
    check_passes: tuple[str, str] | None = None
    rules: Sequence[RuleSettings] = ()


NO_OWN_SETTINGS = OwnSettings()


class PerFile:
    """The tables of a configuration, in their order: of those that fit a file the later ones go before the others."""

    def __init__(self, path: Path, tables: Sequence["FileSettings"]) -> None:
        """From the tables of the file at a path.

        Raises:
            ConfigError: a pattern is none.
        """
        from twinform.cli.files.patterns import PathPatterns, PatternError  # noqa: PLC0415 - few projects have tables

        self.tables: list[tuple[str, PathPatterns, FileSettings]] = []
        for number, table in enumerate(tables):
            key = f"files[{number}]"
            try:
                self.tables.append((key, PathPatterns.of(path.parent, table.match), table))
            except PatternError as error:
                raise ConfigError(path, str(error), key=f"{key}.match") from error

    def of(self, name: str) -> OwnSettings:
        """The settings of a file."""
        path = os.path.abspath(name)  # noqa: PTH100 - links stay links
        fitting = [(key, table) for key, patterns, table in self.tables if patterns.match(path)]
        if not fitting:
            return NO_OWN_SETTINGS
        return OwnSettings(
            arguments={name: _text(value) for _, table in fitting for name, value in table.arguments.items()},
            strict=_last_given(table.strict for _, table in fitting),
            passes=_last_given((table.passes, f"{key}.passes") for key, table in fitting if table.passes is not None),
            check_passes=_last_given(
                (table.check_passes, f"{key}.check-passes") for key, table in fitting if table.check_passes is not None
            ),
            rules=[RuleSettings(table.allow, table.deny, key) for key, table in fitting],
        )


def _last_given(values: Iterable[Value | None]) -> Value | None:
    """Return the last value that is set; None if none is."""
    return next((each for each in reversed([*values]) if each is not None), None)


def _text(value: str | float | bool) -> str:
    """A value as xacro writes it."""
    return str(value).lower() if isinstance(value, bool) else str(value)
