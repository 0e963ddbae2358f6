"""Which model of a file is meant."""

from pathlib import Path

import twinform

_WORLD = """<sdf version="1.9"><world name="w">
  <include><uri>model://crate</uri></include>
  <include><uri>model://nowhere</uri></include>
</world></sdf>"""


def test_an_include_without_a_name_is_chosen_by_its_uri(tmp_path: Path) -> None:
    (tmp_path / "crate").mkdir()
    (tmp_path / "crate/model.config").write_text("<model><sdf version='1.9'>model.sdf</sdf></model>")
    (tmp_path / "crate/model.sdf").write_text("<sdf version='1.9'><model name='box'><link name='a'/></model></sdf>")
    (tmp_path / "w.sdf").write_text(_WORLD)
    made = twinform.convert(tmp_path / "w.sdf", to="urdf", model="w::model://crate", paths=[tmp_path])
    assert made.document.models[0].name == "box"
