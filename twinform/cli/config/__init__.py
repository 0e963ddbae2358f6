"""Project configuration: settings in `twinform.toml`, or under `[tool.twinform]` in `pyproject.toml`."""

from twinform.cli.config.config_defaults import Project, config_options, hold_limit, settings_of
from twinform.cli.config.config_file import ConfigError

__all__ = ["ConfigError", "Project", "config_options", "hold_limit", "settings_of"]
