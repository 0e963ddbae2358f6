"""What SDF had about shapes and fixed joints comes out of its carriers, whether the others may stay or not."""

from pathlib import Path

import twinform

_CASE = Path(__file__).parents[4] / "cases" / "convert" / "carriers_of_shapes.urdf"


def test_without_carriers_the_same_comes_out_and_the_others_go() -> None:
    made = twinform.convert(_CASE, to="sdf", carriers=False)
    (model,) = made.document.models
    left_open, as_it_was, edited = (visual.material for visual in model.links[0].visuals)
    assert left_open
    assert left_open.script
    assert left_open.script.name == "Paint/Green"
    assert as_it_was
    assert (as_it_was.ambient, as_it_was.diffuse) == ((0.1, 0.1, 0.1, 1.0), (0.7, 0.7, 0.7, 1.0))
    assert edited
    assert (edited.ambient, edited.specular, edited.emissive) == ((1.0, 0.0, 0.0, 1.0), (0.5, 0.5, 0.5, 1.0), None)
    (weld,) = model.joints
    assert weld.axis
    assert weld.axis.xyz == (0.0, 1.0, 0.0)
    assert "<tf:" not in made.text
