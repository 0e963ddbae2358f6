"""Gazebo Classic plugins replaced by systems of gz-sim, with the parameters that their version for ROS 1 or 2 reads.

Their ROS topics are namespaces, names and remappings, which are resolved into one name.
"""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import field

from twinform.dataclass import dataclass
from twinform.ir import Element, Plugin
from twinform.lazy import lazy_pattern
from twinform.passes.classic.moving import DroppedParameter, Moved, add_child, truth_of
from twinform.passes.classic.tables import Migration, SystemRow
from twinform.passes.plugins.catalog import ros2_kind, system
from twinform.passes.plugins.catalog_types import PluginKind
from twinform.passes.plugins.sites import PluginSite

_NAMESPACES = ("robotNamespace", "robot_namespace")
_REMAPPINGS = frozenset({"remapping", "argument"})
_SEPARATOR = lazy_pattern(r"/(?![^{}]{0,100}+\})")
"""A slash outside of braces; a choice in braces has fewer than 100 characters."""


@dataclass(slots=True)
class RosNames:
    """The names of the topics of a plugin.

    `used` and `remapped` collect the parameters and remappings that the names depend on.
    """

    plugin: Plugin
    sensor: str | None = None
    camera: str | None = None
    used: set[str] = field(default_factory=set[str])
    remapped: set[str] = field(default_factory=set[str])

    def topic(self, pattern: str) -> str:
        """The name that a pattern stands for, without its first slash."""
        pieces = [self._fill_piece(piece) for piece in _SEPARATOR.split(pattern)]
        # As in ROS, an absolute name discards everything before it, the namespace included.
        last = next((at for at in reversed(range(len(pieces))) if pieces[at].startswith("/")), None)
        name = "/".join(pieces) if last is None else "/".join(pieces[last:])
        # The name that the topic had in ROS becomes the topic of gz-transport, so the bridge joins
        # equal names and the programs of ROS need no change.
        return self._apply_remapping(name if last is not None else f"{self.namespace}/{name}")

    @property
    def namespace(self) -> str:
        """The namespace of the node."""
        for child in self.plugin.content:
            if child.name in _NAMESPACES:
                self.used.add(child.name)
                return child.text or ""
        given = self._node_setting("__ns")
        if given is not None:
            return given
        inside = (ros.find("namespace") for ros in self._ros())
        return next((each.text or "" for each in inside if each is not None), "")

    @property
    def node(self) -> str:
        """The name of the node."""
        return self._node_setting("__node") or self._node_setting("__name") or self.plugin.name or ""

    def _node_setting(self, name: str) -> str | None:
        """The value of a remapping of the node itself."""
        found = next((new for old, new in self._remappings() if old == name), None)
        if found is not None:
            self.remapped.add(name)
        return found

    def _ros(self) -> Iterator[Element]:
        return (child for child in self.plugin.content if child.name == "ros")

    def _fill_piece(self, piece: str) -> str:
        for word in piece.strip("{}").split("|"):
            if word.startswith("="):
                return word[1:].replace("$plugin", self.node)
            if word.startswith("$"):
                value = {"$sensor": self.sensor, "$camera": self.camera}.get(word, self.node)
            else:
                value = self._use_parameter(word)
            if value:
                return value
        return ""

    def _use_parameter(self, name: str) -> str | None:
        found = next((child for child in self.plugin.content if child.name == name), None)
        if found is None:
            return None
        self.used.add(name)
        return found.text

    def _apply_remapping(self, name: str) -> str:
        """A name after the first rule that applies to it; rules are about whole names (rcl, remap.c)."""
        # So `image_raw:=x`, which older documentation teaches for cameras, renames nothing in Foxy
        # and later: the topic is CAMERA/image_raw. It is reported as a leftover.
        for old, new in self._remappings():
            if _clean_name(name) == self._expand(old):
                self.remapped.add(old)
                return self._expand(new)
        return _clean_name(name)

    def _expand(self, name: str) -> str:
        """A name in a rule, with the namespace and the name of the node that it is relative to."""
        name = name.removeprefix("rostopic://")
        node, colon, rest = name.partition(":")
        # A rule `node:old:=new` is for the node of that name only.
        if colon:
            return self._expand(rest) if node == self.node else ""
        if name.startswith("/"):
            return _clean_name(name)
        return _clean_name("/".join((self.namespace, self.node if name.startswith("~") else "", name)))

    def _remappings(self) -> Iterator[tuple[str, str]]:
        """Old and new names of all remappings, in order; older versions have them in `<argument>`."""
        for ros in self._ros():
            for child in ros.children:
                old, arrow, new = (child.text or "").partition(":=")
                if child.name in _REMAPPINGS and arrow:
                    yield old.strip(), new.strip()

    def leftovers(self) -> Iterator[tuple[Element, str]]:
        """The parts of `<ros>` that no topic depends on, with the reason why they have no counterpart."""
        for ros in self._ros():
            for child in ros.children:
                old = (child.text or "").partition(":=")[0].strip()
                if child.name == "namespace" or (child.name in _REMAPPINGS and old in self.remapped):
                    continue
                yield child, "topics of gz-sim have one name, and other settings of nodes of ROS mean nothing to it"


def is_namespace(name: str) -> bool:
    """Whether a parameter is the namespace of the node."""
    return name in _NAMESPACES


def _clean_name(name: str) -> str:
    return "/".join(piece for piece in name.split("/") if piece and piece != "~")


_ON, _OFF = "{=/tf}", "=odom_transform"
"""The topics for transforms that are on and off in ROS: the bridge takes only the first for `/tf`."""
_UNHEARD = "=odom_unheard"
"""The topic for odometry that is off in ROS."""
_UNREAD = "the plugin of Gazebo Classic does not read it either"
_UNREAD_BY_ROS2 = "the plugin for ROS 2 does not read it either"


