"""Elements of a document by the facts tables and the catalog of plugins: the row of each, and what may stand in it.

Elements of xacro that only hold others, such as `<xacro:if>`, count as the element around them.
"""

from functools import cache, cached_property

from twinform.dataclass import dataclass
from twinform.passes.plugins.catalog import (
    classic_plugins_of_file,
    system_of_class,
    systems_of_file,
)
from twinform.passes.plugins.catalog_types import PluginKind, PluginParameter
from twinform.schemas import Fact, Table, Version, parse_version, rows_by_name, table
from twinform.server.mapping import FormatName, MappingRow
from twinform.server.tolerant_tree import TolerantNode, Tree

__all__ = ["FormatName", "Schema", "SchemaPlace", "format_of", "inside", "is_of_xacro"]

_ROOTS: dict[str, FormatName] = {
    "robot": "urdf",
    "sdf": "sdf",
    "gazebo": "sdf",
    "mujoco": "mjcf",
    "mujocoinclude": "mjcf",
}
_ENDINGS: tuple[tuple[tuple[str, ...], FormatName], ...] = (
    ((".sdf", ".world", ".sdf.xacro", ".world.xacro", ".model"), "sdf"),
    ((".urdf", ".xacro", ".gazebo"), "urdf"),
    ((".mjcf",), "mjcf"),
)
_LANGUAGES: dict[str, FormatName] = {"sdf": "sdf", "urdf": "urdf", "xacro": "urdf", "mjcf": "mjcf"}
"""The formats by the language ids of editors."""
_IN_GAZEBO = ("link", "joint", "model", "collision", "visual", "world")
"""The definitions of SDF whose parts stand in `<gazebo>`, the likeliest first."""
PREFIX = "xacro:"


def is_of_xacro(tag: str) -> bool:
    """Whether a tag is one of xacro's, or a call of a macro."""
    return tag.startswith(PREFIX)


def format_of(tree: Tree, name: str, language: str = "") -> FormatName | None:
    """Return the format of a document, by its root element or else by its name or the language of the editor."""
    if tree.root is not None and tree.root.tag in _ROOTS:
        return _ROOTS[tree.root.tag]
    promised: list[FormatName] = [format for endings, format in _ENDINGS if name.lower().endswith(endings)]
    return promised[0] if promised else _LANGUAGES.get(language)


@dataclass(frozen=True, eq=False)  # no slots: what is derived from it is kept in the dictionary
class SchemaPlace:
    """The place of an element in a table: its `row`, None for a root, and the fact `inside` with the rows below.

    The steps of the rows below begin with `around`, from the `definition` on. Elements at one place share one object.
    """

    format: FormatName
    version: Version
    row: MappingRow | None
    inside: Fact
    definition: str
    around: str

    def below(self, name: str) -> MappingRow | None:
        """Return the row of a child or an `@attribute`; the row of another version, if this one has none."""
        return self.rows.get(name)

    @cached_property
    def rows(self) -> dict[str, MappingRow]:
        """The rows below by name, in this version or else in another."""
        best = rows_by_name(self.inside.rows, self.version)
        return {
            name: MappingRow(self.format, self.definition, f"{self.around}{name}", fact.since, fact)
            for name, fact in best.items()
        }

    def child(self, tag: str) -> "SchemaPlace | None":
        """Return the place of a child; None if the table does not have it."""
        # A file has thousands of elements, and a few dozen places.
        if tag not in self._children:
            self._children[tag] = self._find_child(tag)
        return self._children[tag]

    @cached_property
    def _children(self) -> "dict[str, SchemaPlace | None]":
        return {}

    def _find_child(self, tag: str) -> "SchemaPlace | None":
        row = self.below(tag)
        if row is None:
            return _extension(tag, self) if self.definition == "gazebo" else None
        return inside(row, self.version)

    def known(self) -> list[Fact]:
        """Return the rows below that this version, or a dialect of it, has."""
        return [row for row in self.inside.rows if row.exists_in(self.version)]


