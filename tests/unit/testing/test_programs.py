"""What a C++ program is made of: its source, and the headers that it includes, wherever they are."""

from pathlib import Path

import pytest

from twinform.testing.oracles.libsdformat import sources

ORACLES = Path(__file__).parents[3] / "twinform" / "testing" / "oracles"


def test_headers_of_headers_belong_to_a_program_once(tmp_path: Path):
    shared = tmp_path / "shared"
    shared.mkdir()
    (tmp_path / "own").mkdir()
    source = tmp_path / "own" / "run.cpp"
    source.write_text('#include <vector>\n#include "../shared/a.hh"\n  #  include "own.hh"\n// #include "not.hh"\n')
    (tmp_path / "own" / "own.hh").write_text('#include "../shared/a.hh"\n')
    (shared / "a.hh").write_text('#include "b.hh"\n')
    (shared / "b.hh").write_text('#include "a.hh"\n')
    assert [path.name for path in sources(source)] == ["run.cpp", "a.hh", "b.hh", "own.hh"]


@pytest.mark.parametrize("program", sorted(ORACLES.glob("*.cpp")), ids=lambda path: path.stem)
def test_every_program_of_the_oracles_shares_what_it_can(program: Path):
    found, text = {path.name for path in sources(program)}, program.read_text(encoding="utf-8")
    assert "json.hh" in found
    assert ("loading.hh" in found) == ("sdf::SDFPtr" in text), "the description of the format is read once"
    assert "child.hh" in found or "fork(" not in text, "child.hh limits what a child may take"
