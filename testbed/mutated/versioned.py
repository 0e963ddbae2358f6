"""Small URDF files of every version and none, each with words that only some versions have: a number decides which."""

from collections.abc import Callable, Sequence
from itertools import pairwise
from random import Random
from xml.sax.saxutils import quoteattr

from testbed.corpus.files import Kind
from testbed.mutated.mutated import Mutated

_VERSIONS = ("1.0", "1.1", "1.2")
_SPELLINGS = (
    *("", " ", "1", "1.", "1.3", "2.0", "2", "0.9", "1.2.0", "1,1", "1.10", "abc", "-1.0", "1.2a", " 1.2 "),
    *("01.1", "1.02", "+1.1", "1. 2", "1_0.2"),
)
_TYPES = ("revolute", "continuous", "prismatic", "fixed", "floating", "planar")
_ODD_TYPES = ("", "Revolute", " fixed", "ball", "spherical")
_NUMBERS = ("1", "0.5", "2e-1", "1.", ".5", "1E0")
_FEW = (
    "0",
    "-1",
    "1e-9",
    "inf",
    "nan",
    "x",
    "",
    "1e400",
    "-0",
    "+1",
    "0x1",
    " 1 ",
    "1,5",
    "1_0",
    "1 1",
    "1f",
    "1e-400",
)
_NUMBERS_OF = {"box": {"size": 3}, "sphere": {"radius": 1}, "cylinder": {"radius": 1, "length": 1}}
_SHAPES = {**_NUMBERS_OF, "capsule": {"radius": 1, "length": 1}, "mesh": {"filename": 0, "scale": 3}}
_ODD_SHAPES = ("cone", "Box", "ellipsoid", "plane")
_FILES = ("package://r/a.stl", "a.dae")
_ODD_FILES = ("", " ", "file:///a.obj")
_QUATERNIONS = ("0.48 0.36 0 0.8", "0 0 0 1")
_ODD_QUATERNIONS = ("0 0 0 0", "1 2 3 4", "0 0 1", "0 0 0 inf", "x 0 0 1", "", "0 0 0 1 0", "0  0 0 1", "0 0 0 1e-9")
_ANGLES = ("0 0 0", "0.1 0.2 0.3")
_ODD_ANGLES = ("0 0", "x y z", "", " 0 0  0 ", "0 0 0 0", "nan 0 0")
_PLACES = ("0 0 1", "1e-1 .5 -2.")
_AXES = ("0 0 1", "1 0 0", "0.6 0 0.8")
_ODD_AXES = ("0 0 0", "0 0", "", "x 0 1", "0 0 -2", "inf 0 0")
_COLORS = ("1 0 0 1", "0.5 0.5 0.5 0.1")
_ODD_COLORS = ("1 0 0", "255 0 0 1", "-1 0 0 1", "", "x 0 0 1", "1 0 0 1 1", "nan 0 0 1")
_MATERIALS = ("red", "blue")
_MOMENTS = {"ixx": "1", "iyy": "1.5", "izz": "1.2", "ixy": "0.1", "ixz": "0", "iyz": "0"}
"""Of a body that is another one when it is turned."""


def versioned(seed: int) -> Mutated:
    """A robot of two or three links; two values in three are those that every reader takes."""
    return Mutated(Kind.URDF, seed, "versions", _Robot(Random(seed)).text().encode())


