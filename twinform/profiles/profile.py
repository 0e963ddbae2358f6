"""`Profile`: what a consumer of models refuses, drops, misreads or warns about, from `data/NAME.toml`."""

import re
import tomllib
from dataclasses import replace
from enum import StrEnum
from functools import cache
from typing import Any

from pydantic import BaseModel, ConfigDict, Field, ValidationError, field_validator

from twinform.dataclass import dataclass
from twinform.diagnostics import Diagnostic, Severity
from twinform.diagnostics.did_you_mean import did_you_mean
from twinform.ir import Format
from twinform.package_files import package_files
from twinform.profiles.releases import Release, UnknownReleaseError, find_release, is_between

PORTABLE = "portable"
"""The profile of all consumers that are tested."""


class ProfileError(ValueError):
    """The file of a profile is wrong; the message names the file and the row."""


class UnknownProfileError(LookupError):
    """No profile has this name, or its consumer has no such release."""


class Effect(StrEnum):
    """What a consumer does with something in a file, from the worst to the mildest."""

    REFUSES = "refuses"
    DROPS = "drops"
    MISREADS = "misreads"
    WARNS = "warns"


class ProfileRow(BaseModel):
    """One thing that a consumer objects to: the rule that finds it, and what the consumer does.

    `format`, `message`, `place`, `severity`, `since` and `until` narrow the findings: the format of the file, patterns
    that occur in the message and in the XML path, the least severity, and the first and the last release, by any of
    their names. `pipeline` are the passes that help; where the rule has fixes, `check --fix` helps as well. `source` is
    where the row was read, empty where a release that it holds for was asked.
    """

    model_config = ConfigDict(frozen=True, extra="forbid", populate_by_name=True)

    rule: str
    effect: Effect
    about: str
    format: Format | None = None
    message: str = ""
    place: str = ""
    severity: Severity = Severity.INFO
    since: str = ""
    until: str = ""
    pipeline: str = Field(default="", alias="pass")
    to: Format | None = None
    source: str = ""

    @field_validator("severity", mode="before")
    @classmethod
    def _of_name(cls, name: object) -> object:
        return Severity[name.upper()] if isinstance(name, str) and name.upper() in Severity.__members__ else name

    @field_validator("message", "place")
    @classmethod
    def _is_pattern(cls, text: str) -> str:
        re.compile(text)
        return text

    def minds(self, finding: Diagnostic, format_: Format | None) -> bool:
        """Whether the row is about a finding in a file of this format."""
        return (
            finding.rule.name == self.rule
            and finding.severity >= self.severity
            and (self.format is None or format_ is None or self.format is format_)
            and re.search(self.message, finding.message) is not None
            and re.search(self.place, finding.location.path) is not None
        )


