"""Shapes and their materials."""

import pytest

from twinform.diagnostics import DiagnosticSink
from twinform.passes import Pipeline
from twinform.passes.legalise.to_urdf.sequence import to_urdf

from .models import BOX, convert, link, read, values_at, visual


@pytest.mark.parametrize(
    ("text", "path", "expected"),
    [
        # geometry
        (
            link(
                visual("<geometry><cylinder/></geometry>")
                + visual("<geometry><sphere><radius>2</radius></sphere></geometry>", "w")
            ),
            "//sphere/@radius",
            ["2"],
        ),
        (link(visual("<geometry><box><size>1 2 3</size></box></geometry>")), "//box/@size", ["1 2 3"]),
        (
            link(visual("<geometry><mesh><uri>model://m/a.dae</uri></mesh></geometry>")),
            "//mesh/@filename",
            ["package://m/a.dae"],
        ),
        (link(visual("<geometry><plane/></geometry>")), "//visual[not(ancestor::tf:sdf)]/@name", []),
        (
            link(visual("<geometry><plane><normal>0 0 1</normal></plane></geometry>")),
            "/robot/link/tf:sdf/visual/geometry/plane/normal/text()",
            ["0 0 1"],
        ),
        (
            link(visual("<geometry><mesh><uri>x</uri><submesh><name>s</name></submesh></mesh></geometry>")),
            "//tf:sdf//submesh/name/text()",
            ["s"],
        ),
        # materials
        (
            link(visual(BOX + "<material><diffuse>1 0 0 1</diffuse><ambient>1 0 0 1</ambient></material>")),
            "//color/@rgba",
            ["1 0 0 1"],
        ),
        (
            link(visual(BOX + "<material><diffuse>1 0 0 1</diffuse><ambient>1 0 0 1</ambient></material>")),
            "//visual/tf:*",
            [],
        ),
        (
            link(visual(BOX + "<material><diffuse>1 0 0</diffuse></material>")),
            "//color/@rgba | //tf:colors/@*",
            ["1 0 0 1", "", "1 0 0 1"],
        ),
        (
            link(visual(BOX + "<material><diffuse>2 -1 0.5 7</diffuse></material>")),
            "//color/@rgba | //tf:colors/@*",
            ["1 0 0.5 1", "", "2 -1 0.5 7", "1 0 0.5 1"],
        ),
        (
            link(visual(BOX + "<material><ambient>1.5 1 -0.5</ambient></material>")),
            "//color/@rgba | //tf:colors/@*",
            ["1 1 0 1", "1.5 1 -0.5", "", "1 1 0 1"],
        ),
        (
            link(visual(BOX + "<material><specular>1 0 0 1</specular></material>")),
            "//visual/tf:sdf//specular/text()",
            ["1 0 0 1"],
        ),
        (link(visual(BOX + "<material><diffuse>1 0 0 1</diffuse></material>")), "//material/@name", ["a_v_material"]),
        (
            link(visual(BOX + "<material><pbr><metal><albedo_map>model://t.png</albedo_map></metal></pbr></material>")),
            "//texture/@filename",
            ["package://t.png"],
        ),
        (
            link(visual(BOX + "<material><script><uri>u</uri><name>Gazebo/Red</name></script></material>")),
            "//gazebo/material/text()",
            ["Gazebo/Red"],
        ),
    ],
)
def test_a_part_of_sdf_is_expressed_in_urdf(text: str, path: str, expected: list[str]) -> None:
    assert values_at(convert(text), path) == expected


def test_a_capsule_is_three_shapes_in_urdf_1_0_and_one_in_1_1() -> None:
    capsule = "<geometry><capsule><radius>1</radius></capsule></geometry>"
    document, sink = read(link(visual(capsule))), DiagnosticSink()
    old = Pipeline(to_urdf()).run(document, sink)
    assert (old.version, len(old.models[0].links[0].visuals)) == (None, 3)
    new = Pipeline(to_urdf(urdf_version="1.1")).run(document, sink)
    assert new.version == "1.1"
    assert len(new.models[0].links[0].visuals) == 1
