"""The table of references: nothing is missing in it, and who follows or judges references goes by it."""

import re
from collections.abc import Callable

import pytest
from hypothesis import given

from twinform.compiler import check
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Document, Node, ReferenceKind, map_references, walk
from twinform.ir.record import field_values, fields_of
from twinform.ir.references import REFERENCES
from twinform.ir.verify import verify
from twinform.testing import strategies

from .kinds import kinds

NOT_IN_SCOPE = {"Include.placement_frame"}
"""Names what is in another file."""
NO_REFERENCES = {
    "Collision.name", "Frame.name", "Include.name", "Joint.name", "Light.name", "Link.name", "Model.name",
    "Plugin.name", "Sensor.name", "Visual.name", "World.name",
    "Document.version", "Document.namespaces", "Light.type", "Mimic.axis", "Pose.rotation_format", "Sensor.type",
    "Heightmap.uri", "Image.uri", "Include.uri", "Material.albedo_map", "Material.texture", "Mesh.uri",
    "Plugin.filename", "Plugin.text", "Script.name", "Script.uris", "Sensor.topic",
}  # fmt: skip
"""Names of a node itself, values of a fixed list, and files, topics and texts, which name nothing in the document."""


def test_every_text_of_the_ir_is_known_to_be_a_reference_or_none() -> None:
    texts = {
        f"{kind.__name__}.{name}"
        for kind in kinds(Node)
        for name, field in fields_of(kind).items()
        if field.compare and re.search(r"\bstr\b", str(field.type))
    }
    references = {f"{kind.__name__}.{name}" for kind, names in REFERENCES.items() for name in names}
    assert references.isdisjoint(NO_REFERENCES)
    assert texts == references | NO_REFERENCES | NOT_IN_SCOPE


def _same(kind: ReferenceKind, name: str) -> str:
    del kind
    return name


def _prefixed(kind: ReferenceKind, name: str) -> str:
    return f"{kind}-{name}"


@given(strategies.robots())
def test_where_no_name_changes_the_node_is_the_same(robot: Document) -> None:
    (model,) = robot.models
    assert map_references(model, _same, robot.format) is model


@given(strategies.robots())
def test_every_reference_of_a_robot_is_changed_and_nothing_else(robot: Document) -> None:
    (model,) = robot.models
    changed = map_references(model, _prefixed, robot.format)
    for old, new in zip(walk(model), walk(changed), strict=True):
        for name, value in field_values(old).items():
            if isinstance(value, str):
                follows = bool(value) and name in REFERENCES.get(type(old), {}) and old is not model.pose
                assert getattr(new, name).endswith(f"-{value}") == follows


LINK = """<link name="a"><pose relative_to="a"/>
<inertial><mass>1</mass></inertial>
<visual name="v"><pose relative_to="a"/><geometry><sphere><radius>1</radius></sphere></geometry></visual>
<collision name="c"><pose relative_to="a"/><geometry><sphere><radius>1</radius></sphere></geometry></collision>
<sensor name="s" type="imu"><pose relative_to="a"/><frame_id>a</frame_id></sensor>
<light name="l" type="point"><pose relative_to="a"/></light></link><link name="b"/>"""
JOINT = """<joint name="j" type="gearbox"><pose relative_to="a"/><parent>a</parent><child>b</child>
<gearbox_ratio>2</gearbox_ratio><gearbox_reference_body>a</gearbox_reference_body>
<axis><xyz expressed_in="a">0 0 1</xyz><mimic joint="k"/></axis><axis2><xyz expressed_in="a">0 0 1</xyz></axis2></joint>
<joint name="k" type="revolute"><parent>a</parent><child>c</child><axis><xyz>0 0 1</xyz></axis></joint>"""
INNER = """<link name="c"/><frame name="f" attached_to="a"><pose relative_to="a"/></frame>
<model name="m"><pose relative_to="a"/><link name="inside"/></model>"""
SDF = f"""<sdf version="1.12"><world name="w">
<frame name="a"><pose relative_to="world"/></frame><frame name="f" attached_to="a"><pose relative_to="a"/></frame>
<light name="l" type="point"><pose relative_to="a"/></light>
<include><uri>model://i</uri><name>i</name><pose relative_to="a"/></include>
<model name="m" canonical_link="a" placement_frame="a"><pose relative_to="a"/>{LINK}{JOINT}{INNER}</model>
</world></sdf>"""
NOWHERE = "nowhere"


class _Breaker:
    """Makes one reference after another lead nowhere; a frame of ROS may be that of another program."""

    def __init__(self, broken: int) -> None:
        self.broken, self.count = broken, 0

    def change(self, kind: ReferenceKind, name: str) -> str:
        self.count += kind != "frame"
        return NOWHERE if kind != "frame" and self.count == self.broken else name


def _of_world(document: Document, breaker: _Breaker) -> Document:
    (world,) = document.worlds
    return document.copy(worlds=(map_references(world, breaker.change),))


def _of_model(document: Document, breaker: _Breaker) -> Document:
    (world,) = document.worlds
    models = tuple(map_references(model, breaker.change) for model in world.models)
    return document.copy(worlds=(world.copy(models=models),))


@pytest.mark.parametrize(("change", "count"), [(_of_world, 6), (_of_model, 19)])
def test_a_reference_of_sdf_that_leads_nowhere_is_reported(
    change: Callable[[Document, _Breaker], Document], count: int
) -> None:
    document = check(SDF.encode()).document
    assert document is not None
    counter = _Breaker(0)
    assert change(document, counter) == document
    assert counter.count == count
    for number in range(1, count + 1):
        sink = DiagnosticSink()
        verify(change(document, _Breaker(number)), sink)
        assert NOWHERE in {each.found for each in sink.diagnostics}, f"reference {number}"
