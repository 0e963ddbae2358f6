"""The settings of a project for the language server."""

from dataclasses import replace
from pathlib import Path

from twinform.cli.config_defaults import NO_OWN_SETTINGS, OwnSettings, PerFile, RuleSettings
from twinform.cli.config_file import ConfigError, find
from twinform.cli.config_settings import ProjectSettings, parse_settings
from twinform.cli.config_trust import require_inside
from twinform.cli.project_options import override_policy
from twinform.compiler.input.load_options import profiles_of
from twinform.compiler.resolve_uris import SearchPath
from twinform.diagnostics import Policy
from twinform.profiles import Profile
from twinform.server.checking import EditorSettings


def settings_of(path: Path) -> EditorSettings:
    """Return the settings for a file from the nearest configuration, which is never trusted: nobody was asked."""
    try:
        found = find(path.absolute().parent)
        if found is None:
            return EditorSettings()
        config, table = found
        project = parse_settings(config, table)
        for folder in project.paths:
            require_inside(config, Path(folder), "paths")
        own = PerFile(config, project.files).of(str(path)) if project.files else NO_OWN_SETTINGS
    except ConfigError as error:
        return EditorSettings(problem=str(error))
    return _convert_settings(project, own)


def _convert_settings(project: ProjectSettings, own: OwnSettings) -> EditorSettings:
    usual, policy = EditorSettings(), Policy()
    for rules in (RuleSettings(project.allow, project.deny), *own.rules):
        policy = override_policy(policy, rules)
    load_options = replace(
        usual.load_options,
        strict=bool(project.defaults.get("strict") if own.strict is None else own.strict),
        search=SearchPath.of(project.paths),
        arguments=own.arguments,
        allow=policy.allow,
        profiles=_profiles(project),
    )
    wanted, layout = project.format, usual.layout
    if wanted.indent is not None:
        layout = replace(layout, indent="\t" if wanted.indent == "tab" else " " * wanted.indent)
    layout = replace(layout, numbers=wanted.numbers or layout.numbers, sort_attributes=bool(wanted.sort_attributes))
    return replace(
        usual,
        layout=layout,
        load_options=load_options,
        policy=policy,
    )


def _profiles(project: ProjectSettings) -> tuple[Profile, ...]:
    """Return the profiles of a project's consumers, which count only for formats that they read."""
    found = profiles_of(",".join(project.profiles)) if project.profiles else ()
    return tuple(replace(each, named=False) for each in found)
