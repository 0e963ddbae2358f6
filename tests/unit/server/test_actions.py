"""Fixes and passes as an editor offers them."""

from pathlib import Path

from lsprotocol import types

from tests.unit.server.test_half_typed import session_with
from twinform.diagnostics import Diagnostic, Fix, Location, Safety, Severity, Span, TextEdit, rules
from twinform.server.actions import FIX_ALL, actions, compatible_edits, edit_of
from twinform.server.checking import CheckJob, EditorSettings, check, format_document, no_settings, run_passes
from twinform.server.documents import TextDocument
from twinform.server.session import Session
from twinform.text import apply

TEXT = '<robot name="a">\r\n  <link nam="b" name="é"/>\r\n  <link nam="c" name="d"/>\r\n</robot>\r\n'
START = types.Range(types.Position(1, 8), types.Position(1, 8))


def finding(text: str, start: int, safety: Safety) -> Diagnostic:
    span = Span(start, start + len(' nam="b"'))
    fix = Fix("delete the attribute 'nam'", (TextEdit(span, ""),), safety)
    line = text.count("\n", 0, start) + 1
    where = Location("", line, "/robot/link/@nam", start - text.rfind("\n", 0, start) + 1)
    return Diagnostic(rules.UNKNOWN_ATTRIBUTE, "no", where, Severity.WARNING, fix=fix)


def offered(safety: Safety, text: str = TEXT) -> tuple[Session, TextDocument]:
    session, document = session_with("a.urdf", text)
    first = text.index(" nam=")
    found = (finding(text, first, safety), finding(text, text.index(" nam=", first + 1), safety))
    session.found[document.uri] = (document, found)
    return session, document


def after(document: TextDocument, edit: types.WorkspaceEdit | None) -> str:
    assert edit is not None
    assert edit.changes is not None
    made = [TextEdit(document.positions.span(each.range), each.new_text) for each in edit.changes[document.uri]]
    return apply(document.text, made)


def test_a_fix_of_a_finding_is_offered_where_it_is() -> None:
    session, document = offered(Safety.SAFE)
    (action,) = actions(session, document, START, ["quickfix"])
    assert (action.title, action.is_preferred) == ("delete the attribute 'nam'", True)
    assert after(document, action.edit) == TEXT.replace(' nam="b"', "")
    assert actions(session, document, types.Range(types.Position(0, 0), types.Position(0, 3)), ["quickfix"]) == []


def test_a_fix_that_is_not_safe_says_so_and_one_for_display_is_not_made() -> None:
    session, document = offered(Safety.UNSAFE)
    (action,) = actions(session, document, START, ["quickfix"])
    assert (action.title, action.is_preferred) == ("delete the attribute 'nam' (the model may change)", False)
    assert actions(session, document, START, ["source.fixAll"]) == []
    assert actions(*offered(Safety.DISPLAY), START, ["quickfix"]) == []


def test_all_safe_problems_are_fixed_at_once() -> None:
    session, document = offered(Safety.SAFE)
    (action,) = actions(session, document, START, ["source.fixAll"])
    assert action.kind == FIX_ALL
    assert after(document, action.edit) == TEXT.replace(' nam="b"', "").replace(' nam="c"', "")
    assert action.kind not in {each.kind for each in actions(session, document, START, None)}


def test_findings_of_an_older_text_offer_nothing() -> None:
    session, document = offered(Safety.SAFE)
    later = session.documents.follow(document.uri, TEXT + " ", 2, "urdf")
    assert actions(session, later, START, ["quickfix", "source"]) == []


def test_of_fixes_that_meet_the_later_waits() -> None:
    def fix(*spans: tuple[int, int]) -> Fix:
        return Fix("", tuple(TextEdit(Span(*span), "x") for span in spans))

    made = compatible_edits([fix((0, 2), (8, 9)), fix((1, 3)), fix((8, 8)), fix((4, 4)), fix((4, 4))])
    assert [edit.span for edit in made] == [(0, 2), (4, 4), (8, 8), (8, 9)]


