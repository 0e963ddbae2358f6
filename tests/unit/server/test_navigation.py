"""Names that are changed in all files: nothing but the names differs, and the model is the one that `rename` makes."""

import shutil
from pathlib import Path

import pytest
from lsprotocol import types

import twinform
from testbed.corpus.files import ROOT
from twinform.diagnostics import TextEdit
from twinform.passes.structure.rename_parts import RESERVED
from twinform.server.checking import no_settings
from twinform.server.document_names import names_of
from twinform.server.documents import TextDocument
from twinform.server.navigation import RenameRefusedError, rename
from twinform.server.session import Session
from twinform.text import apply

SESSION = Path(__file__).with_name("session")
KINDS = ("link", "joint", "frame")
EXAMPLES = ("rover.urdf", "gripper.urdf", "arm.urdf", "warehouse.sdf")


def opened(path: Path, text: str | None = None) -> tuple[Session, TextDocument]:
    session = Session(no_settings, lambda _: None)
    content = path.read_bytes().decode() if text is None else text
    return session, session.documents.follow(path.as_uri(), content, 1, "")


def renamed(session: Session, document: TextDocument, at: str, new: str) -> dict[str, str]:
    """The texts of all documents that change."""
    before, _, behind = at.partition("|")
    offset = document.text.index(before + behind) + len(before)
    edit = rename(session, document, offset, new)
    assert edit is not None
    assert edit.changes is not None
    texts: dict[str, str] = {}
    for uri, changes in edit.changes.items():
        other = session.documents.get(uri) or session.files.document(Path(uri.removeprefix("file://")))
        assert other is not None
        made = [TextEdit(other.positions.span(each.range), each.new_text) for each in changes]
        texts[other.path.name] = apply(other.text, made)
    return texts


@pytest.mark.slow
@pytest.mark.parametrize("name", EXAMPLES)
def test_every_name_can_be_changed_and_the_model_is_that_of_the_pass(name: str) -> None:
    path = ROOT / "examples" / name
    session, document = opened(path)
    checked = 0
    for each in names_of(document):
        in_world = each.scope is not None and each.scope.tag == "world"
        if not each.defines or each.kind not in KINDS or in_world or each.text in RESERVED:
            continue
        again = [other for other in names_of(document) if other.defines and other.text == each.text]
        if len(again) > 1:
            continue  # the pass renames all that are called so
        edit = rename(session, document, each.span.start, "another_name")
        assert edit is not None
        assert edit.changes is not None
        made = [TextEdit(document.positions.span(one.range), one.new_text) for one in edit.changes[document.uri]]
        text = apply(document.text, made)
        expected = twinform.convert(
            path, to=document.schema.format or "urdf", passes=f"rename{{names=[{each.text}:another_name]}}"
        )
        own = twinform.convert(text.encode(), to=document.schema.format or "urdf", name=str(path))
        assert own.text == expected.text, each.text
        checked += 1
    assert checked > 2


def test_all_else_stays_as_it_is_written(tmp_path: Path) -> None:
    shutil.copytree(SESSION, tmp_path, dirs_exist_ok=True)
    for name in ("wheel.xacro", "rover.urdf.xacro"):
        path = tmp_path / name
        path.write_bytes(
            path.read_bytes().replace(b"\n", b"\r\n").replace(b"<link", b"<!-- \xf0\x9f\xa4\x96 radius --><link")
        )
    session, document = opened(tmp_path / "wheel.xacro")
    found = renamed(session, document, 'property name="rad|ius"', "r")
    rover = (tmp_path / "rover.urdf.xacro").read_bytes().decode()
    assert found == {
        "wheel.xacro": document.text.replace('name="radius"', 'name="r"').replace("${radius}", "${r}"),
        "rover.urdf.xacro": rover.replace("2 * radius", "2 * r"),
    }


def test_a_file_in_utf_16_is_followed(tmp_path: Path) -> None:
    shutil.copytree(SESSION, tmp_path, dirs_exist_ok=True)
    path = tmp_path / "wheel.xacro"
    path.write_bytes(path.read_text(encoding="utf-8").encode("utf-16"))
    session, document = opened(tmp_path / "rover.urdf.xacro")
    found = renamed(session, document, "2 * rad|ius", "r")
    assert set(found) == {"wheel.xacro", "rover.urdf.xacro"}


def test_the_state_of_a_world_follows_its_models(tmp_path: Path) -> None:
    text = """<sdf version="1.11"><world name="w"><model name="a"><link name="b"/></model>
<state world_name="w"><model name="a"><link name="b"/></model></state></world></sdf>"""
    session, document = opened(tmp_path / "w.sdf", text)
    assert renamed(session, document, 'world name="w"><model name="a|"', "c")["w.sdf"] == text.replace('"a"', '"c"')
    assert renamed(session, document, 'link name="b|"', "c")["w.sdf"] == text.replace('"b"', '"c"')


REFUSED = {
    "a name that is taken": ("arm.urdf", 'link name="up|per"', "base", "is called 'base' already"),
    "no name": ("arm.urdf", 'link name="up|per"', "", "is not a valid name"),
    "a quote": ("arm.urdf", 'link name="up|per"', 'a"b', "is not a valid name"),
    "an expression": ("wheel.xacro", 'link name="${side}_wh|eel"', "a", "made by an expression"),
    "a macro that is no word": ("wheel.xacro", 'macro name="wh|eel"', "a-b", "not a valid name in xacro"),
    "an element of xacro": ("wheel.xacro", 'macro name="wh|eel"', "include", "an element of xacro"),
    "two colons in SDF": ("cart.sdf", 'link name="bo|dy"', "a::b", "nothing can be called"),
    "a word of SDF": ("cart.sdf", 'link name="bo|dy"', "world", "nothing can be called"),
    "a half file": ("half.urdf", 'link name="ti|p"', "end", "not well-formed"),
}


@pytest.mark.parametrize("case", REFUSED)
def test_what_does_not_fit_is_refused(case: str) -> None:
    name, at, new, message = REFUSED[case]
    session, document = opened(SESSION / name)
    with pytest.raises(RenameRefusedError, match=message):
        renamed(session, document, at, new)


def test_where_no_name_is_nothing_is_changed() -> None:
    session, document = opened(SESSION / "arm.urdf")
    assert rename(session, document, 0, "a") is None
    assert isinstance(rename(session, document, document.text.index('"upper"') + 2, "b"), types.WorkspaceEdit)


@pytest.mark.parametrize("by_link", [False, True])
def test_files_outside_of_the_workspace_are_not_changed(
    by_link: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    shutil.copytree(SESSION, tmp_path / "installed/wheels")
    (tmp_path / "installed/wheels/package.xml").write_text("<package><name>wheels</name></package>")
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path / "installed"))
    workspace = tmp_path / "workspace"
    workspace.mkdir()
    rover = (SESSION / "rover.urdf.xacro").read_text(encoding="utf-8")
    where = "linked/wheel.xacro" if by_link else "$(find wheels)/wheel.xacro"
    (workspace / "rover.urdf.xacro").write_text(rover.replace("wheel.xacro", where, 1))
    (workspace / "linked").symlink_to(tmp_path / "installed/wheels")
    session, document = opened(workspace / "rover.urdf.xacro")
    session.folders = [workspace]
    at = document.text.index("2 * radius") + 5
    with pytest.raises(RenameRefusedError, match=r"outside of the workspace|has to be known"):
        rename(session, document, at, "r")
    session.folders = [tmp_path]
    if not by_link:
        edit = rename(session, document, at, "r")
        assert edit is not None
        assert edit.changes is not None
        assert len(edit.changes) == 2