def make_systems(
    plugin: Plugin, migration: Migration, site: PluginSite, release: str
) -> tuple[list[tuple[Plugin, SystemRow]], list[DroppedParameter]]:
    """The systems that replace a plugin, with their rows, and the parameters that have no counterpart.

    Raises:
        LookupError: the release does not have the system that the message names.
    """
    read = without_unread_parameters(plugin)
    names, lost, taken = RosNames(read), list[DroppedParameter](), set[str]()
    made: list[tuple[Plugin, SystemRow]] = []
    for row in migration.systems:
        kind = _system_for(row, release)
        moved = Moved(Element(name="plugin"), repeats=_repeats(kind))
        moved.apply(read.content, {**migration.shared, **row.moves})
        for each in _defaults(row, site, moved.element):
            moved.element = add_child(moved.element, each)
        content = [*moved.element.children]
        content += [Element(name=path, text=names.topic(pattern)) for path, pattern in row.topics.items()]
        content = [_rename_if_off(each, row, read, names) for each in content]
        content += _transform_topic(row, read, names)
        # The tables hold places for the newest release; an older one may not read a parameter,
        # which is then reported instead of written in vain.
        kept, unread = _split_by_release(kind, content, release)
        lost += [each for each in moved.lost if each.parameter.name not in taken]
        lost += [
            DroppedParameter(parameter, f"{kind.class_name} of {release} does not read <{name}>")
            for parameter, name in _sources_of(read, row, unread)
        ]
        taken |= moved.moved
        made.append((_system_plugin(plugin, kind, kept, alone=len(migration.systems) == 1), row))
    lost += unused_parameters(plugin, taken, names)
    return made, _without_repeats(lost)


def unused_parameters(plugin: Plugin, taken: set[str], names: RosNames) -> Iterator[DroppedParameter]:
    """The parameters that no row of the table has used."""
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


def _system_for(row: SystemRow, release: str) -> PluginKind:
    for name in (row.system, row.before):
        if name is not None and release in (kind := system(name)).releases:
            return kind
    raise LookupError(f"gz-sim of {release} has no {system(row.system).class_name}")


def _defaults(row: SystemRow, site: PluginSite, element: Element) -> Iterator[Element]:
    """The values that a row writes where no parameter has set them."""
    for name, value in row.sets.items():
        if element.find(name) is None:
            yield Element(name=name, text=site.model.name if value == "$model" and site.model else value)


def _transform_topic(row: SystemRow, plugin: Plugin, names: RosNames) -> Iterator[Element]:
    """The topic for the transforms of odometry; no system has an option to publish none."""
    if row.transforms is None:
        return
    # Transforms that were off in Gazebo Classic go to a topic that the bridge does not take for
    # /tf; otherwise the tree of ROS would get a second parent for the base.
    yield Element(name="tf_topic", text="/" + names.topic(_ON if _is_on(row.transforms, plugin, names) else _OFF))


def _rename_if_off(element: Element, row: SystemRow, plugin: Plugin, names: RosNames) -> Element:
    """Give odometry that was off another topic; no system has an option to publish none."""
    # Another program, such as a filter, may publish on the topic that the plugin left alone.
    is_off = element.name == "odom_topic" and row.odometry is not None and not _is_on(row.odometry, plugin, names)
    return element.copy(text=names.topic(_UNHEARD)) if is_off else element


def _is_on(switches: Mapping[str, bool], plugin: Plugin, names: RosNames) -> bool:
    """Whether all switches are on; each has the value that it has where it is not written."""
    on = dict(switches)
    for parameter in plugin.content:
        truth = truth_of(parameter.text or "")
        if parameter.name in on and truth is not None:
            on[parameter.name] = truth
            names.used.add(parameter.name)
    return all(on.values())


def _split_by_release(kind: PluginKind, content: list[Element], release: str) -> tuple[list[Element], set[str]]:
    """The parameters that the system reads in this release, and the names of the others."""
    read = {row.name for row in kind.parameters if release in row.releases}
    kept = [each for each in content if each.name in read]
    return kept, {each.name for each in content if each.name not in read}


def _sources_of(plugin: Plugin, row: SystemRow, unread: set[str]) -> Iterator[tuple[Element, str]]:
    """The parameters whose values went to elements that the system does not read."""
    for parameter in plugin.content:
        move = row.moves.get(parameter.name)
        if move is not None and move.to is not None and move.to.partition("/")[0] in unread:
            yield parameter, move.to


def _system_plugin(plugin: Plugin, kind: PluginKind, content: list[Element], *, alone: bool) -> Plugin:
    # A location belongs to one node. Where one plugin became several systems, none of them is the
    # plugin.
    source = plugin.source if alone else None
    return Plugin(name=kind.class_name, filename=kind.file, content=tuple(content), source=source)


def _without_repeats(lost: list[DroppedParameter]) -> list[DroppedParameter]:
    seen: dict[int, DroppedParameter] = {}
    for each in lost:
        seen.setdefault(id(each.parameter), each)
    return list(seen.values())


def without_unread_parameters(plugin: Plugin) -> Plugin:
    """The plugin; if it is for ROS 2, without the parameters that only its version for ROS 1 reads."""
    kind = ros2_kind(plugin)
    if kind is None or kind.free:
        return plugin
    # What the plugin of ROS 2 does not read had no effect, so it must have none after the migration
    # either.
    content = tuple(child for child in plugin.content if kind.parameter(child.name) is not None)
    return plugin if len(content) == len(plugin.content) else plugin.copy(content=content)
