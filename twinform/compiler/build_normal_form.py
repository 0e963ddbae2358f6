"""Builds a normal form from an XML tree, by the facts table of a format in a version."""

from collections.abc import Iterator
from functools import cache

from twinform.compiler.compare.compared_values import Numbers, PoseValue, Text, Value, typed_value
from twinform.compiler.normal_form_parts import (
    NOWHERE_ELSE,
    TEXT,
    Key,
    NormalPart,
    add_once,
    literally,
    parsed_value,
    pool,
    same,
    sdf_pose,
    tag_part,
    text_of,
    urdf_pose,
    value_of,
)
from twinform.ir.defaults import UNLIMITED
from twinform.ir.frames import MODEL
from twinform.ir.transform import Transform
from twinform.passes.shared.gazebo_tags import JOINT_TAGS, LINK_TAGS, MODEL_TAGS
from twinform.schemas import Fact, Version, XmlElement, rows_by_name, table

_TAGS = MODEL_TAGS | JOINT_TAGS | LINK_TAGS
_HOLDERS = ("model", "joint", "link")
"""The elements that a reference may name. Children of one tag are of one kind in all of them."""
_FIELDS = frozenset({"gravity", "self_collide"})
"""Booleans of a link in SDF that tags set too."""
_MATERIAL = "material"
POOLED = frozenset({"visual", "collision", "axis", "physics"})
"""Elements that add to those of the link or joint: to all its visuals and collisions, or its axis and physics."""

Path = tuple[str, ...]
_IN_AXIS: Path = ("axis", "dynamics")
_DAMPING: tuple[Path, ...] = (("velocity_decay", "linear"), ("velocity_decay", "angular"))


def tag_value(element: XmlElement) -> tuple[str, Value] | None:
    """Return the field that a tag of `<gazebo>` sets, and its value; None for elements that are not such tags.

    An SDF element of a link counts as a tag where there is a tag for its field.
    """
    name = str(element.tag)
    tag, text = _TAGS.get(name), (element.get("value") or element.text or "").strip()
    if len(element):
        return None
    if tag is None:
        return (name, typed_value("bool", text) or Text(text)) if name in _FIELDS and not element.attrib else None
    try:
        return tag.field or name, parsed_value(tag.read(text))
    except ValueError:
        return tag.field or name, Text(text)


def tag_paths(element: XmlElement) -> tuple[Path, ...]:
    """Return the SDF paths of the values that a tag of `<gazebo>` sets, if they are deeper than a child of the link."""
    tag = None if len(element) else _TAGS.get(str(element.tag))
    if tag is None:
        return ()
    if tag.field == "velocity_decay":
        return _DAMPING
    places: dict[str, Path] = {
        "surface": ("collision", "surface", *_surface_paths().get(tag.field, ())),
        "collision": ("collision", tag.field),
        "dynamics": (*_IN_AXIS, tag.field),
        "physics": ("physics", *tag.field.split("/")),
    }
    return (places[tag.target],) if tag.target in places else ()


@cache
def _surface_paths() -> dict[str, Path]:
    """Return the paths in a `<surface>` for the fields of the IR's surface."""
    sdf = table("sdf")

    def paths(row: Fact, above: Path) -> Iterator[tuple[str, Path]]:
        for name, inner in rows_by_name(row.rows, sdf.newest).items():
            if inner.type and inner.place:
                yield inner.place, (*above, name)
            elif inner.place:
                yield from paths(inner, (*above, name))

    return dict(paths(sdf.definitions["surface"], ()))


