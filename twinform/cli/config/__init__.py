"""Project configuration: settings in `twinform.toml` or under `[tool.twinform]` in `pyproject.toml`."""

from twinform.cli.config.errors import ConfigError
from twinform.cli.config.options import config_options, settings_of
from twinform.cli.config.settings import Settings

__all__ = ["ConfigError", "Settings", "config_options", "settings_of"]