def test_a_byte_order_mark_moves_the_edits() -> None:
    _, document = session_with("a.urdf", "\ufeff<robot/>")
    edit = edit_of(document, [TextEdit(Span(1, 6), "sdf")])
    assert after(document, edit) == "\ufeff<sdf/>"


def job(path: Path, text: str | None = None) -> CheckJob:
    return CheckJob(path, {} if text is None else {str(path.resolve()): text.encode()}, EditorSettings())


MACROS = """<robot xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:macro name="part" params="name"><link name="${name}"><inertial/></link></xacro:macro>
</robot>
"""
CALLS = """<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:include filename="macros.xacro"/>
  <link name="base"><visual><geometry><box size="1,1,1"/></geometry></visual></link>
  <xacro:part name="a"/>
</robot>
"""


def test_fixes_of_xacro_are_offered_in_the_file_where_the_text_stands(tmp_path: Path) -> None:
    (tmp_path / "macros.xacro").write_text(MACROS)
    (tmp_path / "r.urdf.xacro").write_text(CALLS)
    session = Session(no_settings, lambda _: None)
    top, macros = (
        session.documents.follow((tmp_path / name).as_uri(), (tmp_path / name).read_text(), 1, "urdf")
        for name in ("r.urdf.xacro", "macros.xacro")
    )
    wrong = MACROS.replace("inertial", "inertal")
    macros = session.documents.follow(macros.uri, wrong, 2, "urdf")
    found = check(CheckJob(top.path, {str(macros.path.resolve()): wrong.encode()}, EditorSettings()))
    session.found[top.uri] = (top, found.diagnostics)
    (fix,) = actions(session, top, range_of(top, "1,1,1"), ["quickfix"])
    assert after(top, fix.edit) == CALLS.replace("1,1,1", "1 1 1")
    (fix,) = actions(session, macros, range_of(macros, "inertal"), ["quickfix"])
    assert after(macros, fix.edit) == wrong.replace("inertal", "inertial")
    assert actions(session, top, range_of(top, "include"), ["quickfix"]) == []


def range_of(document: TextDocument, word: str) -> types.Range:
    start = document.text.index(word)
    return document.positions.range(Span(start, start))


def test_passes_change_the_text_of_the_editor_and_nothing_else(tmp_path: Path) -> None:
    path = tmp_path / "a.urdf"
    text = '<robot name="a">\r\n <!-- é🤖 -->\r\n <link   name="b"/>\r\n</robot>\r\n'
    path.write_text("something else")
    done = run_passes(job(path, text), "rename{names=[b:c]}")
    assert not done.problem
    assert apply(text, done.edits) == text.replace('"b"', '"c"')
    assert path.read_text() == "something else"


def test_what_passes_cannot_do_is_told(tmp_path: Path) -> None:
    path = tmp_path / "a.urdf"
    text = '<robot name="a"><link name="b"/></robot>'
    assert "nothing is called" in run_passes(job(path, text), "rename{names=[x:y]}").problem
    assert "no pass" in run_passes(job(path, text), "nonsense").problem.lower()
    assert "read" in run_passes(job(path, "<robot"), "fill-inertia").problem


def test_the_formatter_makes_one_edit_of_what_differs(tmp_path: Path) -> None:
    path = tmp_path / "a.urdf"
    text = '<robot name="a">\n      <link name="b"/>\n</robot>\n'
    done = format_document(job(path, text))
    assert apply(text, done.edits) == '<robot name="a">\n  <link name="b"/>\n</robot>\n'
    assert format_document(job(path, apply(text, done.edits))).edits == ()
    assert format_document(job(path, "<robot>")).problem


def test_a_check_reads_the_texts_of_the_editor(tmp_path: Path) -> None:
    path = tmp_path / "a.urdf"
    text = '<robot name="a"><link name="b"/><joint/></robot>'
    found = check(job(path, text))
    assert {each.rule.name for each in found.diagnostics} >= {"missing-attribute"}
    assert all(each.location.column for each in found.diagnostics)
    assert str(path) in found.files
    nowhere = check(job(path))
    assert [each.rule.name for each in nowhere.diagnostics] == ["unreadable-file"]