@cache
def extension_rows() -> dict[str, Fact]:
    """Return the rows of SDF elements in `<gazebo>`, by tag."""
    sdf = table("sdf")
    rows = {
        name: row for each in _HOLDERS for name, row in rows_by_name(sdf.definitions[each].rows, sdf.newest).items()
    }
    return {**rows, _MATERIAL: Fact(_MATERIAL, count="*", reference=_MATERIAL)}


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
"""Elements that are posed in the frame of the model around them, if their pose names no other frame."""
_FRAMES = frozenset({"parent", "child", "@attached_to", "@relative_to", "@expressed_in"})
"""Elements and attributes of SDF that name a frame; `name` of a nested model means the same as `name::__model__`."""
_OF_MODEL = f"::{MODEL}"
_EXTENSION = "gazebo"
_ORIGIN = "origin"
_READ = frozenset({_ORIGIN, "loop_axis"})
"""Definitions of elements that have no field of their own, and that a conversion reads."""
_POSE = "pose"
_TURNS = frozenset({"@xyz", "@rpy", "@quat_xyzw"})
_NOTATIONS = frozenset({"@degrees", "@rotation_format"})

Rows = dict[str, Fact]


class Builder:
    """Builds the parts for the elements of one format in one version."""

    def __init__(self, format: str, version: Version) -> None:
        self.format = format
        self.version = version
        self.table = table(format)
        # by the identity of rows, which live as long as the program
        self._rows: dict[int, Rows] = {}
        self._defaults: dict[int, Value] = {}

    def root(self, element: XmlElement) -> NormalPart:
        """Build the part of a root element."""
        return self.part(element, self.table.definitions[self.table.root])

    def part(self, element: XmlElement, row: Fact | None) -> NormalPart:
        """Build the part of an element; without a row, the format does not know the element."""
        fact = self.table.resolve(row) if row else None
        made = NormalPart(element)
        if fact is None or (fact.any and fact.name != _EXTENSION):
            _add_unknown_content(made, element)
        elif fact.name == _EXTENSION:
            self._add_extension(made, element)
        else:
            self._add_content(made, element, fact)
        return made

    def _add_content(self, made: NormalPart, element: XmlElement, fact: Fact) -> None:
        rows = self._rows_of(fact)
        self._add_attributes(made, element, fact, rows)
        if fact.name == _MODEL and (first := element.find("link")) is not None:
            made.values.setdefault(_CANONICAL, Text(first.get("name") or ""))
        if fact.name == _ORIGIN and self.format == "urdf":
            _add_pose(made, urdf_pose(element))
        elif fact.type == _POSE and (where := sdf_pose(element)) is not None:
            _add_pose(made, where)
        else:
            self._add_text(made, element, fact)
        for child in element:
            self.add_child(made, child, rows.get(_usual_tag(child)))

    def _rows_of(self, fact: Fact) -> Rows:
        found = self._rows.get(id(fact))
        if found is None:
            found = self._rows[id(fact)] = rows_by_name(fact.rows, self.version)
        return found

    def _add_attributes(self, made: NormalPart, element: XmlElement, fact: Fact, rows: Rows) -> None:
        for name, text in element.items():
            if fact.type == _POSE and name == "frame" and not text:
                continue  # which meant nothing in the versions that had it
            row = None if (element.tag, name) in _HAS_TO_BE_THERE else rows.get(f"@{name}")
            value = self._value(_normal_frame_name(str(text), f"@{name}"), row) if row else literally(str(text))
            if value is not None and not (text == MODEL and _defaults_to_model(element, fact, f"@{name}")):
                made.values[f"@{name}"] = value

    def _add_text(self, made: NormalPart, element: XmlElement, fact: Fact) -> None:
        text = _normal_frame_name(text_of(element), str(element.tag))
        value = self._value(text, fact) if fact.type else literally(text)
        if text and value is not None:
            made.values[TEXT] = value

    def _value(self, text: str, row: Fact) -> Value | None:
        """Return the value of a text; None for the default, or for an empty text that is not required."""
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

    def add_child(self, made: NormalPart, child: XmlElement, row: Fact | None) -> None:
        """Add a child element; without a row, the format does not know it."""
        tag = str(child.tag)
        if row is not None and self.table.resolve(row).name == _EXTENSION:
            self._add_to_pool(made, child, row)
            return
        named = row is None or row.repeats
        key = made.next_key(tag, (child.get("name") if named else None) or "")
        part = self.part(child, row)
        if row is None or not (part.is_empty and self._may_be_left_out(row)):
            made.children[key] = part

    def _may_be_left_out(self, row: Fact) -> bool:
        """Whether an element in which nothing but defaults was written means the same as none."""
        fact = self.table.resolve(row)
        if self.format == "mjcf":  # such as a section; what has a name is there by itself
            return "@name" not in rows_by_name(fact.rows, self.version)
        if row.count != "?" or row.kind:
            return False
        if fact.type is not None:
            return fact.type == "string" or fact.default is not None
        read = row.place is not None or row.reference in _READ
        return read and row.name not in _MEANINGFUL_WHEN_EMPTY[self.format]

    def _add_to_pool(self, made: NormalPart, child: XmlElement, row: Fact) -> None:
        """Add a `<gazebo>` element; those of one reference become one part, and empty ones none."""
        reference = child.get("reference") or ""
        # Extensions of one reference are pooled: a conversion cannot know how many there were, and
        # no reader asks.
        key = made.next_key(_EXTENSION, reference)._replace(number=1)
        before = made.children.get(key)
        part = before or self.part(child, row)
        if before is not None:
            self._add_extension(before, child)
        elif not part.children and not (part.values.keys() - {"@reference"}):
            return
        made.children[key] = part

    def _add_extension(self, made: NormalPart, element: XmlElement) -> None:
        """Add the content of a `<gazebo>` element, which is SDF except for some tags of its own."""
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
                    sdf.add_tag_value(made, path, child, found[1])
            elif found is not None:
                add_once(made, found[0], tag_part(child, found[1]))
            elif child.tag in POOLED:
                pool(made, str(child.tag), sdf.part(child, extension_rows()[str(child.tag)]))
            else:
                sdf.add_child(made, child, extension_rows().get(str(child.tag)))

    def add_tag_value(self, made: NormalPart, path: Path, tag: XmlElement, value: Value) -> None:
        """Add a tag of `<gazebo>` as the SDF value that it sets at a path."""
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


