"""Files with numbers at the ends of what doubles hold: a result, or a finding, and never a traceback."""

import math
import re
from contextlib import suppress

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

import twinform
from tests.exact import MAGNITUDES, NUMBERS
from tests.profile import examples
from twinform.ir.solids import Symmetric, relative_moments
from twinform.passes.inertia.physical_consistency import nearest_possible

ROBOT = """\
<robot name="r">
  <link name="a">
    <inertial><origin xyz="{}"/><mass value="{}"/>
      <inertia ixx="{}" iyy="{}" izz="{}" ixy="{}" ixz="{}" iyz="{}"/></inertial>
    <collision><origin xyz="{}"/><geometry><box size="{}"/></geometry></collision>
  </link>
  <link name="b">
    <inertial><mass value="{}"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
  </link>
  <joint name="j" type="fixed"><parent link="a"/><child link="b"/><origin xyz="{}"/></joint>
</robot>
"""
MODEL = """\
<sdf version="1.11"><model name="m">
  <link name="a">
    <inertial><pose>{} 0 0 0</pose><mass>{}</mass>
      <inertia><ixx>{}</ixx><iyy>{}</iyy><izz>{}</izz><ixy>{}</ixy><ixz>{}</ixz><iyz>{}</iyz></inertia></inertial>
    <collision name="c"><pose>{} 0 0 0</pose><geometry><box><size>{}</size></box></geometry></collision>
  </link>
  <link name="b"><pose relative_to="j"/><inertial><mass>{}</mass></inertial></link>
  <joint name="j" type="fixed"><parent>a</parent><child>b</child><pose relative_to="a">{} 0 0 0</pose></joint>
</model></sdf>
"""
PASSES = ["", "check-inertia", "balance-inertia", "fill-inertia{replace=all}", "lump-fixed-joints", "split-massless"]
_WORD = re.compile(r"(?<![\w.])[+-]?(inf|nan)(?![\w.])", re.IGNORECASE)


def row(numbers: tuple[float, ...]) -> str:
    return " ".join(map(repr, numbers))


VECTORS = st.tuples(NUMBERS, NUMBERS, NUMBERS).map(row)
SIZES = st.tuples(*[MAGNITUDES] * 3).map(row)
ROBOTS = st.tuples(VECTORS, MAGNITUDES, *[NUMBERS] * 6, VECTORS, SIZES, MAGNITUDES, VECTORS)
HEAVY = ("0 0 0", 1.7e308, *[0.0] * 6, "0 0 0", "0.5 1e-10 4.0", 5e-324, "0 0 0")
FAR = ("0 0 0", 0.5, *[0.0] * 5, 0.5, "0 0 0", "0.5 0.5 0.5", 0.5, "0 0 2.7e154")
OUT_OF_REACH = ("0 0 1.3e95", 1e150, *[0.0] * 5, 0.5, "0 0 0", "0.5 0.5 5e-324", 5e-324, "0 0 0")
HUGE = ("0 0 0", 1.0, 1e150, 1e150, 1e150, 0.0, 0.0, 0.0, "0 0 0", "1e200 1 1", 1e308, "1e308 1e308 0")


@pytest.mark.parametrize("source", [ROBOT, MODEL], ids=["urdf", "sdf"])
@pytest.mark.parametrize("passes", PASSES)
@examples(0.3)
@example(numbers=FAR)
@example(numbers=HUGE)
@example(numbers=HEAVY)
@example(numbers=OUT_OF_REACH)
@given(numbers=ROBOTS)
def test_every_pass_over_inertias_ends_with_numbers_or_findings(source: str, passes: str, numbers: tuple[object, ...]):
    text = source.format(*numbers)
    for target in ("urdf", "sdf"):
        with suppress(twinform.CompileError):
            made = twinform.convert(text.encode(), to=target, passes=passes).text
            assert not _WORD.search(made), made


MATRICES = st.tuples(*[st.floats(-1, 1)] * 6)


@examples()
@given(matrix=MATRICES, floor=st.floats(1e-9, 1), power=st.integers(-900, 900))
def test_the_nearest_inertia_is_the_same_in_every_unit(matrix: Symmetric, floor: float, power: int):
    small = [0.0 if abs(each) < 1e-30 else each for each in matrix]
    one = nearest_possible((small[0], small[1], small[2], small[3], small[4], small[5]), floor)
    grown = [math.ldexp(each, power) for each in small]
    other = nearest_possible((grown[0], grown[1], grown[2], grown[3], grown[4], grown[5]), math.ldexp(floor, power))
    assert [math.ldexp(each, -power) for each in other] == list(one)


@examples()
@example(matrix=(0.0, -6575004066826970.0, 0.0, 0.0, 6575004066826970.0, 0.0), floor=5e-324)
@given(matrix=st.tuples(*[NUMBERS] * 6), floor=MAGNITUDES)
def test_the_nearest_inertia_is_one_that_a_body_can_have_or_too_large(matrix: Symmetric, floor: float):
    found = nearest_possible(matrix, floor)
    if all(map(math.isfinite, found)):
        smallest, middle, largest = relative_moments(found)
        assert smallest >= -1e-14 * largest
        assert largest - smallest - middle <= 1e-14 * largest
