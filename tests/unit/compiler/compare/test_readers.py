"""What other readers get: the same as in files from which something else has taken the carriers."""

from pathlib import Path

import pytest
from lxml import etree

import twinform
from testbed.engines.readers.judging import without_carriers
from twinform import Comparison
from twinform.compiler.compare import Difference, DifferenceSeverity
from twinform.compiler.compare.part_reader import PartReader
from twinform.compiler.compare.readers import ComparingReader, reconcile
from twinform.ir import Document, Joint, Link, Model, World
from twinform.ir.transform import Transform

_CASES = Path(__file__).parents[3] / "cases/convert"
# The parts of a capsule are what the capsule is, for everybody: without their marks nothing says so.
_CAPSULES = "replaced_shapes"
_RESULTS = sorted(
    each
    for each in _CASES.glob("*.expected.*")
    if b"urn:twinform:1" in each.read_bytes() and not each.name.startswith(_CAPSULES)
)
_FOR_GAZEBO = ("link", "joint", "frame", "model")


def _source(result: Path) -> Path:
    name = result.name.partition(".")[0]
    return _CASES / f"{name}{'.urdf' if result.suffix == '.sdf' else '.sdf'}"


def _without_what_others_skip(path: Path, folder: Path) -> bytes:
    bare = without_carriers(path, folder / path.name)
    tree = etree.parse(bare)
    for extension in tree.findall("gazebo"):
        for body in [each for each in extension if each.tag in _FOR_GAZEBO and not extension.get("reference")]:
            extension.remove(body)
            if not len(extension):
                tree.getroot().remove(extension)
    return etree.tostring(tree)


def _seen(found: Comparison) -> set[tuple[str, str, str]]:
    return {(each.group, each.name, each.aspect) for each in found.counted if not each.message.endswith("this")}


@pytest.mark.parametrize("result", _RESULTS, ids=lambda path: path.name)
def test_what_others_see_is_what_is_left_without_carriers(result: Path, tmp_path: Path):
    files = _source(result), result
    others = twinform.diff(*(_without_what_others_skip(each, tmp_path) for each in files), carriers=True)
    assert _seen(twinform.diff(*files)) == _seen(others)


def _item(aspect: str, severity: DifferenceSeverity = DifferenceSeverity.DIFFERENCE) -> Difference:
    return Difference(severity=severity, group="link", name="a", aspect=aspect, message=f"{aspect} differs")


def test_what_only_some_readers_find_is_carried():
    found = reconcile(
        [_item("mass"), _item("pose")], [_item("mass"), _item("inertia")], ComparingReader.TWINFORM, ("a", "b")
    )
    assert [(each.aspect, str(each.severity), each.reader, each.message) for each in found] == [
        ("mass", "difference", "", "mass differs"),
        ("pose", "carried", "twinform", "pose differs: only twinform reads them as the same"),
        ("inertia", "carried", "twinform", "inertia differs: only twinform reads this"),
    ]


def test_what_gazebo_alone_sees_stays_carried_for_it():
    before = reconcile([_item("mass")], [], ComparingReader.GAZEBO, ("a", "b"))
    assert reconcile(before, [], ComparingReader.TWINFORM, ("a", "b")) == before


def test_notes_of_the_other_readers_stay():
    notes = [_item("frame", DifferenceSeverity.NOTE)]
    assert reconcile(notes, [_item("name", DifferenceSeverity.NOTE)], ComparingReader.TWINFORM, ("a", "b")) == notes


def test_what_readers_see_alike_is_read_once(monkeypatch: pytest.MonkeyPatch):
    solid = '<mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/>'
    links = "".join(f'<link name="l{i}"><inertial>{solid}</inertial></link>' for i in range(40))
    joint = '<joint name="j{1}" type="fixed"><parent link="l{0}"/><child link="l{1}"/><origin xyz="0 0 1"/></joint>'
    text = f'<robot name="r">{links}{"".join(joint.format(i, i + 1) for i in range(39))}</robot>'.encode()
    made = twinform.convert(text, to="sdf").text.encode()
    assert b"urn:twinform:1" in made
    nodes: list[Link | Joint | Model | World | Document] = []
    read = PartReader.parts

    def parts(self: PartReader, node: Link | Joint | Model | World | Document, frame: Transform):
        nodes.append(node)
        return read(self, node, frame)

    monkeypatch.setattr(PartReader, "parts", parts)
    assert twinform.diff(text, made, carriers=True).same
    once = len(nodes)
    assert twinform.diff(text, made).same
    assert len(nodes) - once <= 1.15 * once
