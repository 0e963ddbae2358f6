"""The settings of a project for the language server."""

from dataclasses import replace
from pathlib import Path

import click

from twinform.cli.config_defaults import Project
from twinform.cli.config_file import ConfigError
from twinform.cli.nearest_projects import NearestProjects
from twinform.cli.rule_options import configured_policy
from twinform.cli.settings_of_files import NO_OWN_SETTINGS, OwnSettings
from twinform.compiler.input.load_options import profiles_of
from twinform.compiler.resolve_uris import SearchPath
from twinform.diagnostics import Policy
from twinform.profiles import Profile
from twinform.server.checking import EditorSettings


def settings_of(path: Path) -> EditorSettings:
    """Return the settings for a file from the nearest configuration, which is never trusted: nobody was asked."""
    try:
        project = NearestProjects().of(str(path))
        if project is None:
            return EditorSettings()
        own = project.per_file.of(str(path)) if project.per_file else NO_OWN_SETTINGS
        return _convert_settings(project, own)
    except (ConfigError, click.UsageError) as error:
        return EditorSettings(problem=str(error))


def _convert_settings(project: Project, own: OwnSettings) -> EditorSettings:
    usual, policy, defaults = EditorSettings(), configured_policy(project, own.rules, Policy()), project.defaults
    load_options = replace(
        usual.load_options,
        strict=bool(defaults.get("strict") if own.strict is None else own.strict),
        search=SearchPath.of(project.folders),
        arguments=own.arguments,
        robot=project.robot_of(own),
        allow=policy.allow,
        profiles=_profiles(str(defaults.get("profiles") or "")),
    )
    layout = replace(usual.layout, **{name: defaults[name] for name in _LAYOUT if name in defaults})
    if "indent" in defaults:
        layout = replace(layout, indent="\t" if defaults["indent"] == "tab" else " " * int(str(defaults["indent"])))
    return replace(usual, layout=layout, load_options=load_options, policy=policy)


_LAYOUT = ("numbers", "sort_attributes")


def _profiles(names: str) -> tuple[Profile, ...]:
    """Return the profiles of a project's consumers, which count only for formats that they read."""
    found = profiles_of(names) if names else ()
    return tuple(replace(each, named=False) for each in found)
