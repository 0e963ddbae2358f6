"""XML documents that the schema of a version accepts, made from the tables of facts with any source of chance."""

from collections.abc import Sequence
from random import Random

from lxml import etree

from twinform.diagnostics import DiagnosticSink
from twinform.schemas import Context, Version, XmlElement, parse_version, reader, table
from twinform.schemas.facts import Fact, Table

_DEEPEST = 7
_MOST_OPTIONAL = 3
_WHOLE = ("0", "1", "2", "7", "7.0")
_NUMBERS = ("0", "1", "-0.5", "0.25", "1e-3", "2", "100", "3.25e2")
_WORDS = ("a", "b", "link_0", "model://a/b.dae", "a b", "\u00e9")
_SIZES = {
    "vector2d": 2,
    "vector2i": 2,
    "vector3": 3,
    "quaternion": 4,
    "color": 4,
    "color4": 4,
    "pose": 6,
}
_TEXTS = {
    "doubles": ("", "1", "0.5 -inf 1e-3"),
    "ints": ("", "0", "1 -2 3"),
    "words": ("", "a", "a b"),
    "memory": ("-1", "10M"),
    "axes": ("xyz", "XYz"),
}
"""Values of types that only MJCF has."""


def read_tree(root: XmlElement, format: str, version: Version) -> Context:
    """What the reader finds in a tree."""
    context = Context(DiagnosticSink(), "", format, version)
    reader(format, version).read(root, context)
    return context


def version_of(root: XmlElement, format: str) -> Version:
    """The version that a tree declares; the first of URDF and the newest of others where there is no such version."""
    declared, versions = root.get("version"), table(format).versions
    return parse_version(declared if declared in versions else versions[0 if format == "urdf" else -1])


def document(random: Random, format: str, version: str) -> bytes:
    """A document of a version of a format; simple choices are small numbers, so that it shrinks."""
    made = _Document(random, table(format), parse_version(version))
    root = made.element(made.table.definitions[made.table.root], 0, "")
    root.attrib.pop("version", None)
    if format == "sdf" or (format == "urdf" and version != "1.0"):
        root.set("version", version)
    return etree.tostring(root)


class _Document:
    def __init__(self, random: Random, facts: Table, version: Version) -> None:
        self.random = random
        self.table = facts
        self.version = version
        self.count = 0

    def element(self, row: Fact, depth: int, name: str) -> XmlElement:
        """An element of a row with all that it needs, and a few of the things that it may have."""
        fact = self.table.resolve(row)
        made = etree.Element(name or row.name)
        rows = [each for each in fact.rows if each.exists_in(self.version) and each.dialect is None]
        attributes = [each for each in rows if each.is_attribute]
        for each in self._chosen(attributes, depth):
            made.set(each.name[1:], self.text(each))
        children = self._one_of_a_kind(self._chosen([each for each in rows if not each.is_attribute], depth))
        for each in children:
            for _ in range(self._times(each, depth)):
                made.append(self.element(each, depth + 1, each.name))
        self.random.shuffle(children)
        if row.type or fact.type:
            made.text = self.text(row if row.type else fact)
        return made

    def text(self, row: Fact) -> str:
        """A value of a row."""
        if row.enum:
            return self.random.choice(row.enum)
        if row.type in _TEXTS or "." in (row.type or ""):
            return self._text_of_mjcf(row)
        if row.type in _SIZES:
            return " ".join(self._number(row, whole=row.type == "vector2i") for _ in range(_SIZES[row.type]))
        match row.type:
            case "bool":
                return self.random.choice(
                    ("true", "false") if self.table.format == "mjcf" else ("true", "false", "1", "0")
                )
            case "int" | "uint":
                return self._number(row, whole=True)
            case "double" | "time":
                return self._number(row, whole=False)
            case _:
                return self._word(row)

    def _text_of_mjcf(self, row: Fact) -> str:
        """A value of a type that only MJCF has."""
        kind, _, lengths = (row.type or "").partition(".")
        if not lengths:
            return self.random.choice(_TEXTS[kind])
        least, _, most = lengths.partition("-")
        count = self.random.randint(int(least), int(most or least))
        return " ".join(self._number(row, whole=kind == "int") for _ in range(count))

    def _word(self, row: Fact) -> str:
        if row.name != "@name":
            return self.random.choice(_WORDS)
        self.count += 1  # keys of the normative schema ask for different names
        return f"n{self.count}"

    def _number(self, row: Fact, *, whole: bool) -> str:
        least = row.min if row.min is not None else 0 if row.type in {"uint", "color", "color4"} else float("-inf")
        most = row.max if row.max is not None else 1 if row.type in {"color", "color4"} else float("inf")
        texts = _WHOLE[: -1 if self.table.format == "mjcf" else None] if whole else _NUMBERS
        fitting = [text for text in texts if least <= float(text) <= most]
        return self.random.choice(fitting or [f"{least if least > float('-inf') else most:g}"])

    def _chosen(self, rows: Sequence[Fact], depth: int) -> list[Fact]:
        needed = [each for each in rows if each.required]
        optional = [each for each in rows if not each.required]
        if depth >= _DEEPEST or not optional:
            return needed
        count = min(self.random.randint(0, _MOST_OPTIONAL), len(optional))
        return [*needed, *self.random.sample(optional, count)]

    def _one_of_a_kind(self, rows: Sequence[Fact]) -> list[Fact]:
        """Of several elements for one field, such as shapes, the first."""
        found: dict[str, Fact] = {}
        for each in rows:
            found.setdefault((each.place or each.name) if each.kind else each.name, each)
        return list(found.values())

    def _times(self, row: Fact, depth: int) -> int:
        return 1 if not row.repeats or depth >= _DEEPEST else self.random.randint(1, 2)
