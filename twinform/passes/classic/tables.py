"""Migration tables: what each Gazebo Classic plugin becomes, and where its parameters go.

A table in `data/` is named after the plugin and has

* `files`: the files that it is in, without `lib` and `.so`; `reads`: parameters that tell it from another plugin in a
  file of the same name; `native`: releases of Gazebo that have it themselves;
* `systems`: the systems of gz-sim that take its place, or `sensor`: what becomes of the sensor that it stands in, with
  `make` where the sensor has to be made; or `mimic`; or `none`, the reason why nothing does; or `nothing`, the reason
  why nothing has to;
* `uses`: tables of `shared.toml` with more parameters; `geometry`: what the author has to write beside;
  `caveats`: what is otherwise afterwards; `body`: parameters with the link whose pose it reports.

A parameter goes to a path, or somewhere else in the syntax of `Move`. Topics are patterns, which `topics.py` reads.
"""

import re
import tomllib
from collections.abc import Iterator, Mapping
from functools import cache
from importlib import resources
from typing import Any

from pydantic import BaseModel, ConfigDict, Field

from twinform.ir import Element
from twinform.passes.plugins.catalog import modern_file

_FILES = ("driving.toml", "sensing.toml", "states.toml", "control.toml")


class _TableRow(BaseModel):
    model_config = ConfigDict(
        frozen=True, extra="forbid", alias_generator=lambda name: name.replace("_", "-"), populate_by_name=True
    )


class Move(_TableRow):
    """Where a parameter goes.

    `to` is a path of elements, and `@name` at its end an attribute; `@frame`, `@xyz` and `@rpy` are the frame of a
    sensor and its pose. Numbers are multiplied by `scale`, or by minus the focal length of the camera
    (`negative_times`). `each` takes the numbers of a vector apart; `same` are more places
    for the value, `mirror` one for the value with the other sign, `also` what is written beside it. `noise` makes the
    noise around it Gaussian and `drifts` lets its bias wander. `split` divides a list, `first` takes one of several,
    `least` the smaller of the old value and the new; `bare` is a topic without the slashes around it. `choose` gives
    what to write for each value.

    Without any of that, `drop` is the reason why it goes nowhere; it is only reported where its value is not one of
    the `harmless` values.
    """

    to: str | None = None
    drop: str | None = None
    each: tuple[str, ...] = ()
    same: tuple[str, ...] = ()
    mirror: str | None = None
    also: Mapping[str, str] = Field(default_factory=dict[str, str])
    choose: Mapping[str, Mapping[str, str]] | None = None
    scale: float | None = None
    negative_times: str | None = None
    split: str | None = None
    first: bool = False
    least: bool = False
    bare: bool = False
    noise: bool = False
    drifts: bool = False
    harmless: tuple[str, ...] = ()


Moves = Mapping[str, Move]


class Caveat(_TableRow):
    """What is otherwise afterwards, and the author has to know.

    The `text` is reported, unless one of the parameters in `unless` is written: then the table has a place or a reason
    for it. With `where` it is only where one of these parameters is true, with `type` only of such sensors.
    """

    text: str
    unless: tuple[str, ...] = ()
    where: tuple[str, ...] = ()
    type: str | None = None


class SystemRow(_TableRow):
    """A system that takes a plugin's place; `before` is the one that did so in releases that lack it.

    `sets` is what is written where no parameter sets it: mostly what went without saying in the plugin and does not in
    the system. `$model` is the name of the model. What is `measured` are the sizes that the plugin took from the model.
    `transforms` are the parameters that switch the transforms of the odometry on, each with what it is where it is not
    written; they go to `/tf` where all are true, and elsewhere otherwise. `odometry` are those that switch the odometry
    itself on. Without either there is nothing to switch.
    """

    system: str
    before: str | None = None
    scope: str | None = None
    measured: bool = False
    sets: Mapping[str, str] = Field(default_factory=dict[str, str])
    odometry: Mapping[str, bool] | None = None
    transforms: Mapping[str, bool] | None = None
    moves: Moves = Field(default_factory=dict[str, Move])
    topics: Mapping[str, str] = Field(default_factory=dict[str, str])


class ClassicSensorRow(_TableRow):
    """What becomes of the sensor that a plugin stands in.

    `topics_of` are the topics of one type alone, and `topics_where` further ones where an element of the sensor is
    true.

    `sets` are paths and what is written there where no parameter has chosen it: what the plugin took for granted.
    """

    types: Mapping[str, str] = Field(default_factory=dict[str, str])
    sets: Mapping[str, str] = Field(default_factory=dict[str, str])
    moves: Moves = Field(default_factory=dict[str, Move])
    topics: Mapping[str, str] = Field(default_factory=dict[str, str])
    topics_of: Mapping[str, Mapping[str, str]] = Field(default_factory=dict[str, Mapping[str, str]])
    topics_where: Mapping[str, Mapping[str, str]] = Field(default_factory=dict[str, Mapping[str, str]])


