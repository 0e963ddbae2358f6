"""The settings that a configuration file can have, and the pipelines that it names."""

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any, ForwardRef, Literal, get_args

from pydantic import AfterValidator, BaseModel, ConfigDict, Field, ValidationError, create_model, field_validator

from twinform.cli.config_file import ConfigError, Table
from twinform.cli.presets import PRESETS, PresetName
from twinform.cli.rule_settings import RuleSettings
from twinform.compiler.input.load_options import FileOptions
from twinform.diagnostics.diagnostic import GROUPS
from twinform.diagnostics.sink import WARNINGS
from twinform.option import Option, declared_options
from twinform.passes import Pipeline, PipelineError, UnknownPipelineError, parse_pipeline
from twinform.passes.framework.pass_options import nearest
from twinform.passes.framework.pipeline_text import TableError, parse_tables
from twinform.passes.framework.syntax import KEY
from twinform.request_options import RequestOptions

_SCHEMA_LANGUAGE = "https://json-schema.org/draft/2020-12/schema"
_MOST = 1000
"""The most entries of a list in a configuration."""
Texts = Annotated[list[str], Field(max_length=_MOST)]

_CONFIG = ConfigDict(frozen=True, extra="forbid", strict=True, alias_generator=lambda name: name.replace("_", "-"))


class FormatSettings(BaseModel):
    """The settings of `twinform format`; None if a setting is not given."""

    model_config = _CONFIG

    indent: Annotated[int, Field(ge=0, le=16)] | Literal["tab"] | None = None
    numbers: Literal["kept", "shortest"] | None = None
    sort_attributes: bool | None = None


def _name_rules(schema: dict[str, Any]) -> None:
    """Offer editors the names of rules and groups; those of other packages may be there too."""
    from twinform.diagnostics.catalog import catalog  # noqa: PLC0415 - only the schema lists them

    schema["items"] = {"anyOf": [{"enum": [*GROUPS, WARNINGS, *catalog()]}, {"type": "string"}]}


_Rules = Annotated[Texts, Field(default_factory=list[str], json_schema_extra=_name_rules)]


class RuleTable(BaseModel):
    """The rules and groups that a table leaves out, selects, or makes errors."""

    model_config = _CONFIG

    allow: _Rules
    deny: _Rules
    ignore: _Rules
    select: _Rules
    extend_select: _Rules

    def rules(self, key: str = "") -> RuleSettings:
        """Return the rules of the table, whose key is given where it is not that of the whole configuration."""
        return RuleSettings(self.allow, self.deny, self.ignore, self.select, self.extend_select, key)


class FileSettings(RuleTable):
    """The settings of files that fit a pattern of `match`, in the notation of `.gitignore`."""

    match: Texts = Field(min_length=1)
    arguments: Mapping[str, str | int | float | bool] = Field(default_factory=dict[str, str | int | float | bool])
    strict: bool | None = None
    passes: str | None = None
    check_passes: str | None = None
    robot: str | None = None


def _type_of(kind: Any, option: Option) -> Any:
    """Return the type of an option in a configuration, in which values that are parsed may be texts."""
    parse, (kind, *_) = option.parse, get_args(kind) if type(None) in get_args(kind) else (kind,)
    if kind is int:
        kind = int | str if parse else Annotated[int, Field(gt=0)]
    elif isinstance(kind, ForwardRef):
        kind = str
    return Annotated[kind, AfterValidator(lambda value: parse(str(value)))] if parse else kind


_declared = {**declared_options(FileOptions), **declared_options(RequestOptions)}
_fields: dict[str, Any] = {
    name: (_type_of(kind, option) | None, None) for name, (kind, option) in _declared.items() if option.setting
}
_OptionSettings: type[RuleTable] = create_model("_OptionSettings", __base__=RuleTable, **_fields)


_SyncedFiles = Annotated[list[str], Field(min_length=2, max_length=_MOST)]
"""The files of one robot, the source first."""


class ProjectSettings(_OptionSettings):
    """The settings of a project; None if a setting is not given. Paths are relative to the folder of the file."""

    model_config = _CONFIG

    preset: PresetName | None = None
    read_carriers: bool | None = None
    check_passes: str | None = None
    paths: Texts = Field(default_factory=list[str])
    env: Texts = Field(default_factory=list[str])
    format: FormatSettings = Field(default_factory=FormatSettings)
    pipelines: Mapping[str, object] = Field(default_factory=dict[str, object])
    exclude: Texts | None = None
    extend_exclude: Texts = Field(default_factory=list[str])
    baseline: str | None = None
    files: list[FileSettings] = Field(max_length=_MOST, default_factory=list[FileSettings])
    sync: Mapping[str, _SyncedFiles] = Field(default_factory=dict[str, _SyncedFiles])
    profiles: Texts = Field(default_factory=list[str], alias="for")

    @field_validator("profiles")
    @classmethod
    def _are_profiles(cls, names: list[str]) -> list[str]:
        if names:
            from twinform.profiles import UnknownProfileError, parse  # noqa: PLC0415 - most projects have none

            try:
                parse(",".join(names))
            except UnknownProfileError as error:
                raise ValueError(str(error)) from error
        return names

    @property
    def defaults(self) -> Mapping[str, object]:
        """The defaults of options, by their names on the command line."""
        names = (*_fields, "read_carriers", "check_passes")
        given = {name: getattr(self, name) for name in names} | dict(self.format)
        given["profiles"] = ",".join(self.profiles) or None
        preset = PRESETS[self.preset or "default"].defaults
        return {**preset, **{name: value for name, value in given.items() if value is not None}}


