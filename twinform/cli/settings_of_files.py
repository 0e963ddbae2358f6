"""The settings that the tables `[[files]]` of a configuration have for single files."""

import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import field
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

from twinform.cli.config_file import ConfigError
from twinform.dataclass import dataclass

if TYPE_CHECKING:
    from twinform.cli.config_settings import FileSettings
    from twinform.cli.path_patterns import PathPatterns
    from twinform.cli.rule_settings import RuleSettings

Value = TypeVar("Value")


@dataclass(frozen=True, slots=True)
class OwnSettings:
    """The settings of one file beyond those of the project; None if a setting is not given.

    Pipelines, and the file of the robot that this one is for, have the key that they come from; rules are listed table
    by table.
    """

    arguments: Mapping[str, str] = field(default_factory=dict[str, str])
    strict: bool | None = None
    passes: tuple[str, str] | None = None
    check_passes: tuple[str, str] | None = None
    robot: tuple[str, str] | None = None
    rules: "Sequence[RuleSettings]" = ()


NO_OWN_SETTINGS = OwnSettings()


def parse_patterns(path: Path, lines: Sequence[str], key: str) -> "PathPatterns":
    """Parse the patterns that the configuration at a path has under a key.

    Raises:
        ConfigError: one is invalid.
    """
    from twinform.cli.path_patterns import PathPatterns, PatternError  # noqa: PLC0415 - few projects have any

    try:
        return PathPatterns.of(path.parent, lines)
    except PatternError as error:
        raise ConfigError(path, str(error), key=key) from error


class PerFile:
    """The tables `[[files]]` of a configuration; of several that fit a file, the last one wins."""

    def __init__(self, path: Path, tables: Sequence["FileSettings"]) -> None:
        """Take the tables of the configuration at a path.

        Raises:
            ConfigError: a pattern is invalid.
        """
        self.tables = [
            (f"files[{number}]", parse_patterns(path, table.match, f"files[{number}].match"), table)
            for number, table in enumerate(tables)
        ]

    def of(self, name: str) -> OwnSettings:
        """Return the settings of a file."""
        path = os.path.abspath(name)  # noqa: PTH100 - links stay links
        fitting = [(key, table) for key, patterns, table in self.tables if patterns.match(path)]
        if not fitting:
            return NO_OWN_SETTINGS
        return OwnSettings(
            arguments={name: _xacro_text(value) for _, table in fitting for name, value in table.arguments.items()},
            strict=_last_given(table.strict for _, table in fitting),
            passes=_last_given((table.passes, f"{key}.passes") for key, table in fitting if table.passes is not None),
            check_passes=_last_given(
                (table.check_passes, f"{key}.check-passes") for key, table in fitting if table.check_passes is not None
            ),
            robot=_last_given((table.robot, f"{key}.robot") for key, table in fitting if table.robot is not None),
            rules=[table.rules(key) for key, table in fitting],
        )


def _last_given(values: Iterable[Value | None]) -> Value | None:
    """Return the last value that is set; None if none is."""
    return next((each for each in reversed([*values]) if each is not None), None)


def _xacro_text(value: str | float | bool) -> str:
    """Write a value as xacro does."""
    return str(value).lower() if isinstance(value, bool) else str(value)
