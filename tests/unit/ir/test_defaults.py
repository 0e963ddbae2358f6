"""What the IR takes for what is not written is what the facts tables say."""

from collections.abc import Iterator, Mapping

import pytest

from twinform.ir import Axis, Box, Cone, Format, Limit, Mimic, Node
from twinform.ir import defaults as ir
from twinform.ir.record import field_values
from twinform.ir.sensor import RENAMED_ELEMENTS, SENSOR_ELEMENTS
from twinform.passes.legalise.urdf_pieces import OF_AN_AXIS
from twinform.passes.plugins.catalog import sensors
from twinform.schemas import Fact, Version, parse_value, parse_version, table

NEWEST = {Format.URDF: (1, 2), Format.SDF: table("sdf").newest}
OLDER: Version = (1, 9)


def row_of(format_: Format, path: str, version: Version | None = None) -> Fact:
    """The row at a path below a definition, such as `joint/axis/xyz`, in a version."""
    facts = table(format_)
    first, *steps = path.split("/")
    found = facts.definitions[first]
    for step in steps:
        (found,) = (
            row for row in facts.resolve(found).rows if row.name == step and row.exists_in(version or NEWEST[format_])
        )
    return found


def default(format_: Format, path: str, version: Version | None = None) -> object:
    """The value at a path where nothing is written."""
    row = row_of(format_, path, version)
    return None if row.default is None else parse_value(row.type or "", row.default)


def test_axes() -> None:
    for axis in ("axis", "axis2"):
        assert ir.AXIS[Format.SDF] == default(Format.SDF, f"joint/{axis}/xyz")
    assert ir.AXIS[Format.URDF] == default(Format.URDF, "joint/axis/@xyz")


@pytest.mark.parametrize("end", ["lower", "upper"])
def test_ranges(end: str) -> None:
    assert getattr(ir.RANGE[Format.SDF], end) == default(Format.SDF, f"joint/axis/limit/{end}")
    assert getattr(ir.RANGE[Format.URDF], end) == default(Format.URDF, f"joint/limit/@{end}")


def test_numbers_that_stand_for_infinity() -> None:
    assert default(Format.SDF, "joint/axis/limit/upper", OLDER) == ir.UNLIMITED
    assert default(Format.SDF, "joint/axis/limit/lower", OLDER) == -ir.UNLIMITED
    for strength in ("effort", "velocity"):
        assert default(Format.SDF, f"joint/axis/limit/{strength}", OLDER) == ir.UNLIMITED_STRENGTH


def test_couplings_of_joints() -> None:
    assert default(Format.SDF, "mimic/multiplier") == ir.MULTIPLIER
    assert default(Format.URDF, "joint/mimic/@multiplier") == ir.MULTIPLIER
    assert default(Format.SDF, "joint/gearbox_ratio") == ir.GEARBOX_RATIO
    assert default(Format.SDF, "joint/screw_thread_pitch") == ir.SCREW_THREAD_PITCH


def test_inertials() -> None:
    assert ir.MASS[Format.SDF] == ir.INERTIAL.mass == default(Format.SDF, "inertial/mass")
    assert ir.MASS[Format.URDF] == default(Format.URDF, "link/inertial/mass/@value")
    assert ir.INERTIAL.inertia
    for name, value in field_values(ir.INERTIAL.inertia).items():
        if name in {"ixx", "ixy", "ixz", "iyy", "iyz", "izz"}:
            assert value == default(Format.SDF, f"inertial/inertia/{name}")
    for name in ("ixx", "iyy", "izz"):
        assert ir.MOMENT[Format.SDF] == default(Format.SDF, f"inertial/inertia/{name}")
        assert ir.MOMENT[Format.URDF] == default(Format.URDF, f"link/inertial/inertia/@{name}")
    for holder in ("inertial", "collision"):
        assert default(Format.SDF, f"{holder}/density") == ir.DENSITY


@pytest.mark.parametrize(("holder", "values"), [("link", ir.BODY), ("forcetorque", ir.FORCE_TORQUE)])
def test_enumerations(holder: str, values: Mapping[str, object]) -> None:
    assert values == {name: default(Format.SDF, f"{holder}/{name}") for name in values}


@pytest.mark.parametrize("kind", ir.SIZES, ids=lambda kind: kind.__name__)
def test_sizes_of_shapes(kind: type[Node]) -> None:
    shape = f"{kind.__name__.lower()}_shape"
    names = [row.place for row in table("sdf").definitions[shape].rows]
    assert ir.SIZES[kind] == {name: default(Format.SDF, f"{shape}/{name}") for name in names}


def test_sizes_are_written_before_usual() -> None:
    assert ir.sizes(Cone()) == (1.0, 1.0)
    assert ir.sizes(Cone(length=3)) == (1.0, 3.0)
    assert ir.sizes(Box(size=(1, 2, 3))) == (1.0, 2.0, 3.0)


def test_what_is_written_counts() -> None:
    written = Limit(lower=-1.0, upper=0.0)
    assert ir.with_range(written, Format.SDF) is written
    assert ir.with_range(Limit(lower=-1.0), Format.URDF) == written
    assert ir.direction(Axis(xyz=(0, 1, 0)), Format.SDF) == (0, 1, 0)
    assert ir.direction(None, Format.URDF) == (1, 0, 0)
    assert ir.multiplier(Mimic(multiplier=0.0)) == 0.0
    assert ir.multiplier(None) == 1.0


def parameters() -> Iterator[str]:
    """The elements with the parameters of sensors."""
    rows = table("sdf").definitions["sensor"].children
    return (row.name for row in rows if row.reference and row.place is None and row.name != "frame")


def test_every_sensor_has_its_element() -> None:
    types = set(row_of(Format.SDF, "sensor/@type").enum)
    assert types - set(SENSOR_ELEMENTS) == {"custom", "ir"}
    assert set(SENSOR_ELEMENTS) <= types
    assert frozenset[str]().union(*SENSOR_ELEMENTS.values()) == set(parameters())


def test_gazebo_has_no_other_elements_for_them() -> None:
    for kind in sensors().values():
        for word in (kind.type, *kind.aliases, *kind.classic):
            assert kind.element in SENSOR_ELEMENTS.get(word, {kind.element})
            assert RENAMED_ELEMENTS.get(kind.element, kind.element) == kind.element


def test_renamed_elements_are_about_the_same_types() -> None:
    for pair in RENAMED_ELEMENTS.items():
        assert set(pair) in SENSOR_ELEMENTS.values()


def test_what_is_about_the_axis_of_a_joint_of_urdf() -> None:
    rows = [row for row in table("urdf").definitions["joint"].children if row.exists_in(parse_version("1.0"))]
    inside = {row.name for row in rows for each in (row, *row.rows) if (each.place or "").startswith("axis")}
    assert inside == OF_AN_AXIS