def settings_schema_text() -> str:
    """Return the JSON Schema of `twinform.toml`, for editors."""
    import json  # noqa: PLC0415 - few runs print it

    schema = {"$schema": _SCHEMA_LANGUAGE, **ProjectSettings.model_json_schema(by_alias=True), "title": "twinform.toml"}
    return json.dumps(schema, indent=2) + "\n"


def parse_settings(path: Path, found: Table) -> ProjectSettings:
    """Parse the settings of a file.

    Raises:
        ConfigError: a key is unknown or has a wrong value.
    """
    try:
        settings = ProjectSettings.model_validate(found)
    except ValidationError as error:
        raise _config_error(path, error) from error
    folders = [str(path.parent / each) for each in settings.paths]
    for folder, each in zip(folders, settings.paths, strict=True):
        if not os.path.isdir(folder):  # noqa: PTH112 - Path.is_dir raises where a name is too long
            raise ConfigError(path, f"{each!r} is no folder", key="paths")
    return settings.model_copy(update={"paths": folders})


def _config_error(path: Path, error: ValidationError) -> ConfigError:
    """Convert Pydantic's first error."""
    problem = error.errors(include_url=False)[0]
    key = "".join(f"[{each}]" if isinstance(each, int) else f".{each}" for each in problem["loc"]).removeprefix(".")
    if problem["type"] == "extra_forbidden":
        table = {"files": FileSettings, "format": FormatSettings}.get(str(problem["loc"][0]), ProjectSettings)
        known = sorted(field.alias or name for name, field in table.model_fields.items())
        return ConfigError(path, f"there is no such key{nearest(str(problem['loc'][-1]), known)}", key=key)
    return ConfigError(
        path,
        problem["msg"].removeprefix("Value error, ").removeprefix("Input ").replace("dictionary", "table"),
        key=key,
    )


_DEEPEST = 32
"""The deepest nesting of pipelines in one another."""
# A pipeline that names another one twice has twice as many passes: 26 such pipelines have 33 million.
_MOST_PASSES = 1000


class NamedPipelines:
    """Returns the pipeline of a name when it is called; each is parsed when it is needed."""

    def __init__(self, path: Path, raw: Mapping[str, object]) -> None:
        """Take the texts or tables of the pipelines in the file at `path`.

        Raises:
            ConfigError: a name cannot be written as `@NAME`.
        """
        self.path, self.raw = path, raw
        self._open: list[str] = []
        self._known: dict[str, Pipeline] = {}
        for name in raw:
            if not KEY.fullmatch(name):
                problem = "the name of a pipeline takes letters, digits, _ and -"
                raise ConfigError(path, problem, key=f'pipelines."{name}"')

    def __call__(self, name: str) -> Pipeline:
        """Return the pipeline of this name, which may name others but not itself.

        Raises:
            UnknownPipelineError: there is no such pipeline, or it names itself.
            ConfigError: the pipeline is wrong.
        """
        if name not in self.raw:
            raise UnknownPipelineError(f"no pipeline is called {name} in {self.path}{nearest(name, list(self.raw))}")
        if name in self._open:
            raise UnknownPipelineError(f"a pipeline stands for itself: {' -> '.join((*self._open, name))}")
        if len(self._open) >= _DEEPEST:
            raise UnknownPipelineError(f"more than {_DEEPEST} pipelines stand for each other: {name} is one too many")
        if name not in self._known:
            self._open.append(name)
            try:
                self._known[name] = self._parse(name)
            finally:
                self._open.pop()
        return self._known[name]

    def _parse(self, name: str) -> Pipeline:
        raw, key = self.raw[name], f"pipelines.{name}"
        try:
            found = parse_pipeline(raw, names=self) if isinstance(raw, str) else parse_tables(raw, names=self)
        except PipelineError as error:
            raise ConfigError(self.path, str(error), key=key) from error
        except TableError as error:
            raise ConfigError(self.path, error.problem, key=key + error.key) from error
        if len(found.passes) > _MOST_PASSES:
            raise ConfigError(self.path, f"it stands for more than {_MOST_PASSES:,} passes", key=key)
        return found
