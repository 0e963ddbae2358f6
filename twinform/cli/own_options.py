"""The options for one file: those of the command line, of the project, and of the file's own settings in it."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, NamedTuple

import click
from click.core import ParameterSource

from twinform.cli.config import settings_of
from twinform.cli.config.per_file import NO_OWN_SETTINGS, OwnSettings, RuleSettings
from twinform.cli.inputs import load_options_of
from twinform.cli.pipeline_option import configured_pipeline
from twinform.cli.policy import policy_of
from twinform.compiler import LoadOptions
from twinform.compiler.input.load_options import FileOptions
from twinform.diagnostics import Policy

if TYPE_CHECKING:
    from twinform.passes import Pipeline
    from twinform.profiles import Profile

_TYPED = (ParameterSource.COMMANDLINE, ParameterSource.ENVIRONMENT)


class ResolvedOptions(NamedTuple):
    """How one file is read, what is allowed in it, and the passes that are run on it."""

    load_options: LoadOptions
    policy: Policy
    passes: "Pipeline | None"


@dataclass(slots=True)
class OptionsByFile:
    """Gives the options for each file; `option` is the name of the one that has the passes.

    `profiles` are those of the consumers that the files are for. `usual` are the options of a file without settings of
    its own. All share what they know of folders.
    """

    ctx: click.Context
    arguments: Mapping[str, str]
    reading: FileOptions
    rules: RuleSettings
    passes: "Pipeline | None"
    option: str = "passes"
    profiles: "tuple[Profile, ...]" = ()
    usual: ResolvedOptions = field(init=False)

    def __post_init__(self) -> None:
        policy = policy_of(self.ctx, self.rules)
        self.usual = ResolvedOptions(
            load_options_of(self.arguments, self.reading, policy, self.profiles), policy, self.passes
        )

    def of(self, name: str) -> ResolvedOptions:
        """The options for the file of this name.

        Raises:
            ConfigError: something is wrong with its settings.
        """
        per_file = settings_of(self.ctx).per_file
        own = per_file.of(name) if per_file else NO_OWN_SETTINGS
        return self.usual if own is NO_OWN_SETTINGS else self._with(self.usual, own)

    def _with(self, usual: ResolvedOptions, own: OwnSettings) -> ResolvedOptions:
        policy = policy_of(self.ctx, self.rules, own)
        load_options = replace(usual.load_options, arguments={**own.arguments, **self.arguments}, allow=policy.allow)
        if own.strict is not None and not self._is_typed("strict"):
            load_options = replace(load_options, strict=own.strict)
        configured = own.check_passes if self.option == "check_passes" else own.passes
        if configured is None or self._is_typed(self.option):
            return ResolvedOptions(load_options, policy, usual.passes)
        text, key = configured
        passes = configured_pipeline(settings_of(self.ctx), text, key) if text else None
        return ResolvedOptions(load_options, policy, passes)

    def _is_typed(self, option: str) -> bool:
        return self.ctx.get_parameter_source(option) in _TYPED
