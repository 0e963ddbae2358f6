"""The settings that a configuration file can have."""

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any, ForwardRef, Literal, get_args

from pydantic import AfterValidator, BaseModel, ConfigDict, Field, ValidationError, create_model, field_validator

from twinform.cli.config.config_error import ConfigError
from twinform.cli.config.config_file import Table
from twinform.compiler.input.load_options import FileOptions
from twinform.compiler.option import Option, declared_options
from twinform.compiler.request_options import RequestOptions
from twinform.passes.framework.pass_options import nearest

_MOST = 1000
"""Folders, patterns, names of rules and tables of files that a configuration may list."""
Texts = Annotated[list[str], Field(max_length=_MOST)]

_CONFIG = ConfigDict(frozen=True, extra="forbid", strict=True, alias_generator=lambda name: name.replace("_", "-"))


class FormatSettings(BaseModel):
    """The settings of `twinform format`; `None` where nothing is set."""

    model_config = _CONFIG

    indent: Annotated[int, Field(ge=0, le=16)] | Literal["tab"] | None = None
    numbers: Literal["kept", "shortest"] | None = None
    sort_attributes: bool | None = None


class FileSettings(BaseModel):
    """The settings of some files: those that a pattern of `match` fits, in the notation of `.gitignore`."""

    model_config = _CONFIG

    match: Texts = Field(min_length=1)
    arguments: Mapping[str, str | int | float | bool] = Field(default_factory=dict[str, str | int | float | bool])
    strict: bool | None = None
    passes: str | None = None
    check_passes: str | None = None
    allow: Texts = Field(default_factory=list[str])
    deny: Texts = Field(default_factory=list[str])


def _type_of(kind: Any, option: Option) -> Any:
    """The type of an option in a configuration, where a text may stand for what is parsed of one, and for passes."""
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
_OptionSettings: type[BaseModel] = create_model("_OptionSettings", __config__=_CONFIG, **_fields)


class ProjectSettings(_OptionSettings):
    """The settings of a project; `None` where nothing is set. Paths are relative to the folder of the file."""

    model_config = _CONFIG

    read_carriers: bool | None = None
    check_passes: str | None = None
    paths: Texts = Field(default_factory=list[str])
    env: Texts = Field(default_factory=list[str])
    allow: Texts = Field(default_factory=list[str])
    deny: Texts = Field(default_factory=list[str])
    format: FormatSettings = Field(default_factory=FormatSettings)
    pipelines: Mapping[str, object] = Field(default_factory=dict[str, object])
    exclude: Texts | None = None
    extend_exclude: Texts = Field(default_factory=list[str])
    baseline: str | None = None
    files: list[FileSettings] = Field(max_length=_MOST, default_factory=list[FileSettings])
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
        """What options are where the command line has none, by the names that they have there."""
        names = (*_fields, "read_carriers", "check_passes")
        given = {name: getattr(self, name) for name in names} | dict(self.format)
        given["profiles"] = ",".join(self.profiles) or None
        return {name: value for name, value in given.items() if value is not None}


def parse_settings(path: Path, found: Table) -> ProjectSettings:
    """The settings in a file.

    Raises:
        ConfigError: a key is unknown, or has a value that it does not take.
    """
    try:
        settings = ProjectSettings.model_validate(found)
    except ValidationError as error:
        raise _readable(path, error) from error
    folders = [str(path.parent / each) for each in settings.paths]
    for folder, each in zip(folders, settings.paths, strict=True):
        if not os.path.isdir(folder):  # noqa: PTH112 - Path.is_dir raises where a name is too long
            raise ConfigError(path, f"{each!r} is no folder", key="paths")
    return settings.model_copy(update={"paths": folders})


def _readable(path: Path, error: ValidationError) -> ConfigError:
    """Pydantic's first complaint."""
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
