"""The error of a configuration file that is wrong."""

from pathlib import Path

from twinform.cli.failure import Unusable

_SECTION = "tool.twinform"


class ConfigError(Unusable):
    """A configuration is wrong: names the file, the line where it is known, and the key."""

    def __init__(self, file: Path, problem: str, *, key: str = "", line: int | None = None) -> None:
        key = f"{_SECTION}{'.' if key else ''}{key}" if file.name == "pyproject.toml" and line is None else key
        where = f"{file}:{line}" if line is not None else str(file)
        super().__init__(": ".join(part for part in (where, key, problem) if part))
        self.file, self.problem, self.key, self.line = file, problem, key, line
