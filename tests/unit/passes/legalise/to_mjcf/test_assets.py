"""Assets of MJCF that SDF says in part: height fields go as far down as in the file that they were read from."""

import pytest
from lxml import etree

import twinform

_TERRAIN = """
<mujoco>
  <asset><hfield name="hill" file="hill.png" size="0.5 0.5 0.5 0.1"/></asset>
  <worldbody><geom type="hfield" hfield="hill"/></worldbody>
</mujoco>
"""


def _size(sdf: str) -> str | None:
    (field,) = etree.fromstring(twinform.convert(sdf.encode(), to="mjcf").text.encode()).iter("hfield")
    return field.get("size")


@pytest.mark.parametrize(("height", "size"), [("0.5", "0.5 0.5 0.5 0.1"), ("0.4", "0.5 0.5 0.4 0.01")])
def test_a_height_field_keeps_its_depth_while_it_has_its_size(height: str, size: str) -> None:
    sdf = twinform.convert(_TERRAIN.encode(), to="sdf").text
    assert _size(sdf.replace("<size>1 1 0.5</size>", f"<size>1 1 {height}</size>")) == size
