"""Gazebo Classic plugins replaced by systems of gz-sim."""

from collections.abc import Callable, Iterator

from twinform.ir import Element, Plugin
from twinform.passes.classic.classic_parameters import as_read
from twinform.passes.classic.element_edits import added
from twinform.passes.classic.moving import DroppedParameter, Moved, truth_of
from twinform.passes.classic.tables import Migration, SystemRow
from twinform.passes.classic.topics import RosNames, is_namespace
from twinform.passes.plugins.catalog import system
from twinform.passes.plugins.catalog_types import PluginKind
from twinform.passes.plugins.sites import PluginSite

_ON, _OFF = "{=/tf}", "=odom_transform"
"""The topics of transforms that ROS is to have, and of those that it is not: the bridge takes the first for `/tf`."""
_UNREAD = "the plugin of Gazebo Classic does not read it either"
_UNREAD_BY_ROS2 = "the plugin for ROS 2 does not read it either"


def made_systems(
    plugin: Plugin, migration: Migration, site: PluginSite, release: str
) -> tuple[list[tuple[Plugin, SystemRow]], list[DroppedParameter]]:
    """The systems that take a plugin's place, with their rows, and the parameters that went nowhere.

    Raises:
        LookupError: the release has no such system; the error names it.
    """
    read = as_read(plugin)
    names, lost, taken = RosNames(read), list[DroppedParameter](), set[str]()
    made: list[tuple[Plugin, SystemRow]] = []
    for row in migration.systems:
        kind = _kind(row, release)
        moved = Moved(Element(name="plugin"), repeats=_repeats(kind))
        moved.apply(read.content, {**migration.shared, **row.moves})
        for each in _sets(row, site, moved.element):
            moved.element = added(moved.element, each)
        content = [*moved.element.children]
        content += [Element(name=path, text=names.topic(pattern)) for path, pattern in row.topics.items()]
        content += _transforms(row, read, names)
        # The tables hold places for the newest release; an older one may not read a parameter,
        # which is then reported instead of written in vain.
        kept, unread = _read_by(kind, content, release)
        lost += [each for each in moved.lost if each.parameter.name not in taken]
        lost += [
            DroppedParameter(parameter, f"{kind.class_name} of {release} does not read <{name}>")
            for parameter, name in _origins(read, row, unread)
        ]
        taken |= moved.moved
        made.append((_plugin(plugin, kind, kept, alone=len(migration.systems) == 1), row))
    lost += unused(plugin, taken, names)
    return made, _once(lost)


def unused(plugin: Plugin, taken: set[str], names: RosNames) -> Iterator[DroppedParameter]:
    """The parameters that nothing has taken."""
    read = {id(parameter) for parameter in names.plugin.content}
    for parameter in plugin.content:
        if id(parameter) not in read:
            yield DroppedParameter(parameter, _UNREAD_BY_ROS2)
        elif parameter.name == "ros" and "ros" not in taken:
            yield from (DroppedParameter(part, reason) for part, reason in names.leftovers())
        elif parameter.name not in taken | names.used and not is_namespace(parameter.name):
            yield DroppedParameter(parameter, _UNREAD)
        elif is_namespace(parameter.name) and parameter.name not in taken | names.used:
            yield DroppedParameter(parameter, "nothing is published below a namespace", harmless=True)


def _repeats(kind: PluginKind) -> Callable[[str], bool]:
    def repeats(path: str) -> bool:
        row = kind.parameter(*path.split("/"))
        return row is not None and row.is_many

    return repeats


def _kind(row: SystemRow, release: str) -> PluginKind:
    for name in (row.system, row.before):
        if name is not None and release in (kind := system(name)).releases:
            return kind
    raise LookupError(f"gz-sim of {release} has no {system(row.system).class_name}")


def _sets(row: SystemRow, site: PluginSite, element: Element) -> Iterator[Element]:
    """What is written where no parameter sets it."""
    for name, value in row.sets.items():
        if element.find(name) is None:
            yield Element(name=name, text=site.model.name if value == "$model" and site.model else value)


def _transforms(row: SystemRow, plugin: Plugin, names: RosNames) -> Iterator[Element]:
    """Where the transforms of the odometry go; no system has an option to publish none."""
    if row.transforms is None:
        return
    on = dict(row.transforms)
    for parameter in plugin.content:
        truth = truth_of(parameter.text or "")
        if parameter.name in on and truth is not None:
            on[parameter.name] = truth
            names.used.add(parameter.name)
    # Transforms that were off in Gazebo Classic go to a topic that the bridge does not take for
    # /tf; otherwise the tree of ROS would get a second parent for the base.
    yield Element(name="tf_topic", text="/" + names.topic(_ON if all(on.values()) else _OFF))


def _read_by(kind: PluginKind, content: list[Element], release: str) -> tuple[list[Element], set[str]]:
    """The parameters that the system reads in this release, and the names of the others."""
    read = {row.name for row in kind.parameters if release in row.releases}
    kept = [each for each in content if each.name in read]
    return kept, {each.name for each in content if each.name not in read}


def _origins(plugin: Plugin, row: SystemRow, unread: set[str]) -> Iterator[tuple[Element, str]]:
    """The parameters from which values came that the system does not read."""
    for parameter in plugin.content:
        move = row.moves.get(parameter.name)
        if move is not None and move.to is not None and move.to.partition("/")[0] in unread:
            yield parameter, move.to


def _plugin(plugin: Plugin, kind: PluginKind, content: list[Element], *, alone: bool) -> Plugin:
    # A location belongs to one node. Where one plugin became several systems, none of them is the
    # plugin.
    source = plugin.source if alone else None
    return Plugin(name=kind.class_name, filename=kind.file, content=tuple(content), source=source)


def _once(lost: list[DroppedParameter]) -> list[DroppedParameter]:
    seen: dict[int, DroppedParameter] = {}
    for each in lost:
        seen.setdefault(id(each.parameter), each)
    return list(seen.values())
