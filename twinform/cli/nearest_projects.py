"""Which configuration counts for a file: the nearest one, on the command line as in the editor."""

import os
from dataclasses import field
from pathlib import Path

import click

from twinform.cli.config_defaults import Project, context_for, counts_for_all, settings_of
from twinform.cli.config_file import ConfigError, Searched, line_of
from twinform.dataclass import dataclass
from twinform.diagnostics import Diagnostic, Location, Severity, rules


class NearestProjects:
    """Returns the project that a file belongs to; each configuration is read once."""

    def __init__(self) -> None:
        self._searched = Searched()
        self._known: dict[Path, Project | ConfigError] = {}

    def of(self, name: str) -> Project | None:
        """Return the project of a file; None if there is no configuration around it.

        Raises:
            ConfigError: the nearest configuration is wrong.
        """
        try:
            folder = Path(os.path.abspath(name)).parent  # noqa: PTH100 - links stay links
        except (FileNotFoundError, ValueError):
            return None  # the current folder is gone, or this is no name of a file
        return self.in_folder(folder)

    def in_folder(self, folder: Path) -> Project | None:
        """Return the project that an absolute folder belongs to.

        Raises:
            ConfigError: the nearest configuration is wrong.
        """
        found = self._searched.find(folder)
        if found is None:
            return None
        path, table = found
        if path not in self._known:
            try:
                self._known[path] = Project.of(path, table)
            except ConfigError as error:
                self._known[path] = error
        project = self._known[path]
        if isinstance(project, ConfigError):
            raise project
        return project


@dataclass(slots=True)
class ContextByFile:
    """Returns the context of a command as the configuration of each file makes it.

    That of the current folder counts for files that have none, and a configuration that is named counts for all.
    """

    ctx: click.Context
    projects: NearestProjects = field(default_factory=NearestProjects)
    _known: dict[Path | None, click.Context | ConfigError] = field(
        default_factory=dict[Path | None, click.Context | ConfigError]
    )

    def of(self, name: str) -> click.Context:
        """Return the context for a file.

        Raises:
            ConfigError: the nearest configuration is wrong.
        """
        if counts_for_all(self.ctx):
            return self.ctx
        project = self.projects.of(name)
        return self.ctx if project is None else self._of_project(project)

    def without_settings(self) -> click.Context:
        """Return the context that there would be without any configuration."""
        return self._of_project(Project())

    def _of_project(self, project: Project) -> click.Context:
        if project.path not in self._known:
            self._known[project.path] = self._make_context(project)
        found = self._known[project.path]
        if isinstance(found, ConfigError):
            raise found
        return found

    def _make_context(self, project: Project) -> click.Context | ConfigError:
        own = settings_of(self.ctx).path
        if project.path and own and os.path.realpath(own) == os.path.realpath(project.path):
            return self.ctx
        try:
            return context_for(self.ctx, project)
        except ConfigError as error:
            return error


def finding_of(error: ConfigError, name: str) -> Diagnostic:
    """Return a finding about the configuration of a file, which is named as that is: relative or absolute."""
    from twinform.compiler.input.xacro_needs import shown_name  # noqa: PLC0415 - few configurations are wrong

    message = ": ".join(part for part in (error.key, error.problem) if part)
    where = Location(shown_name(str(error.file), name), error.line or line_of(error.file, error.key))
    help = "until then the files below its folder are checked as if it were not there"
    return Diagnostic(rules.WRONG_CONFIGURATION, message, where, Severity.ERROR, help=help)
