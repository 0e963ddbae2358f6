"""Inlay hints and code lenses: what an editor shows in and above the lines."""

from pathlib import Path

import pytest
from lsprotocol import types

from twinform.diagnostics import Span
from twinform.server.checking import no_settings
from twinform.server.code_lens import SHOW_REFERENCES, lenses, resolve_lens
from twinform.server.documents import TextDocument
from twinform.server.editor_options import EditorOptions
from twinform.server.inlay_hints import inlay_hints
from twinform.server.session import Session

SPACE = 'xmlns:xacro="http://www.ros.org/wiki/xacro"'
HINTED = {
    '<robot><link><visual><origin xyz="1 2 3" rpy="0 0 1.5707963"«0° 0° 90°»/></visual></link></robot>': "r.urdf",
    '<robot><joint type="revolute"><limit lower="-1.5708"«-90°» upper="0"/></joint></robot>': "r.urdf",
    '<robot><joint type="prismatic"><limit lower="-1" upper="2"/></joint></robot>': "r.urdf",
    '<robot><link><visual><origin rpy="0 0 ${pi}"/><origin rpy="0 0 0"/></visual></link></robot>': "r.xacro",
    '<sdf version="1.9"><model><pose>0 0 1 0 3.1415927 0«0° 180° 0°»</pose></model></sdf>': "m.sdf",
    '<sdf version="1.9"><model><pose degrees="true">0 0 1 0 90 0</pose></model></sdf>': "m.sdf",
    '<sdf version="1.9"><model><joint type="revolute"><axis><limit><upper>1«57.3°»</upper></limit></axis></joint>'
    "</model></sdf>": "m.sdf",
    f'<robot {SPACE}><xacro:macro name="m" params="a b:=1 c:=${{2}} *d"/><xacro:m a="1"«b:=1 c:=${{2}}»/>'
    "</robot>": "r.xacro",
    f'<robot {SPACE}><xacro:macro name="m" params="a"/><xacro:m a="1"/></robot>': "r.xacro",
}


def opened(name: str, text: str) -> tuple[Session, TextDocument]:
    session = Session(no_settings, lambda _: None)
    return session, session.documents.follow(Path("/nowhere", name).as_uri(), text, 1, "")


@pytest.mark.parametrize("marked", HINTED)
def test_hints_stand_behind_what_they_are_about(marked: str) -> None:
    before, _, rest = marked.partition("«")
    label, _, behind = rest.partition("»")
    session, document = opened(HINTED[marked], before + behind)
    whole = document.positions.range(Span(0, len(document.text)))
    found = [(each.label, document.positions.offset(each.position)) for each in inlay_hints(session, document, whole)]
    assert found == ([(label, len(before))] if label else [])


def test_only_the_range_is_looked_at() -> None:
    session, document = opened(
        "r.urdf", '<robot>\n<origin rpy="0 0 1"/>\n<link><visual><origin rpy="0 0 1"/></visual></link></robot>'
    )
    line = types.Range(types.Position(0, 0), types.Position(1, 0))
    assert inlay_hints(session, document, line) == []


def test_a_lens_counts_the_references_of_a_name() -> None:
    joint = '<joint name="j"><parent link="a"/><child link="b"/></joint>'
    text = f'<robot name="r">\n<link name="a"/><link name="b"/>\n{joint}\n<gazebo reference="a"/></robot>'
    session, document = opened("r.urdf", text)
    titles: dict[str, str] = {}
    for lens in lenses(document):
        resolved = resolve_lens(session, lens)
        assert resolved.command is not None
        assert resolved.command.command == SHOW_REFERENCES
        titles[document.positions.span(lens.range).of(text)] = resolved.command.title
    assert titles == {"a": "2 references", "b": "1 reference", "j": "no references"}


def test_a_lens_of_a_document_that_was_closed_says_nothing() -> None:
    session, document = opened("r.urdf", '<robot name="r"><link name="a"/></robot>')
    (lens,) = lenses(document)
    session.documents.close(document.uri)
    assert resolve_lens(session, lens).command is None


@pytest.mark.parametrize(
    ("sent", "options"),
    [
        (None, EditorOptions()),
        ({"codeLens": False, "checkWorkspace": True}, EditorOptions(code_lens=False, check_workspace=True)),
        ({"codeLens": "no", "other": 1}, EditorOptions()),
        ([], EditorOptions()),
    ],
)
def test_options_are_taken_from_what_an_editor_sends(sent: object, options: EditorOptions) -> None:
    assert EditorOptions.of(sent) == options
