"""Documents in memory go where files go: into `check`, `convert` and `diff`, and out by `dump` and `dumps`."""

import json
from pathlib import Path
from typing import Any

import pytest

import twinform
from testbed.corpus.files import ROOT
from twinform.compiler import CompileError
from twinform.ir import Document, Format, Limit, Model, Opaque, Pose

URDF = """<robot name="r">
  <link name="a"/>
  <joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint>
  <link name="b"/>
</robot>
"""
SDF = """<sdf version="1.11">
<world name="w">
<model name="m">
<static>1</static><link name="l"/>
</model>
</world></sdf>"""


def _changed(document: Document, **update: Any) -> Document:
    model = document.models[0].copy(**update)
    return document.copy(models=(model, *document.models[1:]))


def _links(document: Document, **update: Any) -> Document:
    first, *others = document.models[0].links
    return _changed(document, links=(first.copy(**update), *others))


@pytest.mark.parametrize("text", [URDF, SDF])
def test_a_document_is_converted_as_its_file(text: str) -> None:
    document = twinform.loads(text)
    for to in ("urdf", "sdf", "json"):
        one, other = twinform.convert(document, to=to), twinform.convert(text.encode(), to=to)
        assert one.text == other.text
        assert one.document == other.document
        assert [(each.rule, each.location.line) for each in one.diagnostics] == [
            (each.rule, each.location.line) for each in other.diagnostics
        ]
        assert one.ledger.expressed == other.ledger.expressed
        assert [each.message for each in one.ledger.entries] == [each.message for each in other.ledger.entries]


def test_findings_name_the_file_that_a_document_came_from(tmp_path: Path) -> None:
    file = tmp_path / "r.urdf"
    file.write_text(URDF)
    document = twinform.load(file)
    twice = _changed(document, links=(*document.models[0].links, document.models[0].links[0]))
    found = [each for each in twinform.check(twice).diagnostics if each.rule.name == "duplicate-name"]
    assert [(each.location.file, each.location.line) for each in found] == [(str(file), 2)]
    assert twinform.check(document).path == str(file)


def test_a_document_that_was_made_has_no_file() -> None:
    made = Document(format=Format.URDF, models=(Model(name="r"),))
    checked = twinform.check(made)
    assert checked.path == "<document>"
    assert not checked.accepted


def test_documents_and_files_are_compared() -> None:
    document = twinform.loads(URDF)
    assert twinform.diff(document, URDF.encode()).differences == ()
    other = _changed(document, joints=())
    found = twinform.diff(document, _changed(document, joints=(), links=document.models[0].links[:1]))
    assert found.differences
    assert (found.a, found.b) == ("<string>", "<string>")
    with pytest.raises(CompileError):  # two roots
        twinform.diff(document, other)


UNSAYABLE: dict[str, tuple[Document, str]] = {
    "no robot": (
        Document(format=Format.URDF),
        "models: has 0 items; expected 1",
    ),
    "two robots": (
        Document(format=Format.URDF, models=(twinform.loads(URDF).models[0],) * 2),
        "models: has 2 items; expected 1",
    ),
    "a robot in a robot": (
        _changed(twinform.loads(URDF), models=twinform.loads(URDF).models),
        "models/0/models: URDF cannot express ",
    ),
    "a field that URDF does not have": (
        _links(twinform.loads(URDF), gravity=False),
        "models/0/links/0/gravity: URDF cannot express false; a file in that format leaves it out",
    ),
    "a pose of a link in URDF": (
        _links(twinform.loads(URDF), pose=Pose(xyz=(1, 0, 0))),
        'models/0/links/0/pose: URDF cannot express {"xyz": [1.0, 0.0, 0.0]}; a file in that format leaves it out',
    ),
    "no number in a vector": (
        _changed(twinform.loads('<sdf version="1.11"><model name="m"><link name="l"/></model></sdf>'),
                 pose=Pose(xyz=(float("nan"), 0, 0), rpy=(0, 0, 0))),
        "<pose> is 'nan 0 0 0 0 0'; expected six numbers, ",
    ),
    "a name that XML does not have": (
        _links(twinform.loads(URDF), name="\x00"),
        'models/0/links/0/name: is "\\u0000", which XML cannot hold here',
    ),
    "an attribute that has a field": (
        _links(twinform.loads(URDF), opaque=(Opaque(attribute=("name", "c")),)),
        "",
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", UNSAYABLE)
def test_what_its_format_cannot_express_is_an_error(name: str) -> None:
    document, message = UNSAYABLE[name]
    checked = twinform.check(document)
    assert not checked.accepted
    if message:
        assert any(each.message.startswith(message) for each in checked.diagnostics if each.is_error)
    for to in ("urdf", "sdf", "json"):
        with pytest.raises(CompileError):
            twinform.convert(document, to=to)
    with pytest.raises(CompileError):
        twinform.dumps(document)
    with pytest.raises(CompileError):
        twinform.dumps(document, to="json")


def test_an_empty_node_is_nothing() -> None:
    document = twinform.loads('<sdf version="1.11"><model name="m"><link name="l"/></model></sdf>')
    axis = {"limit": Limit()}
    assert twinform.check(_changed(document, pose=Pose())).accepted
    assert axis["limit"].lower is None


def test_documents_are_dumped_and_loaded(tmp_path: Path) -> None:
    document = twinform.loads(URDF)
    assert twinform.dumps(document) == twinform.convert(URDF.encode(), to="urdf").text
    assert json.loads(twinform.dumps(document, to="json"))["format"] == "urdf"
    for name in ("r.urdf", "r.json", "folder/r", "r.xml"):
        twinform.dump(document, tmp_path / name)
        assert twinform.load(tmp_path / name) == document
    assert (tmp_path / "r.json").read_text().startswith("{")
    with pytest.raises(ValueError, match="is URDF"):
        twinform.dump(document, tmp_path / "r.sdf")
    with pytest.raises(ValueError, match="is URDF"):
        twinform.dumps(document, to="sdf")
    assert not (tmp_path / "r.sdf").exists()


def test_what_cannot_be_dumped_leaves_the_file_alone(tmp_path: Path) -> None:
    file = tmp_path / "r.urdf"
    file.write_text(URDF)
    with pytest.raises(CompileError):
        twinform.dump(UNSAYABLE["two robots"][0], file)
    assert file.read_text() == URDF


@pytest.mark.parametrize("name", ["rover", "gripper", "standard_robot"])
def test_a_result_is_a_document_of_its_format(name: str) -> None:
    """Their origins lack `rpy` in places, for which SDF has no way of writing."""
    source = ROOT / f"examples/{name}.urdf"
    result = twinform.convert(source, to="sdf")
    assert twinform.diff(source, result.document).same
    assert twinform.dumps(result.document).startswith("<?xml")


def test_a_pose_may_lack_a_part_and_not_what_is_in_it() -> None:
    document = twinform.loads(SDF.replace('name="l"/>', 'name="l"><pose>1 0 0 0 0 2</pose></link>'))
    world = document.worlds[0]
    (model,) = world.models

    def posed(pose: Pose) -> Document:
        link = model.links[0].copy(pose=pose)
        return document.copy(worlds=(world.copy(models=(model.copy(links=(link,)),)),))

    for pose in (Pose(xyz=(1, 0, 0)), Pose(rpy=(0, 0, 2))):
        again = twinform.loads(twinform.dumps(posed(pose))).worlds[0].models[0].links[0].pose
        assert again is not None
        assert (again.xyz, again.rpy) == (pose.xyz or (0, 0, 0), pose.rpy or (0, 0, 0))
