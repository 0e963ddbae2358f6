"""The elements and values of a normal form, and how repeated `<gazebo>` elements are merged into one."""

from dataclasses import field, replace
from typing import NamedTuple

from twinform.compiler.compare.compared_values import Flag, Numbers, PoseValue, Text, Value, gaps, typed_value
from twinform.compiler.compare.comparison import TOLERANCE
from twinform.dataclass import dataclass
from twinform.ir import Pose
from twinform.ir.transform import Transform
from twinform.schemas import Fact, XmlElement, format_value, parse_value

TEXT = ""
"""The name of the value that is the text of an element."""


class Key(NamedTuple):
    """The key of a part among its siblings: its tag, its name if it has one, and a number if several have both."""

    tag: str
    name: str
    number: int


@dataclass(slots=True)
class NormalPart:
    """An element with the values that are not the default.

    `values` has the values of attributes (`@name`), of the text (`TEXT`) and of the pose (`pose`). The order of the
    children counts if the part is `ordered`.
    """

    element: XmlElement
    ordered: bool = False
    values: dict[str, Value] = field(default_factory=dict[str, Value])
    children: dict[Key, "NormalPart"] = field(default_factory=dict[Key, "NormalPart"])
    _counts: dict[tuple[str, str], int] = field(default_factory=dict[tuple[str, str], int])

    @property
    def is_empty(self) -> bool:
        """Whether the part has neither values nor children."""
        return not self.values and not self.children

    def next_key(self, tag: str, name: str) -> Key:
        """Return the key for the next child of this tag and name."""
        count = self._counts[tag, name] = self._counts.get((tag, name), 0) + 1
        return Key(tag, name, count)


def text_of(element: XmlElement) -> str:
    """Return the text of an element, including text between its children, which is a mistake in most."""
    texts = (element.text, *(child.tail for child in element))
    return " ".join(filter(None, ((text or "").strip() for text in texts)))


def tag_part(tag: XmlElement, value: Value | None) -> NormalPart:
    """Make the part of a `<gazebo>` tag from its value, with its attributes, which mean nothing."""
    values = {f"@{name}": literally(str(text)) for name, text in tag.items() if name != "value"}
    return NormalPart(tag, values=values if value is None else {**values, TEXT: value})


def add_once(made: NormalPart, tag: str, part: NormalPart) -> None:
    """Add a part unless an equal one is there: repetitions of some tags mean nothing."""
    if not any(one.values == part.values for key, one in made.children.items() if key.tag == tag):
        made.children[_free_key(made, tag, "")] = part


def pool(made: NormalPart, tag: str, part: NormalPart) -> None:
    """Add one of several elements that are read as one, such as two `<collision>` in `<gazebo>`."""
    key = Key(tag, "", 1)
    mine = made.children.get(key)
    if mine is None:
        if not part.is_empty:
            made.children[key] = part
        return
    mine.values = {**part.values, **mine.values}
    for inner, child in part.children.items():
        if inner.name:
            mine.children[_free_key(mine, inner.tag, inner.name)] = child
        elif child.children:
            pool(mine, inner.tag, child)
        else:
            add_once(mine, inner.tag, child)


def _free_key(made: NormalPart, tag: str, name: str) -> Key:
    return Key(tag, name, 1 + sum(1 for key in made.children if (key.tag, key.name) == (tag, name)))


_LEAST = 1e-6
"""The least scale of numbers: what rounding leaves of zero counts as zero, and the smallest inertia does not."""
_QUATERNION = 7
NOWHERE_ELSE = PoseValue(Transform())
"""The identity."""


def same(one: Value, other: Value) -> bool:
    """Whether two values are equal except for rounding."""
    if one == other:
        return True
    if isinstance(one, Numbers):
        one = replace(one, floor=_LEAST)
    return not any(gap.exceeds(TOLERANCE) for gap in gaps(one, other))


def value_of(text: str, row: Fact, format: str) -> Value:
    """Return the value of a text by the type of its row."""
    if format == "mjcf" and row.type == "quaternion" and (turn := _mjcf_rotation(text)) is not None:
        return PoseValue(turn)
    if format == "mjcf" and row.default and row.type and row.type.startswith("double."):
        text = " ".join([text, *row.default.split()[len(text.split()) :]])  # a list may say its first numbers alone
    return typed_value(row.type, text, format) or Text(text)


def parsed_value(parsed: object) -> Value:
    """Return the value for a boolean, text or numbers in Python."""
    if isinstance(parsed, bool):
        return Flag(parsed)
    if isinstance(parsed, str):
        return Text(parsed)
    return Numbers(tuple(map(float, format_value(parsed).split())))


def literally(text: str) -> Value:
    """Return a text of unknown meaning as a value, with single blanks."""
    return Text(" ".join(text.split()))


def urdf_pose(element: XmlElement) -> Transform | None:
    """Return the transform of an `<origin>`; None where it is not a valid pose."""
    try:
        xyz, rpy, quaternion = (_numbers(element.get(name)) for name in ("xyz", "rpy", "quat_xyzw"))
        return Transform.from_pose(Pose.model_validate({"xyz": xyz, "rpy": rpy, "quat_xyzw": quaternion}))
    except ValueError:
        return None


def sdf_pose(element: XmlElement) -> Transform | None:
    """Return the transform of a `<pose>`; None where it is not a valid pose."""
    try:
        numbers = _numbers(element.text) or (0.0,) * (_QUATERNION - 1)
        degrees = parse_value("bool", element.get("degrees") or "false")
        turned = "quat_xyzw" if len(numbers) == _QUATERNION else "rpy"
        pose = {"xyz": numbers[:3], turned: numbers[3:], "degrees": degrees}
        return Transform.from_pose(Pose.model_validate(pose))
    except ValueError:
        return None


def _mjcf_rotation(text: str) -> Transform | None:
    """Return the rotation of a quaternion w x y z, of any length but zero; None for other texts."""
    try:
        w, *xyz = map(float, text.split())
        return Transform.from_pose(Pose.model_validate({"quat_xyzw": (*xyz, w)}))
    except ValueError:
        return None


def _numbers(text: str | None) -> tuple[float, ...] | None:
    return tuple(map(float, text.split())) if text and text.strip() else None
