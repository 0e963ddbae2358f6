"""Reads the values in an XML tree of SDF, with their types, units and defaults from the facts table.

Values in carriers count as if they were written in the file, because a conversion does not change the robot.
"""

from collections.abc import Callable, Iterator
from copy import deepcopy
from dataclasses import field

from lxml import etree

from twinform.compiler.compare.compared_robot import Leaf
from twinform.compiler.compare.compared_values import Flag, Numbers, PoseValue, Text, Value, typed_value
from twinform.dataclass import dataclass
from twinform.diagnostics import Source
from twinform.ir import Format, Pose
from twinform.ir.transform import Transform
from twinform.passes.carriers.carriers import KEPT, NAMESPACE, SECOND, from_xml
from twinform.passes.sdf_versions.name_the_nameless import plugin_stem
from twinform.passes.shared.gazebo_tags import SCRIPT_URI
from twinform.passes.shared.poses import read_pose
from twinform.schemas import Fact, XmlElement, in_usual_namespaces, is_followed, table
from twinform.text import same_element

CARRIED = f"{{{NAMESPACE}}}carried"
"""The attribute of elements that came out of a carrier."""
_OURS = f"{{{NAMESPACE}}}"
_MEANINGFUL_WHEN_EMPTY = frozenset({"geometry", "material", "mimic"})
"""Containers that mean something when they are empty; which shape is in a geometry is a value of it."""
_WITHOUT_MEANING = frozenset({"frame"})
"""References to definitions of elements that no reader of any version uses."""
_DERIVED_IN_MJCF = frozenset({"exclude"})
"""What a conversion writes of the links that may not touch; these are compared by `self_collide` and masks."""
_EACH_COUNTS = frozenset({("sensor", "camera")})
"""Elements (with their parents) whose repetitions some reader uses: Gazebo Classic uses every camera of a sensor."""
_TRUTHS = frozenset({"true", "false"})
_POSES = frozenset({"pose", "inertial_pose"})
THERE = Text("there")
"""The value of an element that means something by being there."""

Resolve = Callable[[Pose, Transform], Transform]
"""A function of a pose and its parent's frame that places the pose in the model; the pose may name another frame."""


