"""ROS topics of plugins: namespaces, names and remappings resolved into one name.

A pattern has pieces separated by slashes. A piece is a name after `=`, or in braces a choice between parameters,
`$plugin`, `$sensor`, `$camera`, and such a name: `{cameraName|$sensor}/{imageTopicName|=image_raw}`. In a name,
`$plugin` is the name of the node, which is that of the plugin. A piece that begins with a slash is absolute, as in ROS.
"""

from collections.abc import Iterator
from dataclasses import field

from twinform.dataclass import dataclass
from twinform.ir import Element, Plugin
from twinform.lazy import lazy_pattern

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
