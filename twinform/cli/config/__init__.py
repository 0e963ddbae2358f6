"""Project configuration: settings in `twinform.toml` or under `[tool.twinform]` in `pyproject.toml`."""

from twinform.cli.config.errors import ConfigError
from twinform.cli.config.options import Project, config_options, hold_limit, settings_of

__all__ = ["ConfigError", "Project", "config_options", "hold_limit", "settings_of"]
