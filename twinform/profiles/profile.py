"""`Profile`: what a consumer of models refuses, drops, misreads or warns about, from `data/NAME.toml`."""

import re
import tomllib
from enum import StrEnum
from functools import cache
from typing import Any

from pydantic import BaseModel, ConfigDict, Field, ValidationError, field_validator

from twinform.dataclass import dataclass
from twinform.diagnostics import Diagnostic, Severity
from twinform.diagnostics.did_you_mean import did_you_mean
from twinform.ir import Format
from twinform.package_files import package_files

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
    that occur in the message and in the XML path, the least severity, and the first and the last release. `pipeline`
    are the passes that help; where the rule has fixes, `check --fix` helps as well.
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
    seen: str = ""
    tested: bool = True
    reads: str = ""
    sdf: str = ""
    releases: dict[str, str] = {}
    """The releases, oldest first, with the newest version of SDF that each of them reads."""

    release: str = ""
    """The release that is meant by default."""

    row: tuple[ProfileRow, ...] = ()


@dataclass(frozen=True, slots=True)
class Profile:
    """A consumer, perhaps in one of its releases, and the rows that hold for it.

    `seen` is the version that was tested, empty where it was not `tested` but read in sources and documentation.
    `reads` is the name of a table in `data/reads/`, if there is one, and `sdf` the newest version of SDF that the
    consumer reads, empty where that does not matter. `named` is whether the user asked for this profile and not for
    all.
    """

    name: str
    title: str
    about: str
    formats: tuple[Format, ...]
    seen: str
    tested: bool
    release: str
    rows: tuple[ProfileRow, ...]
    reads: str = ""
    sdf: str = ""
    named: bool = True

    @property
    def label(self) -> str:
        """The name for messages, such as `MuJoCo 4.0.0`."""
        return f"{self.title} {self.release or self.seen}".strip()


@cache
def names() -> tuple[str, ...]:
    """The names of all profiles; `portable` stands for all tested ones."""
    folder = package_files("twinform.profiles").joinpath("data")
    found = [each.name.removesuffix(".toml") for each in folder.iterdir() if each.name.endswith(".toml")]
    return (*sorted(found), PORTABLE)


@cache
def load(text: str) -> tuple[Profile, ...]:
    """The profiles that a name means: one, with a release after `@` (`gazebo@harmonic`), or all tested ones.

    Raises:
        UnknownProfileError: there is no profile of this name, or no such release.
        ProfileError: the file of the profile is wrong.
    """
    name, _, release = text.strip().partition("@")
    if name not in names():
        near = did_you_mean(name, names()) or f"there are {', '.join(names())}"
        raise UnknownProfileError(f"there is no profile {name!r}; {near}")
    if name == PORTABLE:
        if release:
            raise UnknownProfileError(f"{PORTABLE!r} has no releases")
        every = [_read_table(each) for each in names() if each != PORTABLE]
        return tuple(_select_release(each_name, table, "", named=False) for each_name, table in every if table.tested)
    return (_select_release(*_read_table(name), release),)


def parse(text: str) -> tuple[Profile, ...]:
    """The profiles of names separated by commas, each once.

    Raises:
        UnknownProfileError: a name has no profile.
    """
    found = [profile for name in text.split(",") if name.strip() for profile in load(name)]
    if not found:
        raise UnknownProfileError(f"name a profile: {', '.join(names())}")
    return tuple({each.label: each for each in found}.values())


@cache
def _read_table(name: str) -> tuple[str, _Table]:
    file = package_files("twinform.profiles").joinpath("data", f"{name}.toml")
    try:
        return name, _Table.model_validate(tomllib.loads(file.read_text(encoding="utf-8")))
    except (ValidationError, tomllib.TOMLDecodeError, re.error) as error:
        raise ProfileError(f"{name}.toml: {error}") from error


def _select_release(name: str, table: _Table, release: str, *, named: bool = True) -> Profile:
    known = list(table.releases)
    if release and release not in known:
        advice = did_you_mean(release, known) or f"there are {', '.join(known)}" if known else "it has no releases"
        raise UnknownProfileError(f"{name!r} has no release {release!r}; {advice}")
    chosen = release or table.release
    rows = tuple(row for row in table.row if _is_in_release(row, chosen, known))
    sdf = table.releases.get(chosen, table.sdf)
    about = (table.title, table.about, table.formats, table.seen, table.tested)
    return Profile(name, *about, chosen, rows, table.reads, sdf, named)


def _is_in_release(row: ProfileRow, release: str, known: list[str]) -> bool:
    def place(word: str) -> int:
        if word not in known:
            raise ProfileError(f"row {row.rule!r}: there is no release {word!r}")
        return known.index(word)

    after = not row.since or place(row.since) <= place(release)
    return after and (not row.until or place(release) <= place(row.until))


def explanations() -> dict[str, Any]:
    """Each profile by name, with what it is about, for help texts."""
    return {name: _read_table(name)[1].about for name in names() if name != PORTABLE}