class MakeRow(_TableRow):
    """A sensor that has to be made: its type, what it stands on, and the parameters that name it."""

    type: str
    on: str
    of: tuple[str, ...]


class Migration(_TableRow):
    """What becomes of one plugin of Gazebo Classic."""

    files: tuple[str, ...] = ()
    native: tuple[str, ...] = ()
    reads: tuple[str, ...] = ()
    uses: tuple[str, ...] = ()
    geometry: str | None = None
    caveats: tuple[Caveat, ...] = ()
    body: tuple[str, ...] = ()
    systems: tuple[SystemRow, ...] = ()
    sensor: ClassicSensorRow | None = None
    make: MakeRow | None = None
    mimic: bool = False
    control: bool = False
    moves: Moves = Field(default_factory=dict[str, Move])
    none: str | None = None
    nothing: str | None = None

    @property
    def shared(self) -> Moves:
        """The moves that the plugin shares with others."""
        return {name: move for table in self.uses for name, move in shared_moves(table).items()}

    @property
    def parameters(self) -> frozenset[str]:
        """The names of all parameters in the table."""
        tables = [self.shared, self.moves, *(row.moves for row in self.systems)]
        patterns = [pattern for row in self.systems for pattern in row.topics.values()]
        if self.sensor:
            tables.append(self.sensor.moves)
            more = (*self.sensor.topics_of.values(), *self.sensor.topics_where.values())
            patterns += [pattern for topics in (self.sensor.topics, *more) for pattern in topics.values()]
        named = {name for pattern in patterns for name in parameters_in(pattern)}
        switches = {name for row in self.systems for name in {**(row.odometry or {}), **(row.transforms or {})}}
        makers = set(self.make.of if self.make else ())
        return frozenset({name for table in tables for name in table} | named | switches | makers)


def migration_of(filename: str, content: tuple[Element, ...] = ()) -> Migration | None:
    """The migration of a plugin, by its file and parameters; None if it is not of Gazebo Classic."""
    key = modern_file(filename)
    written = {element.name for element in content}
    for migration in _migrations_by_file().get(key, ()):
        if not migration.reads or written.intersection(migration.reads):
            return migration
    return None


def migrations() -> Mapping[str, Migration]:
    """All migrations by the names of their tables."""
    return _read_migrations()


def hardware_names() -> Mapping[str, str]:
    """The hardware plugins of ros2_control for Gazebo, current names by old ones."""
    return _read_toml("control.toml")["hardware"]


@cache
def unread_parts() -> Mapping[str, Mapping[str, str]]:
    """The parts of worlds and sensors that gz-sim does not read, with reasons, and models that moved to Fuel."""
    return _read_toml("worlds.toml")


@cache
def shared_moves(table: str) -> Moves:
    """A table of parameters that several plugins have."""
    return {name: _read_move(row) for name, row in _read_toml("shared.toml")[table].items()}


def parameters_in(pattern: str) -> Iterator[str]:
    """The parameters in a pattern of a topic."""
    for choice in re.findall(r"\{([^{}]*+)\}", pattern):
        yield from (word for word in choice.split("|") if word[0] not in "=$")


@cache
def _migrations_by_file() -> Mapping[str, tuple[Migration, ...]]:
    found: dict[str, tuple[Migration, ...]] = {}
    for migration in _read_migrations().values():
        for file in migration.files:
            found[file] = (*found.get(file, ()), migration)
    return found


@cache
def _read_migrations() -> Mapping[str, Migration]:
    found: dict[str, Migration] = {}
    for file in _FILES:
        tables = {name: row for name, row in _read_toml(file).items() if name != "hardware"}
        found |= {name: Migration.model_validate(_expand_moves(row)) for name, row in tables.items()}
    for file, reason in _read_toml("without.toml").items():
        found[file] = Migration(files=(file,), none=reason)
    return found


def _expand_moves(row: Any) -> Any:
    """The row with every move as a table; a text is only the path."""
    if isinstance(row, list):
        return [_expand_moves(each) for each in row]  # pyright: ignore[reportUnknownVariableType] - TOML has any type
    if not isinstance(row, dict):
        return row
    made: dict[str, Any] = {str(name): _expand_moves(value) for name, value in row.items()}  # pyright: ignore[reportUnknownArgumentType, reportUnknownVariableType] - TOML has any type
    if isinstance(made.get("moves"), dict):
        made["moves"] = {name: _read_move(value) for name, value in made["moves"].items()}
    return made


def _read_move(row: Any) -> Move:
    return Move(to=row) if isinstance(row, str) else Move.model_validate(row)


@cache
def _read_toml(name: str) -> dict[str, Any]:
    text = resources.files("twinform.passes.classic").joinpath("data", name).read_text(encoding="utf-8")
    return tomllib.loads(text)