@dataclass(frozen=True, slots=True)
class LeafWalk:
    """A walk over one XML tree, which collects the leaves that it has `found`; `where` locates a path in the source."""

    resolve: Resolve
    where: Callable[[str], Source | None]
    skipped: frozenset[str] = frozenset()
    found: dict[str, Leaf] = field(default_factory=dict[str, Leaf])

    def enter(
        self, element: XmlElement, fact: Fact, holder: Transform, path: str = "", *, carried: bool = False
    ) -> None:
        """Collect the values of an element that `fact` describes; poses in it are relative to `holder`."""
        rows = _rows(fact)
        here = self._pose(element, rows, holder, path, carried=carried)
        self._attributes(element, rows, path, carried=carried)
        for key, child in _keyed(element, rows):
            row = rows.get(str(child.tag))
            if f"{path}{child.tag}" not in self.skipped and (row is None or row.reference not in _WITHOUT_MEANING):
                self._child(child, row, here, f"{path}{key}", carried=carried)
        for kept in element.iterchildren(KEPT):
            seen = dict[str, int]()
            for _, child in _keyed(kept, {}):
                name, tag = child.get("name"), str(child.tag)
                key = numbered(f"{tag}[{name}]" if name else tag, seen)
                self._enter_kept(child, table("mjcf").definitions.get(tag), f"{path}{key}")

    def _enter_kept(self, element: XmlElement, fact: Fact | None, path: str) -> None:
        """Collect the values that only MJCF says of a node, `fact` being what its table says of the element."""
        rows = _rows(fact) if fact else {}
        for name, text in element.items():
            row = rows.get(f"@{name}")
            default = _untyped_value(row.default) if row is not None and row.default else None
            self._add(f"{path}/@{name}", _untyped_value(str(text)), default, only=Format.MJCF)
        for key, child in _keyed(element, rows):
            if child.tag in _DERIVED_IN_MJCF:
                continue
            row, inner = rows.get(str(child.tag)), f"{path}/{key}"
            if row is not None and row.repeats:
                self._add(inner, THERE, None, only=Format.MJCF)
            self._enter_kept(child, table("mjcf").resolve(row) if row else None, inner)

    def enter_free(self, element: XmlElement, path: str, *, carried: bool = False, fact: Fact | None = None) -> None:
        """Collect the values of content that SDF's table does not describe; `fact` is its row in URDF's table."""
        for name, value in element.items():
            if not str(name).startswith(_OURS):
                self._add(_join(path, f"@{name}"), _untyped_value(str(value)), None, carried=carried)
        text = (element.text or "").strip()
        if text or not (len(element) or element.keys()):
            self._add(path or "text", _untyped_value(text), None, carried=carried)
        for key, child in _keyed(element, {}):
            row = urdf_row(fact, str(child.tag)) if fact else None
            if row is None or row.repeats or not _says_again(child):
                self.enter_free(child, _join(path, key), carried=carried, fact=row)

    def _pose(
        self, element: XmlElement, rows: dict[str, Fact], holder: Transform, path: str, *, carried: bool
    ) -> Transform:
        if "pose" not in rows or f"{path}pose" in self.skipped:
            return holder
        written = element.find("pose")
        pose = Pose.unchecked() if written is None else read_pose(from_xml(written))
        here = self.resolve(pose, holder)
        self._add(f"{path}pose", PoseValue(here), None, carried=carried)
        return here

    def _attributes(self, element: XmlElement, rows: dict[str, Fact], path: str, *, carried: bool) -> None:
        for name, text in element.items():
            if str(name).startswith(_OURS) or f"{path}@{name}" in self.skipped:
                continue
            row = rows.get(f"@{name}")
            self._add(f"{path}@{name}", _value(str(text), row), _default(row), carried=carried)

    def _child(self, child: XmlElement, row: Fact | None, here: Transform, path: str, *, carried: bool) -> None:
        carried = carried or child.get(CARRIED) is not None
        if row is None or row.any:
            self.enter_free(child, path, carried=carried)
        elif row.reference in _POSES:
            return
        elif row.type is not None and row.reference is None:
            self._leaf(child, row, path, carried=carried)
        else:
            self._container(child, row, here, path, carried=carried)

    def _leaf(self, child: XmlElement, row: Fact, path: str, *, carried: bool) -> None:
        text = (child.text or "").strip()
        if text:
            self._add(path, _value(text, row), _default(row), carried=carried)
        self._attributes(child, _rows(row), f"{path}/", carried=carried)

    def _container(self, child: XmlElement, row: Fact, here: Transform, path: str, *, carried: bool) -> None:
        fact = table("sdf").resolve(row)
        inner = [one for one in child if isinstance(one.tag, str) and not one.tag.startswith(_OURS)]
        if row.name == "geometry":
            self._add(path, Text(in_usual_namespaces(str(inner[0].tag)) if inner else "empty"), None, carried=carried)
        elif row.repeats or (row.name in _MEANINGFUL_WHEN_EMPTY and (inner or _own_keys(child))):
            self._add(path, THERE, None, carried=carried)
        if fact.any:
            self.enter_free(child, path, carried=carried)
        else:
            self.enter(child, fact, here, f"{path}/", carried=carried)
        if row.repeats:
            self.found.pop(f"{path}/@name", None)  # it is in the path

    def _add(
        self, path: str, value: Value, default: Value | None, *, carried: bool = False, only: Format | None = None
    ) -> None:
        """Add a leaf, unless its path has one: the first of two elements counts."""
        leaf = Leaf(value, default, self.where(path), carried=carried, only=only)
        self.found.setdefault(in_usual_namespaces(path), leaf)


def _own_keys(element: XmlElement) -> list[str]:
    return [str(name) for name in element.keys() if not str(name).startswith(_OURS)]  # noqa: SIM118 - lxml iterates children


def _join(path: str, step: str) -> str:
    return f"{path}/{step}" if path else step


def _rows(fact: Fact) -> dict[str, Fact]:
    """Return the rows by name; of several with one name, the one of the newest version."""
    found: dict[str, Fact] = {}
    for row in fact.rows:
        if row.name not in found or row.until > found[row.name].until:
            found[row.name] = row
    return found


def _keyed(element: XmlElement, rows: dict[str, Fact]) -> Iterator[tuple[str, XmlElement]]:
    """Yield the children except carriers, each with a key: its tag, and its name or number where several have the tag.

    Of an element that may stand once, only the one that readers take is yielded: the first or, for some, the last.
    """
    seen: dict[str, int] = {}
    for child in element:
        if not isinstance(child.tag, str) or child.tag.startswith(_OURS):
            continue
        row, name = rows.get(child.tag), child.get("name")
        # urdfdom (FirstChildElement) and libsdformat (Element::GetElement) take the first of
        # several. 440 kinds of elements, each repeated with other values, changed nothing in the
        # DOM of libsdformat 12.
        if row is not None and row.last:
            if not is_followed(child):
                yield child.tag, child
            continue
        if row is not None and not row.repeats:
            key = numbered(child.tag, seen)
            if key == child.tag or ((element.tag, child.tag) in _EACH_COUNTS and not _says_again(child)):
                yield key, child
            continue
        if row is not None and not name and child.tag == "plugin":
            name = plugin_stem(child.get("filename"))
        key = f"{child.tag}[{name}]" if row is not None and name else child.tag
        yield numbered(key, seen), child


def _says_again(element: XmlElement) -> bool:
    """Whether an element repeats the first one of its name, so that it does not matter which of them a reader takes."""
    parent = element.getparent()
    first = parent.find(str(element.tag)) if parent is not None else None
    return first is not None and first is not element and same_element(first, element)