class _Table(BaseModel):
    """The content of the file of a profile."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    title: str
    about: str
    formats: tuple[Format, ...]
    tested: bool = True
    reads: str = ""
    """The profile whose table in `data/reads/` this one has."""

    releases: tuple[Release, ...] = ()
    """From the oldest on; where it lists none, those that distributions ship of the profile whose table it has."""

    release: str = ""
    """The release that is meant by default; empty for the newest."""

    row: tuple[ProfileRow, ...] = ()


@dataclass(frozen=True, slots=True)
class Profile:
    """A consumer in one of its releases, and the rows that hold for it.

    `tested` is whether the consumer was asked, in this release or in one that rows of this release hold for as well.
    `reads` is the name of a table in `data/reads/` with a release, if there is one. `named` is whether the user asked
    for this profile and not for all, and `called` the name that the user has for the release.
    """

    name: str
    title: str
    about: str
    formats: tuple[Format, ...]
    tested: bool
    release: Release
    rows: tuple[ProfileRow, ...]
    reads: str = ""
    called: str = ""
    named: bool = True

    @property
    def consumer(self) -> str:
        """The name with that of the release, where there is one, as `--for` takes it."""
        return f"{self.name}@{self.called}" if self.called else self.name

    @property
    def version(self) -> str:
        """The release as the user calls it, or else the version of it that was tested."""
        return self.called or self.release.seen or self.release.name

    @property
    def is_complete(self) -> bool:
        """Whether the consumer reads what no row is about: it was tested, or there is a table of what it reads."""
        return self.tested or bool(self.reads)

    @property
    def label(self) -> str:
        """The name for messages, such as `MuJoCo 4.0.0`."""
        return f"{self.title} {self.version}"


@cache
def names() -> tuple[str, ...]:
    """The names of all profiles; `portable` stands for all tested ones."""
    folder = package_files("twinform.profiles").joinpath("data")
    found = [each.name.removesuffix(".toml") for each in folder.iterdir() if each.name.endswith(".toml")]
    return (*sorted(found), PORTABLE)


def every_release() -> tuple[Profile, ...]:
    """All profiles, once for each of their releases, oldest first."""
    every = (f"{name}@{each.name}" for name in names() if name != PORTABLE for each in releases_of(name))
    return tuple(profile for text in every for profile in load(text))


@cache
def load(text: str) -> tuple[Profile, ...]:
    """The profiles that a name means: one, with a release after `@` (`gazebo@harmonic`), or all tested ones.

    Raises:
        UnknownProfileError: there is no profile of this name, or no such release.
        ProfileError: the file of the profile is wrong.
    """
    name, _, called = text.strip().partition("@")
    if name not in names():
        near = did_you_mean(name, names()) or f"there are {', '.join(names())}"
        raise UnknownProfileError(f"there is no profile {name!r}; {near}")
    if name == PORTABLE:
        if called:
            raise UnknownProfileError(f"{PORTABLE!r} has no releases")
        every = (each for one in names() if one != PORTABLE for each in load(one))
        return tuple(replace(each, named=False) for each in every if each.tested)
    return (_in_release(name, called),)


def parse(text: str) -> tuple[Profile, ...]:
    """The profiles of names separated by commas, each once.

    Raises:
        UnknownProfileError: a name has no profile.
    """
    found = [profile for name in text.split(",") if name.strip() for profile in load(name)]
    if not found:
        raise UnknownProfileError(f"name a profile: {', '.join(names())}")
    return tuple({(each.name, each.release): each for each in found}.values())


def releases_of(name: str) -> tuple[Release, ...]:
    """The releases of a consumer, from the oldest on.

    Raises:
        ProfileError: the file of the profile is wrong.
    """
    return _read_table(name).releases


def all_rows(name: str) -> tuple[ProfileRow, ...]:
    """The rows of a consumer for all of its releases.

    Raises:
        ProfileError: the file of the profile is wrong.
    """
    return _read_table(name).row


def release_of(name: str, called: str = "") -> Release:
    """A release of a consumer by any of its names; the default one where none is given.

    Raises:
        UnknownProfileError: there is no such release.
        ProfileError: the file of the profile is wrong.
    """
    table = _read_table(name)
    try:
        return find_release(table.releases, called or table.release or table.releases[-1].name)
    except UnknownReleaseError as error:
        raise UnknownProfileError(f"{name!r} has no release {called!r}; {error}") from None


@cache
def _read_table(name: str) -> _Table:
    file = package_files("twinform.profiles").joinpath("data", f"{name}.toml")
    try:
        table = _Table.model_validate(tomllib.loads(file.read_text(encoding="utf-8")))
    except (ValidationError, tomllib.TOMLDecodeError, re.error) as error:
        raise ProfileError(f"{name}.toml: {error}") from error
    if table.releases:
        return table
    base = _read_table(table.reads)
    shipped = tuple(each.as_shipped() for each in base.releases if each.also)
    return table.model_copy(update={"releases": shipped, "release": table.release or base.release})


def _in_release(name: str, called: str) -> Profile:
    table, release = _read_table(name), release_of(name, called)
    known = table.releases
    try:
        rows = tuple(row for row in table.row if is_between(known, release.name, row.since, row.until))
    except UnknownReleaseError as error:
        raise ProfileError(f"{name}.toml: a row is about a release that there is not; {error}") from error
    reads = f"{table.reads}@{release.name}" if table.reads else ""
    about = (table.title, table.about, table.formats, table.tested)
    return Profile(name, *about, release, rows, reads, called)


def explanations() -> dict[str, Any]:
    """Each profile by name, with what it is about, for help texts."""
    return {name: _read_table(name).about for name in names() if name != PORTABLE}
