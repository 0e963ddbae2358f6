"""What the sources of gz-sim have about their systems: parameters with types and defaults, topics and messages."""

import re
from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

from reports.who_reads_it.cpp_source import Scope, arguments, source_text

_REGISTERED = re.compile(r"(?:GZ|IGNITION)_ADD_PLUGIN\s*\(\s*([\w:]+)")
_ALIAS = re.compile(
    r'(?:GZ|IGNITION)_ADD_PLUGIN_ALIAS\s*\([^;]*?"(?:gz::sim|ignition::gazebo)::systems::(\w+)"', re.DOTALL
)
_TYPE = r"(?:<\s*([\w:]+(?:\s+int)?)\s*>)?"
_METHOD = re.compile(
    rf"(?:->|\.)\s*(Get|HasElement|FindElement|GetElement|GetElementImpl|GetNextElement|HasAttribute|GetAttribute)\s*{_TYPE}"
    r'\s*(\()\s*("\w+"|[A-Za-z_]\w*)\s*[,)]'
)
_COMPARED = re.compile(r'GetName\s*\(\s*\)\s*==\s*"(\w+)"')
_HELPER = re.compile(rf'\b([A-Za-z_]\w*)\s*{_TYPE}\s*(\()\s*\*?\w*(?:[sS]df|[eE]lem)\w*\s*,\s*("\w+")\s*[,)]')
_OWN_VALUE = re.compile(r"^\s*->\s*Get\s*<\s*([\w:]+(?:\s+int)?)\s*>\s*\(\s*\)")
_TARGET = re.compile(r'^\s*(?P<declared>[\w:<>&\s]*?[\w>&]\s+)?(?P<target>[\w.>()-]*?\w+)\s*=(?!=)[^="+]*$')
_LITERAL = re.compile(r'"((?:\\.|[^"\\\n])*)"')
_TOPIC = re.compile(r"^/?[A-Za-z_]\w*(?:/\w+)*/?$")
_SENT = re.compile(r"Advertise\s*<\s*(?:[\w]+::)*msgs::(\w+)\s*>")
_HEARD = re.compile(r"Subscriber?\s*\((?:[^;]*?)&\s*(?:\w+::)*(\w+)\s*[,)]", re.DOTALL)
_KINDS = {
    "number": ("double", "float", "Angle"),
    "integer": ("int", "unsigned int", "uint32_t", "uint64_t", "int64_t", "size_t"),
    "bool": ("bool",),
    "text": ("string",),
    "vector": ("Vector3d",),
    "numbers": ("Vector2d", "Quaterniond"),
    "pose": ("Pose3d",),
    "color": ("Color",),
}


@dataclass(slots=True)
class Read:
    """What is known of one parameter: the kinds of values it is read as, its defaults, and where it is asked for.

    `places` are `element` and `attribute`; there is none where only its value is got, since that reads both.
    """

    kinds: set[str] = field(default_factory=set[str])
    defaults: set[str] = field(default_factory=set[str])
    places: set[str] = field(default_factory=set[str])


class _Reading(NamedTuple):
    """One place where a parameter is read."""

    name: str
    kind: str | None = None
    default: str | None = None
    place: str | None = None


@dataclass(frozen=True, slots=True)
class SystemSource:
    """What the source of one system reads and names."""

    parameters: dict[str, Read]
    topics: frozenset[str]
    messages: frozenset[str]


def systems_in(checkout: Path) -> dict[str, SystemSource]:
    """The systems of a checkout of gz-sim by the last part of the class that files name."""
    found: dict[str, SystemSource] = {}
    for folder in sorted(each for each in (checkout / "src" / "systems").iterdir() if each.is_dir()):
        texts = {each: source_text(each) for each in sorted(folder.rglob("*.[ch][ch]")) if "_TEST" not in each.name}
        owners = {path: _ALIAS.search(text) or _REGISTERED.search(text) for path, text in texts.items()}
        names = {path.stem: match[1].rpartition("::")[2] for path, match in owners.items() if match}
        for stem, name in names.items():
            mine = [text for path, text in texts.items() if path.stem == stem or path.stem not in names]
            found[name] = read_system(*mine)
    return found


def read_system(*texts: str) -> SystemSource:
    """What the files of one system read."""
    parameters: defaultdict[str, Read] = defaultdict(Read)
    for index, text in enumerate(texts):
        others = (*texts[:index], *texts[index + 1 :])
        for name, kind, default, place in _readings(text, others):
            read = parameters[name]
            read.kinds |= {kind} if kind else set()
            read.defaults |= {default} if default is not None else set()
            read.places |= {place} if place else set()
    whole = "\n".join(texts)
    return SystemSource(dict(parameters), frozenset(_topics(whole)), frozenset(_messages(whole)))


def _readings(text: str, others: tuple[str, ...]) -> Iterator[_Reading]:
    yield from (_Reading(found[1], place="element") for found in _COMPARED.finditer(text))
    for pattern in (_METHOD, _HELPER):
        for found in pattern.finditer(text):
            method, type_, _, expression = found.groups()
            name = Scope((text, *others), found.start()).value(expression) or ""
            if not name.isidentifier():
                continue
            given, end = arguments(text, found.start(3))
            own = _OWN_VALUE.match(text[end : end + 80])
            kind = _kind(type_ or (own[1] if own else ""))
            scope = Scope((text, *others), found.start())
            values = given[1:] if pattern is _METHOD else given[2:]
            place = "attribute" if "Attribute" in method else "element" if "Element" in method else None
            if method.startswith(("Has", "Find")):
                yield _Reading(name, place=place)
            elif values:
                yield _Reading(name, kind, scope.value(values[-1]), place)
            else:
                yield _Reading(name, kind, _from_target(text, found.start(), scope) if kind else None, place)


def _kind(type_: str) -> str | None:
    return next((kind for kind, types in _KINDS.items() if type_.rpartition("::")[2].strip() in types), None)


def _from_target(text: str, place: int, scope: Scope) -> str | None:
    """What the variable had before it was given the value that is read at a place."""
    begin = max(text.rfind(each, 0, place) for each in ";{}")
    before = text[begin + 1 : place]
    found = _TARGET.match(re.sub(r"^\s*(?:if|else)\b\s*(?:\([^=]*\))?", "", before))
    if found is None or found["declared"]:
        return None
    return scope.value(found["target"])


def _topics(text: str) -> Iterator[str]:
    """Parts of topics: what is between slashes in texts that have the form of one."""
    for found in _LITERAL.finditer(text):
        if "/" in found[1] and _TOPIC.match(found[1]) and not text[: found.start()].rstrip().endswith("#include"):
            yield from filter(None, found[1].split("/"))


def _messages(text: str) -> Iterator[str]:
    yield from (found[1] for found in _SENT.finditer(text))
    for found in _HEARD.finditer(text):
        heard = re.search(rf"\b{found[1]}\s*\(\s*const\s+(?:\w+::)*msgs::(\w+)\s*&", text)
        if heard:
            yield heard[1]