def _usual_tag(element: XmlElement) -> str:
    """The tag of an element; that of a `<joint>` for a `<drake:joint>`, which has what that has."""
    tag = str(element.tag)
    return "joint" if tag.endswith("}joint") and "drake" in tag else tag


def _normal_frame_name(text: str, name: str) -> str:
    """Return the text of an element or attribute; where it names the frame of a model, the name of that model."""
    return text.removesuffix(_OF_MODEL) if name in _FRAMES else text


def _defaults_to_model(element: XmlElement, fact: Fact, name: str) -> bool:
    """Whether the model's frame is the default for an attribute that names a frame."""
    if fact.type == _POSE:
        holder = element.getparent()
        return name == "@relative_to" and holder is not None and holder.tag in _POSED_IN_MODEL
    return fact.name == "frame" and name == "@attached_to"


@cache
def builder(format: str, version: Version) -> Builder:
    """Return the builder for a format in a version."""
    return Builder(format, version)


def _add_unknown_content(made: NormalPart, element: XmlElement) -> None:
    """Add everything in an element that only other programs know, in its order."""
    made.ordered = True
    for name, text in element.items():
        made.values[f"@{name}"] = literally(str(text))
    if text := text_of(element):
        made.values[TEXT] = literally(text)
    for child in element:
        part = NormalPart(child)
        _add_unknown_content(part, child)
        made.children[made.next_key(str(child.tag), child.get("name") or "")] = part


def _is_endless(value: Value, like: Value) -> bool:
    """Whether two numbers both mean no limit on one side: 1e16 and beyond, as in SDF before 1.10."""
    if not (isinstance(value, Numbers) and isinstance(like, Numbers)):
        return False
    (one, *more), (other, *_) = value.values, like.values
    return not more and min(abs(one), abs(other)) >= UNLIMITED and (one > 0) == (other > 0)


def _add_pose(made: NormalPart, where: Transform | None) -> None:
    """Replace the notation of a pose by the transform that it means; an invalid pose stays as it is written."""
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
