"""Builds a normal form from an XML tree, by the facts table of a format in a version."""

from functools import cache

from twinform.compiler.compare.compared_values import Numbers, PoseValue, Text, Value
from twinform.compiler.normal_form.gazebo import POOLED, Path, extension_rows, tag_paths, tag_value
from twinform.compiler.normal_form.part import TEXT, Key, NormalPart, add_once, pool, tag_part, text_of
from twinform.compiler.normal_form.value_meanings import (
    NOWHERE_ELSE,
    literally,
    same,
    sdf_pose,
    urdf_pose,
    value_of,
)
from twinform.ir.defaults import UNLIMITED
from twinform.ir.frames import MODEL
from twinform.ir.transform import Transform
from twinform.schemas import Fact, Version, XmlElement, rows_by_name, table

_MEANINGFUL_WHEN_EMPTY = {
    "urdf": frozenset({"limit", "material"}),
    "sdf": frozenset({"geometry", "material", "pbr", "metal"}),
}
"""Containers that are optional, and mean something when they are empty."""
_HAS_TO_BE_THERE = frozenset({("material", "name")})
"""Attributes that may be empty but not left out: urdfdom refuses a material without a name."""
_MODEL = "model"
_CANONICAL = "@canonical_link"
"""The link that the frame of a model in SDF is attached to: the first one where it is not written."""
_POSED_IN_MODEL = frozenset({"link", "model"})
"""What is posed in the frame of the model around it, if its pose names no other."""
_FRAMES = frozenset({"parent", "child", "@attached_to", "@relative_to", "@expressed_in"})
"""What names a frame of SDF, for which the name of a model in the model stands as well."""
_OF_MODEL = f"::{MODEL}"
_EXTENSION = "gazebo"
_ORIGIN = "origin"
_POSE = "pose"
_TURNS = frozenset({"@xyz", "@rpy", "@quat_xyzw"})
_NOTATIONS = frozenset({"@degrees", "@rotation_format"})

Rows = dict[str, Fact]


class Builder:
    """Makes parts of the elements of one format in one version."""

    def __init__(self, format: str, version: Version) -> None:
        self.format = format
        self.version = version
        self.table = table(format)
        # by the identity of rows, which live as long as the program
        self._rows: dict[int, Rows] = {}
        self._defaults: dict[int, Value] = {}

    def root(self, element: XmlElement) -> NormalPart:
        """The whole file."""
        return self.part(element, self.table.definitions[self.table.root])

    def part(self, element: XmlElement, row: Fact | None) -> NormalPart:
        """An element; without a row it is one that the format does not know."""
        fact = self.table.resolve(row) if row else None
        made = NormalPart(element)
        if fact is None or (fact.any and fact.name != _EXTENSION):
            _fill_freely(made, element)
        elif fact.name == _EXTENSION:
            self._extend(made, element)
        else:
            self._fill(made, element, fact)
        return made

    def _fill(self, made: NormalPart, element: XmlElement, fact: Fact) -> None:
        rows = self._rows_of(fact)
        self._attributes(made, element, fact, rows)
        if fact.name == _MODEL and (first := element.find("link")) is not None:
            made.values.setdefault(_CANONICAL, Text(first.get("name") or ""))
        if fact.name == _ORIGIN and self.format == "urdf":
            _place(made, urdf_pose(element))
        elif fact.type == _POSE and (where := sdf_pose(element)) is not None:
            _place(made, where)
        else:
            self._text(made, element, fact)
        for child in element:
            self.child(made, child, rows.get(str(child.tag)))

    def _rows_of(self, fact: Fact) -> Rows:
        found = self._rows.get(id(fact))
        if found is None:
            found = self._rows[id(fact)] = rows_by_name(fact.rows, self.version)
        return found

    def _attributes(self, made: NormalPart, element: XmlElement, fact: Fact, rows: Rows) -> None:
        for name, text in element.items():
            if fact.type == _POSE and name == "frame" and not text:
                continue  # which meant nothing in the versions that had it
            row = None if (element.tag, name) in _HAS_TO_BE_THERE else rows.get(f"@{name}")
            value = self._value(_frame(str(text), f"@{name}"), row) if row else literally(str(text))
            if value is not None and not (text == MODEL and _is_in_model(element, fact, f"@{name}")):
                made.values[f"@{name}"] = value

    def _text(self, made: NormalPart, element: XmlElement, fact: Fact) -> None:
        text = _frame(text_of(element), str(element.tag))
        value = self._value(text, fact) if fact.type else literally(text)
        if text and value is not None:
            made.values[TEXT] = value

    def _value(self, text: str, row: Fact) -> Value | None:
        """The value of a text, if that is no default; where there may be no text, the empty one is as good as none."""
        value = value_of(text, row, self.format)
        if row.default is not None:
            return None if self._is_default(value, row) else value
        return value if text or row.required else None

    def _is_default(self, value: Value, row: Fact) -> bool:
        default = self._default_of(row)
        return default is not None and (same(value, default) or _is_endless(value, default))

    def _default_of(self, row: Fact) -> Value | None:
        if row.default is None:
            return None
        found = self._defaults.get(id(row))
        if found is None:
            found = self._defaults[id(row)] = value_of(row.default, row, self.format)
        return found

    def child(self, made: NormalPart, child: XmlElement, row: Fact | None) -> None:
        """Take in a child; without a row it is one that the format does not know."""
        tag = str(child.tag)
        if row is not None and self.table.resolve(row).name == _EXTENSION:
            self._pool(made, child, row)
            return
        named = row is None or row.repeats
        key = made.next_key(tag, (child.get("name") if named else None) or "")
        part = self.part(child, row)
        if row is None or not (part.is_empty and self._may_be_left_out(row)):
            made.children[key] = part

    def _may_be_left_out(self, row: Fact) -> bool:
        """Whether an element in which only defaults were means the same as none."""
        fact = self.table.resolve(row)
        if row.count != "?" or row.kind:
            return False
        if fact.type is not None:
            return fact.type == "string" or fact.default is not None
        read = row.place is not None or row.reference == _ORIGIN
        return read and row.name not in _MEANINGFUL_WHEN_EMPTY[self.format]

    def _pool(self, made: NormalPart, child: XmlElement, row: Fact) -> None:
        """Take in an extension of URDF; those of one reference are read as one, and one without content as none."""
        reference = child.get("reference") or ""
        # Extensions of one reference are pooled: a conversion cannot know how many there were, and
        # no reader asks.
        key = made.next_key(_EXTENSION, reference)._replace(number=1)
        before = made.children.get(key)
        part = before or self.part(child, row)
        if before is not None:
            self._extend(before, child)
        elif not part.children and not (part.values.keys() - {"@reference"}):
            return
        made.children[key] = part

    def _extend(self, made: NormalPart, element: XmlElement) -> None:
        """Take in the content of an extension, which is SDF but for some tags of its own."""
        for name, text in element.items():
            if text:
                made.values[f"@{name}"] = literally(str(text))
        if text := text_of(element):
            made.values[TEXT] = literally(text)
        sdf = builder("sdf", table("sdf").newest)
        for child in element:
            # <mu1> and a <collision> with a <surface>, in one or in two <gazebo> elements, set one
            # field. Which of these the author wrote would be a second copy of the notation of each
            # number, so a tag counts as the value that it sets.
            paths, found = tag_paths(child), tag_value(child)
            if found is not None and paths:
                for path in paths:
                    sdf.say(made, path, child, found[1])
            elif found is not None:
                add_once(made, found[0], tag_part(child, found[1]))
            elif child.tag in POOLED:
                pool(made, str(child.tag), sdf.part(child, extension_rows()[str(child.tag)]))
            else:
                sdf.child(made, child, extension_rows().get(str(child.tag)))

    def say(self, made: NormalPart, path: Path, tag: XmlElement, value: Value) -> None:
        """Take in a tag of an extension as what it means: a value at a path of what SDF has there."""
        rows, row = extension_rows(), None
        for step in path:
            row = rows[step]
            rows = self._rows_of(self.table.resolve(row))
        part = tag_part(tag, None if row and self._is_default(value, row) else value)
        if part.is_empty:
            return
        for step in path[:-1]:
            made = made.children.setdefault(Key(step, "", 1), NormalPart(tag))
        add_once(made, path[-1], part)


