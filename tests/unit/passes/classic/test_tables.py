"""The tables of plugins against the catalog: what plugins read has a place, and every place is one that is read."""

import pytest

from twinform.ir import Element
from twinform.passes.classic.tables import Migration, Move, migration_of, migrations
from twinform.passes.plugins.catalog import classic_plugins, modern_file, releases, sensors, system
from twinform.passes.plugins.catalog_types import PluginKind

OF_ROS = {"ros", "robotNamespace", "robot_namespace"}
CLASSIC = {f"{family} {kind.file}": kind for family in ("noetic", "ros2") for kind in classic_plugins(family).values()}
SYSTEMS = {name: migration for name, migration in migrations().items() if migration.systems}


@pytest.mark.parametrize("plugin", CLASSIC)
def test_every_parameter_that_a_plugin_of_gazebo_ros_reads_has_a_place_or_a_reason(plugin: str) -> None:
    kind = CLASSIC[plugin]
    migration = _migration(kind)
    assert migration, "the table has nothing about it"
    read = {parameter.name for parameter in kind.parameters} - OF_ROS
    assert migration.none or not read - migration.parameters


def _migration(kind: PluginKind) -> Migration | None:
    return migration_of(kind.file, tuple(Element(name=parameter.name) for parameter in kind.parameters))


@pytest.mark.parametrize("name", SYSTEMS)
def test_every_parameter_goes_where_its_system_reads_it(name: str) -> None:
    migration = SYSTEMS[name]
    for row in migration.systems:
        kind = system(row.system)
        written = {path for move in {**migration.shared, **row.moves}.values() for path in _paths(move)}
        unread = {path for path in written | {*row.topics, *row.sets} if not kind.parameter(*path.split("/"))}
        assert unread <= _of_another(migration, row.system)


def _of_another(migration: Migration, name: str) -> set[str]:
    """What a table shared by several plugins writes for the others: each system takes what it reads."""
    shared = {path for move in migration.shared.values() for path in _paths(move)}
    del name
    return shared


def _paths(move: Move) -> set[str]:
    chosen = {path for texts in (move.choose or {}).values() for path in texts}
    listed = {*move.each, *move.same, *move.also, *filter(None, (move.to, move.mirror))} | chosen
    return {path for path in listed if not path.startswith("@")}


def test_every_system_is_in_some_release_and_every_type_of_sensor_is_known() -> None:
    for migration in migrations().values():
        for row in migration.systems:
            assert system(row.system).releases & set(releases())
        types = set(migration.sensor.types.values()) if migration.sensor else set[str]()
        assert types <= set(sensors())
        assert migration.make is None or migration.make.type in sensors()


def test_every_table_reports_what_becomes_of_its_plugin() -> None:
    for name, migration in migrations().items():
        ends = [migration.systems, migration.sensor is not None, migration.mimic, migration.none]
        assert any(ends), name
        assert migration.files, name
        assert all(modern_file(file) == file for file in migration.files), name
