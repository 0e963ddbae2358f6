"""What the elements of a document are by the facts tables: the row of each, and what may stand in it.

Elements of xacro that only hold others, such as `<xacro:if>`, are looked through.
"""

from dataclasses import dataclass

from twinform.schemas import Fact, Table, Version, parse_version, rows_by_name, table
from twinform.server.mapping.rows import FORMATS, FormatName, MappingRow
from twinform.server.tolerant_tree import TolerantNode, Tree

__all__ = ["FormatName", "Schema", "SchemaPlace", "format_of", "inside", "is_of_xacro"]

_ROOTS: dict[str, FormatName] = {"robot": "urdf", "sdf": "sdf", "gazebo": "sdf"}
_ENDINGS: tuple[tuple[tuple[str, ...], FormatName], ...] = (
    ((".sdf", ".world", ".sdf.xacro", ".world.xacro", ".model"), "sdf"),
    ((".urdf", ".xacro", ".gazebo"), "urdf"),
)
_LANGUAGES: dict[str, FormatName] = {"sdf": "sdf", "urdf": "urdf", "xacro": "urdf"}
"""What editors call them."""
_IN_GAZEBO = ("link", "joint", "model", "collision", "visual", "world")
"""The definitions of SDF whose parts stand in `<gazebo>`, the likeliest first."""
_PREFIX = "xacro:"


def is_of_xacro(tag: str) -> bool:
    """Whether an element is one of xacro's, or a call of a macro."""
    return tag.startswith(_PREFIX)


def format_of(tree: Tree, name: str, language: str = "") -> FormatName | None:
    """The format of a document: that of its root, or else the one that its name or the editor promises."""
    if tree.root is not None and tree.root.tag in _ROOTS:
        return _ROOTS[tree.root.tag]
    promised: list[FormatName] = [format for endings, format in _ENDINGS if name.lower().endswith(endings)]
    return promised[0] if promised else _LANGUAGES.get(language)


_ROWS: dict[tuple[str, str, str, Version], dict[str, MappingRow]] = {}


@dataclass(frozen=True, slots=True)
class SchemaPlace:
    """What an element is. `row` is None for a root; `inside` holds the rows of what may stand in it.

    `around` is what the steps of these begin with, below the `definition`.
    """

    format: FormatName
    version: Version
    row: MappingRow | None
    inside: Fact
    definition: str
    around: str

    def below(self, name: str) -> MappingRow | None:
        """The row of a child, or with `@` of an attribute; that of another version where this one has none."""
        return self._rows.get(name)

    @property
    def _rows(self) -> dict[str, MappingRow]:
        """The rows of all that any version has in it, made once for each definition and version."""
        key = (self.format, self.definition, self.around, self.version)
        if key not in _ROWS:
            best = rows_by_name(self.inside.rows, self.version)
            _ROWS[key] = {
                name: MappingRow(self.format, self.definition, f"{self.around}{name}", fact.since, fact)
                for name, fact in best.items()
            }
        return _ROWS[key]

    def known(self) -> list[Fact]:
        """The rows of all that may stand in it in this version, or in a dialect of it."""
        return [row for row in self.inside.rows if row.exists_in(self.version)]


class Schema:
    """The places of the elements of one tree; each is looked up once."""

    def __init__(self, tree: Tree, format: FormatName | None) -> None:
        self.format: FormatName | None = format
        self.table: Table | None = table(format) if format else None
        self.version = _version(tree.root, format) if format else (0, 0)
        self._places: dict[TolerantNode, SchemaPlace | None] = {}

    def place(self, node: TolerantNode) -> SchemaPlace | None:
        """What an element is; None for what the facts do not know."""
        waiting: list[TolerantNode] = []
        here: TolerantNode | None = node
        while here is not None and here not in self._places:
            waiting.append(here)
            here = here.parent
        for each in reversed(waiting):
            self._places[each] = self._place(each)
        return self._places[node]

    def row(self, node: TolerantNode, attribute: str | None = None) -> MappingRow | None:
        """The row of an element, or of one of its attributes."""
        place = self.place(node)
        if place is None or attribute is None:
            return place.row if place and not is_of_xacro(node.tag) else None
        return None if is_of_xacro(node.tag) else place.below(f"@{attribute}")

    def start(self) -> SchemaPlace | None:
        """What the root is."""
        if self.table is None or self.format is None:
            return None
        root = self.table.definitions[self.table.root]
        return SchemaPlace(self.format, self.version, None, root, self.table.root, "")

    def _place(self, node: TolerantNode) -> SchemaPlace | None:
        if node.parent is None:
            return self.start() if node.tag in _ROOTS or is_of_xacro(node.tag) else None
        around = self._places[node.parent]
        if around is None or is_of_xacro(node.tag):
            return around
        row = around.below(node.tag)
        if row is None:
            return _extension(node, around) if around.definition == "gazebo" else None
        return inside(row, around.version)


def inside(row: MappingRow, version: Version | None = None) -> SchemaPlace:
    """What an element of a row is, in a version of its format or else in the newest."""
    fact, facts = row.fact, table(row.format)
    version = version or facts.newest
    if fact.reference is None:
        return SchemaPlace(row.format, version, row, fact, row.definition, f"{row.steps}/")
    return SchemaPlace(row.format, version, row, facts.definitions[fact.reference], fact.reference, "")


def _extension(node: TolerantNode, around: SchemaPlace) -> SchemaPlace | None:
    """What an element of SDF in `<gazebo>` is."""
    facts = table("sdf")
    for definition in _IN_GAZEBO if around.format == "urdf" else ():
        holder = SchemaPlace(FORMATS[1], facts.newest, None, facts.definitions[definition], definition, "")
        row = holder.below(node.tag)
        if row is not None:
            return inside(row)
    return None


def _version(root: TolerantNode | None, format: FormatName) -> Version:
    """The version that a document declares, or else the newest; URDF without one is read as the oldest."""
    facts = table(format)
    declared = root.get("version") if root else None
    if declared in facts.versions:
        return parse_version(declared)
    return parse_version(facts.versions[0]) if format == "urdf" and declared is None else facts.newest