class _Robot:
    """Draws the parts of one robot."""

    def __init__(self, random: Random) -> None:
        self._random = random
        # most documents have one or two oddities: of more, readers report only the first
        self._odd = random.choice((0.0, 0.005, 0.01, 0.04))

    def text(self) -> str:
        names = ["a", "b", "c"] if self._chance(0.3) else ["a", "b"]
        parts = [*map(self._link, names), *(self._joint(parent, child) for parent, child in pairwise(names))]
        if self._chance(0.5):
            named = self._random.sample(_MATERIALS, self._random.randint(1, 2))
            parts += [self._twice(lambda name=name: self._material(name)) for name in named]
        if self._is_odd():
            parts.append(self._random.choice(parts))
        self._random.shuffle(parts)
        name = self._some({"name": self._value(("r",), ("", " "))}, 0.995)
        return f"<robot{name}{self._version()}>\n{''.join(parts)}</robot>\n"

    def _version(self) -> str:
        if self._chance(0.2):
            return ""
        spellings = _SPELLINGS if self._chance(0.1) else _VERSIONS
        return _attribute("version", self._random.choice(spellings))

    def _link(self, name: str) -> str:
        inertial = self._twice(self._inertial) if self._chance(0.8) else ""
        return f"  <link{self._name(name)}>\n{inertial}{self._bodies()}  </link>\n"

    def _inertial(self) -> str:
        mass = f"<mass{self._some({'value': self._number()}, 0.995)}/>"
        moments = {name: self._value((usual,), _FEW) for name, usual in _MOMENTS.items()}
        inertia = f"<inertia{self._some(moments, 0.995)}/>"
        parts = [
            self._origin(),
            *(self._twice(lambda part=part: part) for part in (mass, inertia) if not self._is_odd()),
        ]
        return f"    <inertial>{''.join(parts)}</inertial>\n"

    def _bodies(self) -> str:
        return "".join(map(self._body, self._random.choices(("visual", "collision"), k=self._random.randint(0, 2))))

    def _body(self, kind: str) -> str:
        name = self._some({"name": self._value(("n",), ("", " "))}, 0.3)
        geometry = "" if self._is_odd() else self._twice(lambda: f"<geometry>{self._twice(self._shape)}</geometry>")
        material = self._material(self._random.choice(_MATERIALS)) if kind == "visual" and self._chance(0.5) else ""
        return f"    <{kind}{name}>{self._origin()}{geometry}{material}</{kind}>\n"

    def _shape(self) -> str:
        name = self._random.choice(list(_SHAPES))
        sizes = {each: " ".join(self._number() for _ in range(count)) for each, count in _SHAPES[name].items()}
        if name == "mesh":
            sizes["filename"] = self._value(_FILES, _ODD_FILES)
        return f"<{self._value((name,), _ODD_SHAPES)}{self._some(sizes, 0.995)}/>"

    def _material(self, name: str) -> str:
        parts: list[str] = []
        if self._chance(0.95):
            parts.append(f"<color{self._some({'rgba': self._value(_COLORS, _ODD_COLORS)}, 0.995)}/>")
        if self._chance(0.2):
            parts.append(f"<texture{self._some({'filename': self._value(_FILES, _ODD_FILES)}, 0.95)}/>")
        return f"  <material{self._name(name)}>{''.join(parts)}</material>\n"

    def _origin(self) -> str:
        return "" if self._chance(0.5) else self._twice(self._one_origin)

    def _one_origin(self) -> str:
        found = {"xyz": self._value(_PLACES, _ODD_ANGLES)}
        if self._chance(0.5):
            found["rpy"] = self._value(_ANGLES, _ODD_ANGLES)
        if self._chance(0.5 if "rpy" not in found else 0.1):
            found["quat_xyzw"] = self._value(_QUATERNIONS, _ODD_QUATERNIONS)
        return f"<origin{self._some(found, 0.9)}/>"

    def _joint(self, parent: str, child: str) -> str:
        parts = [
            self._twice(lambda: f"<parent{self._link_named(parent)}/>"),
            self._twice(lambda: f"<child{self._link_named(child)}/>"),
            self._origin(),
            self._often(0.9, lambda: f"<axis{self._some({'xyz': self._value(_AXES, _ODD_AXES)}, 0.995)}/>"),
            self._often(0.9, self._limit),
            self._often(0.2, lambda: self._numbers("dynamics", ("damping", "friction"))),
            self._often(0.2, lambda: self._numbers("calibration", ("rising", "falling", "reference_position"))),
            self._often(0.2, self._safety),
            self._often(0.2, self._mimic),
        ]
        kind = self._some({"type": self._value(_TYPES, _ODD_TYPES)}, 0.99)
        return f"  <joint{self._name('j' + child)}{kind}>\n    {''.join(parts)}\n  </joint>\n"

    def _link_named(self, name: str) -> str:
        return self._some({"link": self._value((name,), ("", "d", "world", "a", " a"))}, 0.99)

    def _safety(self) -> str:
        return self._numbers("safety_controller", ("k_velocity", "k_position", "soft_lower_limit", "soft_upper_limit"))

    def _mimic(self) -> str:
        joint = {"joint": self._value(("jb", "jc"), ("", "d", " jb"))}
        numbers = {name: self._number() for name in ("multiplier", "offset")}
        return f"<mimic{self._some(joint, 0.95)}{self._some(numbers, 0.7)}/>"

    def _limit(self) -> str:
        usual = {"lower": "-1", "upper": "1", "effort": "1", "velocity": "1"}
        values = {name: self._value((value,), _FEW) for name, value in usual.items()}
        newer = {name: self._number() for name in ("acceleration", "deceleration", "jerk")}
        likely = self._random.choice((0.9, 1.0))
        return f"<limit{self._some(values, likely)}{self._some(newer, self._random.choice((0.0, 0.5, 1.0)))}/>"

    def _numbers(self, element: str, names: Sequence[str]) -> str:
        return f"<{element}{self._some({name: self._number() for name in names}, self._random.choice((0.7, 1.0)))}/>"

    def _name(self, name: str) -> str:
        return self._some({"name": self._value((name,), ("", " "))}, 0.995)

    def _number(self) -> str:
        return self._value(_NUMBERS, _FEW)

    def _value(self, usual: Sequence[str], odd: Sequence[str]) -> str:
        return self._random.choice(odd if self._is_odd() else usual)

    def _often(self, likely: float, draw: Callable[[], str]) -> str:
        return self._twice(draw) if self._chance(likely) else ""

    def _twice(self, draw: Callable[[], str]) -> str:
        return draw() + (draw() if self._is_odd() else "")

    def _is_odd(self) -> bool:
        return self._chance(self._odd)

    def _chance(self, likely: float) -> bool:
        return self._random.random() < likely

    def _some(self, attributes: dict[str, str], likely: float) -> str:
        return "".join(_attribute(name, value) for name, value in attributes.items() if self._chance(likely))


def _attribute(name: str, value: str) -> str:
    return f" {name}={quoteattr(value)}"