def _frame(text: str, name: str) -> str:
    """The text of an element or attribute; of one that names the frame of a model, the name of that model."""
    return text.removesuffix(_OF_MODEL) if name in _FRAMES else text


def _is_in_model(element: XmlElement, fact: Fact, name: str) -> bool:
    """Whether an attribute names the frame that goes without saying if it is the model's."""
    if fact.type == _POSE:
        holder = element.getparent()
        return name == "@relative_to" and holder is not None and holder.tag in _POSED_IN_MODEL
    return fact.name == "frame" and name == "@attached_to"


@cache
def builder(format: str, version: Version) -> Builder:
    """The builder of a format in a version."""
    return Builder(format, version)


def _fill_freely(made: NormalPart, element: XmlElement) -> None:
    """Take in what only other programs know: all of it, in its order."""
    made.ordered = True
    for name, text in element.items():
        made.values[f"@{name}"] = literally(str(text))
    if text := text_of(element):
        made.values[TEXT] = literally(text)
    for child in element:
        part = NormalPart(child)
        _fill_freely(part, child)
        made.children[made.next_key(str(child.tag), child.get("name") or "")] = part


def _is_endless(value: Value, like: Value) -> bool:
    """Whether two numbers stand for no limit at all, on one side: 1e16 and beyond, as in SDF before 1.10."""
    if not (isinstance(value, Numbers) and isinstance(like, Numbers)):
        return False
    (one, *more), (other, *_) = value.values, like.values
    return not more and min(abs(one), abs(other)) >= UNLIMITED and (one > 0) == (other > 0)


def _place(made: NormalPart, where: Transform | None) -> None:
    """Take in a pose as the place that it means; what is none stays as it is written."""
    if where is None:
        return
    values = made.values
    for name in _TURNS & values.keys():
        del values[name]
    if same(PoseValue(Transform(rotation=where.rotation)), NOWHERE_ELSE):
        for name in _NOTATIONS & values.keys():
            del values[name]
    elif made.element.get("quat_xyzw"):
        values["@quat_xyzw"] = Text("a quaternion")
    if not same(PoseValue(where), NOWHERE_ELSE):
        values[_POSE] = PoseValue(where)
