"""ROS topics of plugins: namespaces, names and remappings resolved into one name.

A pattern has pieces between slashes; each is a name behind `=`, or in braces a choice between parameters, `$plugin`,
`$sensor` and `$camera`, and such a name: `{cameraName|$sensor}/{imageTopicName|=image_raw}`. In a name, `$plugin` is
that of the plugin. A piece that begins with a slash is absolute, as in ROS.
"""

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from twinform.ir import Element, Plugin

_NAMESPACES = ("robotNamespace", "robot_namespace")
_REMAPPINGS = frozenset({"remapping", "argument"})
_BETWEEN = re.compile(r"/(?![^{}]{0,100}+\})")
"""A choice has fewer characters than that."""


@dataclass(slots=True)
class RosNames:
    """How a plugin calls its topics. `used` and `remapped` fill up with the parameters and remappings that did it."""

    plugin: Plugin
    sensor: str | None = None
    camera: str | None = None
    used: set[str] = field(default_factory=set[str])
    remapped: set[str] = field(default_factory=set[str])

    def topic(self, pattern: str) -> str:
        """The name that a pattern stands for here, without the slash that it begins with."""
        pieces = [self._piece(piece) for piece in _BETWEEN.split(pattern)]
        name = "/".join(pieces)
        last = next((at for at in reversed(range(len(pieces))) if pieces[at].startswith("/")), None)
        absolute = "/".join(pieces[last:]) if last is not None else None
        renamed = self._renamed(name)
        if renamed is not None:
            absolute, name = (renamed, renamed) if renamed.startswith("/") else (None, renamed)
        if absolute is not None:
            return _clean(absolute)
        return _clean(f"{self.namespace}/{name}")

    @property
    def namespace(self) -> str:
        """The namespace of its node."""
        for child in self.plugin.content:
            if child.name in _NAMESPACES:
                self.used.add(child.name)
                return child.text or ""
        for ros in self._ros():
            inside = ros.find("namespace")
            if inside is not None:
                return inside.text or ""
        return ""

    def _ros(self) -> Iterator[Element]:
        return (child for child in self.plugin.content if child.name == "ros")

    def _piece(self, piece: str) -> str:
        for word in piece.strip("{}").split("|"):
            if word.startswith("="):
                return word[1:].replace("$plugin", self.plugin.name or "")
            if word.startswith("$"):
                value = {"$sensor": self.sensor, "$camera": self.camera}.get(word, self.plugin.name)
            else:
                value = self._parameter(word)
            if value:
                return value
        return ""

    def _parameter(self, name: str) -> str | None:
        found = next((child for child in self.plugin.content if child.name == name), None)
        if found is None:
            return None
        self.used.add(name)
        return found.text

    def _renamed(self, name: str) -> str | None:
        for old, new in self.remappings.items():
            bare = old.removeprefix("~").strip("/")
            if bare and (name.strip("/") == bare or name.endswith(f"/{bare}")):
                self.remapped.add(old)
                return f"{self.plugin.name}/{new[2:]}" if new.startswith("~/") else new
        return None

    @property
    def remappings(self) -> Mapping[str, str]:
        """What is to be called otherwise; older versions have remappings in `<argument>`."""
        found: dict[str, str] = {}
        for ros in self._ros():
            for child in ros.children:
                old, arrow, new = (child.text or "").partition(":=")
                if child.name in _REMAPPINGS and arrow and not old.startswith("__"):
                    found[old.strip()] = new.strip()
        return found

    def leftovers(self) -> Iterator[tuple[Element, str]]:
        """The parts of `<ros>` that no topic has used, with the reason why they go nowhere."""
        for ros in self._ros():
            for child in ros.children:
                old = (child.text or "").partition(":=")[0].strip()
                if child.name == "namespace" or (child.name in _REMAPPINGS and old in self.remapped):
                    continue
                yield child, "topics of gz-sim have one name, and other settings of nodes of ROS mean nothing to it"


def is_namespace(name: str) -> bool:
    """Whether a parameter is the namespace of the node."""
    return name in _NAMESPACES


def _clean(name: str) -> str:
    return "/".join(piece for piece in name.split("/") if piece and piece != "~")