class Schema:
    """The places of the elements of one tree."""

    def __init__(self, tree: Tree, format: FormatName | None) -> None:
        self.format: FormatName | None = format
        self.table: Table | None = table(format) if format else None
        self.version = _version(tree.root, format) if format else (0, 0)
        self._places: dict[TolerantNode, SchemaPlace | None] = {}

    def place(self, node: TolerantNode) -> SchemaPlace | None:
        """Return the place of an element; None if the table does not have it."""
        waiting: list[TolerantNode] = []
        here: TolerantNode | None = node
        while here is not None and here not in self._places:
            waiting.append(here)
            here = here.parent
        for each in reversed(waiting):
            self._places[each] = self._find_place(each)
        return self._places[node]

    def row(self, node: TolerantNode, attribute: str | None = None) -> MappingRow | None:
        """Return the row of an element, or of one of its attributes."""
        place = self.place(node)
        if place is None or attribute is None:
            return place.row if place and not is_of_xacro(node.tag) else None
        return None if is_of_xacro(node.tag) else place.below(f"@{attribute}")

    def start(self) -> SchemaPlace | None:
        """Return the place of the root."""
        if self.table is None or self.format is None:
            return None
        return root_place(self.format, self.version)

    def _find_place(self, node: TolerantNode) -> SchemaPlace | None:
        if node.parent is None:
            return self.start() if node.tag in _ROOTS or is_of_xacro(node.tag) else None
        around = self._places[node.parent]
        return around if around is None or is_of_xacro(node.tag) else around.child(node.tag)


@cache
def root_place(format: FormatName, version: Version) -> SchemaPlace:
    facts = table(format)
    return SchemaPlace(format, version, None, facts.definitions[facts.root], facts.root, "")


@cache
def inside(row: MappingRow, version: Version | None = None) -> SchemaPlace:
    """Return the place of an element with a row, in a version of the format or else in the newest."""
    fact, facts = row.fact, table(row.format)
    version = version or facts.newest
    if fact.reference is None:
        return SchemaPlace(row.format, version, row, fact, row.definition, f"{row.steps}/")
    return SchemaPlace(row.format, version, row, facts.definitions[fact.reference], fact.reference, "")


def _extension(tag: str, around: SchemaPlace) -> SchemaPlace | None:
    """Return the place of an element of SDF in `<gazebo>`."""
    for definition in _IN_GAZEBO if around.format == "urdf" else ():
        row = place_in_gazebo(definition).below(tag)
        if row is not None:
            return inside(row)
    return None


@cache
def place_in_gazebo(definition: str) -> SchemaPlace:
    """Return the place of what stands in `<gazebo>` as in a definition of SDF, such as `link`."""
    facts = table("sdf")
    return SchemaPlace("sdf", facts.newest, None, facts.definitions[definition], definition, "")


def _version(root: TolerantNode | None, format: FormatName) -> Version:
    """Return the version that a document declares, or else the newest; URDF without a version is of the oldest."""
    facts = table(format)
    declared = root.get("version") if root else None
    if declared in facts.versions:
        return parse_version(declared)
    return parse_version(facts.versions[0]) if format == "urdf" and declared is None else facts.newest


def kind_of(plugin: TolerantNode) -> PluginKind | None:
    """Find a plugin in the catalog, by its class or its file."""
    return next(iter(kinds_of(plugin)), None)


def kinds_of(plugin: TolerantNode) -> tuple[PluginKind, ...]:
    """Find all plugins in the catalog that a plugin may be: the one of its class, else those in its file.

    A file of Gazebo Classic may be one for ROS 1 or one for ROS 2; those that read what is written already come first.
    """
    file = plugin.get("filename") or ""
    of_class = system_of_class(plugin.get("name") or "")
    if of_class is not None:
        return (of_class,)
    classic = classic_plugins_of_file(file) if file else {}
    found = (*systems_of_file(file), *(classic[each] for each in ("ros2", "noetic") if each in classic)) if file else ()
    written = {child.tag for child in plugin.children}
    return tuple(sorted(found, key=lambda kind: -len(written & {each.name for each in kind.parameters})))


def parameter_of(node: TolerantNode) -> PluginParameter | None:
    """Find the parameter of a plugin that an element is."""
    steps: list[str] = []
    here: TolerantNode | None = node
    while here is not None and here.tag != "plugin":
        steps.append(here.tag)
        here = here.parent
    kinds = kinds_of(here) if here is not None and steps else ()
    return next((found for kind in kinds if (found := kind.parameter(*reversed(steps)))), None)


def parameters_in(node: TolerantNode) -> tuple[PluginParameter, ...]:
    """Return the parameters that may stand in a plugin, or in a parameter of one."""
    if node.tag == "plugin":
        rows: dict[str, PluginParameter] = {}
        for row in (row for kind in kinds_of(node) for row in kind.parameters):
            rows.setdefault(row.name, row)
        return tuple(rows.values())
    parameter = parameter_of(node)
    return parameter.children if parameter else ()


def described(parameter: PluginParameter) -> str:
    """Describe the type, unit, default and choices of a parameter."""
    words = [f"Type: {parameter.type}" + (f" ({parameter.unit})" if parameter.unit else "") + "."]
    words += [f"Default: {parameter.default}."] if parameter.default is not None else []
    words += [f"One of {', '.join(parameter.choices)}."] if parameter.choices else []
    words += ["Required."] if parameter.is_required else []
    return " ".join(words)
