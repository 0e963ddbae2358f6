"""Small URDF files of every version and none, each with words that only some versions have: a number decides which."""

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
_FEW = ("0", "-1", "1e-9", "inf", "nan", "x", "", "1e400")
_SHAPES = {"box": ("size",), "sphere": ("radius",), "cylinder": ("radius", "length"), "capsule": ("radius", "length")}
_QUATERNIONS = ("0 0 0.6 0.8", "0 0 0 1", "0 0 0 0", "1 2 3 4", "0 0 1", "0 0 0 inf", "x 0 0 1", "")
_ANGLES = ("0 0 0", "0.1 0.2 0.3", "0 0", "x y z")


def versioned(seed: int) -> Mutated:
    """A robot of two links; two values in three are those that every reader takes."""
    return Mutated(Kind.URDF, seed, "versions", _Robot(Random(seed)).text().encode())


class _Robot:
    """Draws the parts of one robot."""

    def __init__(self, random: Random) -> None:
        self._random = random
        # most documents have one or two oddities: of more, readers report only the first
        self._odd = random.choice((0.0, 0.02, 0.05, 0.1))

    def text(self) -> str:
        links = "".join(self._link(name) for name in "ab")
        return f"<robot name='r'{self._version()}>\n{links}{self._joint()}</robot>\n"

    def _version(self) -> str:
        if self._random.random() < 0.2:
            return ""
        spellings = _SPELLINGS if self._random.random() < 0.1 else _VERSIONS
        return self._attribute("version", self._random.choice(spellings))

    def _link(self, name: str) -> str:
        inertia = "<mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/>"
        return (
            f"  <link name='{name}'>\n    <inertial>{self._origin()}{inertia}</inertial>\n{self._bodies()}  </link>\n"
        )

    def _bodies(self) -> str:
        kinds = self._random.choices(("visual", "collision"), k=self._random.randint(0, 2))
        return "".join(f"    <{kind}>{self._origin()}<geometry>{self._shape()}</geometry></{kind}>\n" for kind in kinds)

    def _shape(self) -> str:
        name = self._random.choice(list(_SHAPES))
        sizes = {each: " ".join(self._number() for _ in range(3 if each == "size" else 1)) for each in _SHAPES[name]}
        return f"<{name}{self._some(sizes, 0.98)}/>"

    def _origin(self) -> str:
        if self._random.random() < 0.5:
            return ""
        found = {"xyz": "0 0 1"}
        if self._random.random() < 0.5:
            found["rpy"] = self._random.choice(_ANGLES if self._is_odd() else _ANGLES[:2])
        if self._random.random() < (0.5 if "rpy" not in found else 0.1):
            found["quat_xyzw"] = self._random.choice(_QUATERNIONS if self._is_odd() else _QUATERNIONS[:2])
        return f"<origin{self._some(found, 0.9)}/>"

    def _joint(self) -> str:
        parts = ["<parent link='a'/><child link='b'/>", self._origin()]
        parts += ["<axis xyz='0 0 1'/>"] if self._random.random() < 0.9 else []
        parts += [self._limit()] if self._random.random() < 0.9 else []
        if self._random.random() < 0.2:
            parts.append("<dynamics" + self._some({"damping": self._number(), "friction": self._number()}, 0.7) + "/>")
        if self._random.random() < 0.2:
            names = ("k_velocity", "k_position", "soft_lower_limit", "soft_upper_limit")
            parts.append("<safety_controller" + self._some({name: self._number() for name in names}, 0.7) + "/>")
        inside = "\n    ".join(filter(None, parts))
        return f"  <joint name='j' type='{self._random.choice(_TYPES)}'>\n    {inside}\n  </joint>\n"

    def _limit(self) -> str:
        usual = {"lower": "-1", "upper": "1", "effort": "1", "velocity": "1"}
        newer = {name: self._number() for name in ("acceleration", "deceleration", "jerk")}
        values = {name: self._random.choice(_FEW) if self._is_odd() else value for name, value in usual.items()}
        likely = self._random.choice((0.8, 0.95, 1.0))
        return f"<limit{self._some(values, likely)}{self._some(newer, self._random.choice((0.0, 0.5, 1.0)))}/>"

    def _number(self) -> str:
        return self._random.choice(_FEW) if self._is_odd() else self._random.choice(("1", "0.5", "2e-1"))

    def _is_odd(self) -> bool:
        return self._random.random() < self._odd

    def _some(self, attributes: dict[str, str], likely: float) -> str:
        kept = (name for name in attributes if self._random.random() < likely)
        return "".join(self._attribute(name, attributes[name]) for name in kept)

    def _attribute(self, name: str, value: str) -> str:
        return f" {name}={quoteattr(value)}"