def urdf_row(fact: Fact, *names: str) -> Fact | None:
    """Return the row of the URDF element at a path of names below `fact`, or None where the table has none."""
    found: Fact | None = fact
    for name in names:
        found = next((row for row in table("urdf").resolve(found).children if row.name == name), None)
        if found is None:
            return None
    return found


def numbered(key: str, seen: dict[str, int]) -> str:
    """Return the key with a number from its second use on; `seen` counts the uses."""
    count = seen[key] = seen.get(key, 0) + 1
    return key if count == 1 else f"{key}[{count}]"


def _value(text: str, row: Fact | None) -> Value:
    if row is None or row.type is None:
        return _untyped_value(text)
    return typed_value(row.type, text, unit=row.unit or "") or text_value(text)


def _default(row: Fact | None) -> Value | None:
    if row is None:
        return None
    if row.name == "uri" and row.type == "string" and row.count == "+":  # of a script, the only one that may repeat
        return Text(SCRIPT_URI)
    return _value(row.default, row) if row.default is not None else None


def _untyped_value(text: str) -> Value:
    """Read a text of unknown type: a boolean, numbers if all words are, or else the text with single blanks."""
    if text.strip() in _TRUTHS:
        return Flag(text.strip() == "true")
    try:
        numbers = tuple(map(float, text.split()))
    except ValueError:
        return text_value(" ".join(text.split()))
    # Python reads 1_000 as a number; no reader of robots does.
    return Numbers(numbers) if numbers and "_" not in text else text_value(text.strip())


def text_value(text: str) -> Text:
    """Return a text value in which `package://` URIs are written as `model://` ones, which name the same file."""
    return Text(text.replace("package://", "model://", 1) if text.startswith("package://") else text)


_CARRIER = {name: f"{{{NAMESPACE}}}{name}" for name in ("sdf", "urdf", "version")}
CARRIER_OF_URDF = _CARRIER["urdf"]
_ABOUT_SPELLING = frozenset({"pose", "version"})
"""Elements in carriers that tell how the other file spelled a value."""


def unpack_sdf(element: XmlElement, fact: Fact) -> None:
    """Move the contents of SDF carriers to their places in the tree, marked as carried, where nothing is written."""
    for carrier in list(element.iter(_CARRIER["sdf"], _CARRIER["version"])):
        parent = carrier.getparent()
        if parent is None or _is_in_carrier(carrier) or carrier.get("instead") or carrier.get("without"):
            continue
        parent.remove(carrier)
        at = carrier.get("at") or ""
        if at.startswith("/"):
            continue
        name, value = carrier.get("attribute"), carrier.get("value")
        if name is not None:
            holder = _find_or_make(parent, at)
            holder.set(name, holder.get(name, value or ""))
        for child in carrier:
            _graft(child, parent, at, fact if parent is element else None)


def _is_in_carrier(carrier: XmlElement) -> bool:
    return any(str(above.tag).startswith(f"{{{NAMESPACE}}}") for above in carrier.iterancestors())


def _is_beside_another(carrier: XmlElement) -> bool:
    return any(carrier.get(name) is not None for name, _ in SECOND)


def _graft(child: XmlElement, parent: XmlElement, at: str, fact: Fact | None) -> None:
    if child.tag in _ABOUT_SPELLING or not isinstance(child.tag, str):
        return
    repeats = fact is not None and not at and any(row.name == child.tag and row.repeats for row in fact.rows)
    holder = _find_or_make(parent, at)
    written = None if repeats else holder.find(child.tag)
    if written is None:
        made = deepcopy(child)
        made.set(CARRIED, "1")
        holder.append(made)
        return
    for inner in child:
        _graft(inner, written, "", None)


def _find_or_make(element: XmlElement, path: str) -> XmlElement:
    for step in filter(None, path.split("/")):
        found = element.find(step)
        element = found if found is not None else etree.SubElement(element, step)
    return element


def urdf_pieces(element: XmlElement) -> Iterator[tuple[str, XmlElement]]:
    """Yield the contents of the URDF carriers in an element: their paths, and the carrier or an element in it.

    Carriers of repeated elements are skipped, because readers of URDF take the first one.
    """
    for carrier in element.iter(_CARRIER["urdf"]):
        if _is_in_carrier(carrier) or _is_beside_another(carrier):
            continue
        at = "/".join(filter(None, (*_tags_between(element, carrier), carrier.get("at"))))
        if carrier.get("attribute") is not None or carrier.get("text") is not None:
            yield at, carrier
        yield from ((at, child) for child in carrier if isinstance(child.tag, str))


def _tags_between(element: XmlElement, carrier: XmlElement) -> list[str]:
    """Return the tags on the way from an element down to the parent of a carrier in it."""
    above = list(carrier.iterancestors())
    return [str(each.tag) for each in reversed(above[: above.index(element)])]


def definition(name: str) -> Fact:
    """Return a definition from SDF's facts table."""
    return table("sdf").definitions[name]
