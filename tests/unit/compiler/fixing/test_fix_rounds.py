"""Applying fixes: rounds, overlaps, and what is taken back."""

import codecs
from dataclasses import replace

import pytest

from twinform.compiler import LoadOptions, LoadResult, inspect, read
from twinform.compiler.fixing import Texts, apply_fixes, apply_fixes_by
from twinform.compiler.fixing.fix_rounds import MOST_ROUNDS
from twinform.diagnostics import Diagnostic, Fix, Location, Rule, Safety, Severity, Span, TextEdit

LATE = """<!-- a\u00f6 -- b -->\r
<?xml version="1.0"?>\r
<robot name="r">\r
\t<link name='base'/>\r
\t<link name='tip'/>\r
\t<joint name="j" type='Fixed'>\r
\t\t<parent link="base"/><child link="tip"/>\r
\t\t<origin xyz="0, 0, 1"/> <!-- up -->\r
\t</joint>\r
</robot>"""
FIXED = """<?xml version="1.0"?>\r
<!-- a\u00f6 - - b -->\r
<robot name="r">\r
\t<link name='base'/>\r
\t<link name='tip'/>\r
\t<joint name="j" type='fixed'>\r
\t\t<parent link="base"/><child link="tip"/>\r
\t\t<origin xyz="0 0 1"/> <!-- up -->\r
\t</joint>\r
</robot>"""


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16-le", "utf-16-be"])
def test_encoding_mark_and_line_ends_stay(encoding: str) -> None:
    mark = {"utf-16-le": codecs.BOM_UTF16_LE, "utf-16-be": codecs.BOM_UTF16_BE}.get(encoding, b"")
    assert apply_fixes(mark + LATE.encode(encoding), LoadOptions()).data == mark + FIXED.encode(encoding)


def test_a_late_declaration_of_another_encoding_never_counts() -> None:
    text = "\n<?xml version='1.0' encoding='ISO-8859-1'?>\n<robot name='\u00f6'><link name='a'/></robot>"
    made = apply_fixes(text.encode(), LoadOptions()).data.decode()
    assert made == "\n<robot name='\u00f6'><link name='a'/></robot>"


def test_only_these_rules_are_fixed() -> None:
    fixed = apply_fixes(LATE.encode(), LoadOptions(), rules={"invalid-value"})
    assert {each.rule.name for each in fixed.applied} == {"invalid-value"}
    assert fixed.data.decode().startswith("<!-- a\u00f6 -- b -->")


def test_a_guess_is_made_only_if_asked_for() -> None:
    text = b"<robot name='r'><link name='base'/><link name='tip'/><joint name='j' type='fixed'>"
    text += b"<parent link='bsae'/><child link='tip'/></joint></robot>"
    assert apply_fixes(text, LoadOptions()).data == text
    assert apply_fixes(text, LoadOptions(), unsafe=True).data == text.replace(b"bsae", b"base")


AXIS = b"""<sdf version="1.4"><model name="m"><link name="a"/>
<link name="b"><pose>0 0 1 0 0 1.5708</pose><enable_wind>1</enable_wind></link>
<joint name="j" type="revolute"><parent>a</parent><child>b</child><axis><xyz>1 0 0</xyz></axis></joint></model></sdf>"""


def test_a_version_in_which_axes_turn_is_not_declared() -> None:
    fixed = apply_fixes(AXIS, LoadOptions(), unsafe=True, rules={"outside-version"})
    assert (fixed.data, [each.new for each in fixed.refused]) == (AXIS, [("another robot",)])
    straight = AXIS.replace(b"0 0 1.5708", b"0 0 0")
    assert b'version="1.6"' in apply_fixes(straight, LoadOptions(), unsafe=True, rules={"outside-version"}).data


def test_what_a_guess_changes_is_said() -> None:
    text = b"""<robot name='r'><link name='a'/><link name='b'/><joint name='j' type='revolute'><parent link='a'/>
    <child link='b'/><axis xyz='1 0 0'/><limit lower='1' upper='-1' effort='1' velocity='1'/></joint></robot>"""
    fixed = apply_fixes(text, LoadOptions(), unsafe=True)
    assert [each.rule.name for each in fixed.applied] == ["lower-above-upper"]
    assert [each.partition(":")[0] for each in fixed.changes] == [
        "joint 'j' axis/limit/lower",
        "joint 'j' axis/limit/upper",
    ]


@pytest.mark.parametrize(
    "text",
    [
        b"",
        b"   ",
        b"<robot",
        b"\0\0\0\0",
        b"{}",
        b"<robot name='r'><link name='a",
        b"\xff\xfe",
        "\u00f6<robot/>".encode(),
    ],
)
def test_what_cannot_be_read_stays_as_it_is(text: bytes) -> None:
    assert apply_fixes(text, LoadOptions(), unsafe=True).data == text


def test_a_fix_of_which_there_is_more_than_a_thousand_is_made_everywhere() -> None:
    visual = "<visual><geometry><sphere radius='1'/></geometry><material><color rgba='1 0 0 1'/></material></visual>"
    text = f"<robot name='r'><link name='a'>{visual * 1500}</link></robot>".encode()
    fixed = apply_fixes(text, LoadOptions())
    assert fixed.data.count(b'<material name="">') == 1500
    assert fixed.rounds == 2


BAD = Rule(name="bad", severity=Severity.WARNING, finds="", matters="", example="", better="")
WORSE = Rule(name="worse", severity=Severity.WARNING, finds="", matters="", example="", better="")


def _look(texts: Texts) -> LoadResult:
    """Finds each letter b, and each c, which nobody can fix."""
    data = texts[""]
    text = data.decode()
    found = [
        Diagnostic(BAD if letter == "b" else WORSE, letter, Location("", 1, f"/{letter}{at}"), Severity.WARNING)
        for at, letter in enumerate(text)
        if letter in "bc"
    ]
    return LoadResult("", None, tuple(found), content=data)


def _offering(edits: dict[int, tuple[TextEdit, ...]], safety: Safety = Safety.SAFE) -> object:
    """`with_fixes` of a rule whose fix depends on the place."""

    def offer(loaded: LoadResult, _: object) -> tuple[Diagnostic, ...]:
        return tuple(
            replace(each, fix=Fix("fix", edits[int(each.location.path[2:])], safety))
            if each.rule is BAD and int(each.location.path[2:]) in edits
            else each
            for each in loaded.diagnostics
        )

    return offer


def _edit(at: int, new: str, end: int | None = None) -> tuple[TextEdit, ...]:
    return (TextEdit(Span(at, at + 1 if end is None else end), new),)


def test_the_fix_that_makes_a_new_finding_is_taken_back_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    edits = {0: _edit(0, "a"), 1: _edit(1, "c"), 2: _edit(2, "a"), 3: _edit(3, "a")}
    monkeypatch.setattr("twinform.compiler.fixing.fix_rounds.with_fixes", _offering(edits))
    fixed = apply_fixes_by(_look, b"bbbb")
    assert fixed.data == b"abaa"
    assert [(each.finding.location.path, each.new) for each in fixed.refused] == [("/b1", ("worse",))]


def test_of_two_that_overlap_the_second_waits(monkeypatch: pytest.MonkeyPatch) -> None:
    edits = {0: _edit(0, "ab", 2), 1: _edit(0, "xa", 2)}
    monkeypatch.setattr("twinform.compiler.fixing.fix_rounds.with_fixes", _offering(edits))
    fixed = apply_fixes_by(_look, b"bb")
    assert (fixed.data, fixed.rounds) == (b"xa", 2)


def test_fixes_that_never_end_are_stopped(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("twinform.compiler.fixing.fix_rounds.with_fixes", _offering({0: _edit(0, "b ")}))
    assert apply_fixes_by(_look, b"b").rounds == MOST_ROUNDS


@pytest.mark.parametrize(("size", "most"), [(100, 200), (400_000, 10)])
def test_a_large_file_is_not_read_as_often_to_find_the_bad_fixes(
    size: int, most: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Each fix makes a finding; to find that out of 300 takes twice as many looks at the file."""
    text = b"b" * 300 + b" " * size
    edits = {at: _edit(at, "c") for at in range(300)}
    monkeypatch.setattr("twinform.compiler.fixing.fix_rounds.with_fixes", _offering(edits))
    looks: list[bytes] = []

    def look(texts: Texts) -> LoadResult:
        looks.append(texts[""])
        return _look({"": texts[""][:300]})

    fixed = apply_fixes_by(look, text)
    assert (len(looks), fixed.data) == (1 + most, text)
    assert len(fixed.refused) == 300
    assert fixed.refused[-1].new == ("too-many-tries",)


def test_one_for_display_is_never_made(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("twinform.compiler.fixing.fix_rounds.with_fixes", _offering({0: _edit(0, "a")}, Safety.DISPLAY))
    assert apply_fixes_by(_look, b"b", unsafe=True).data == b"b"


def test_what_is_left_is_what_a_look_at_the_result_finds() -> None:
    fixed = apply_fixes(LATE.encode(), LoadOptions())
    again = inspect(read(fixed.data, LoadOptions()), LoadOptions())
    assert fixed.left.diagnostics == again.diagnostics


@pytest.mark.parametrize(("keeps", "made"), [(None, b"'2'"), (True, b"'1'")])
def test_an_unsafe_fix_that_says_nothing_may_make_another_robot(
    monkeypatch: pytest.MonkeyPatch, keeps: bool | None, made: bytes
) -> None:
    inertia = b"<inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/>"
    text = (
        b"<robot name='r'><link name='base'><colr/><inertial><mass value='1'/>"
        + inertia
        + b"</inertial></link></robot>"
    )
    start = text.index(b"1'")

    def offer(loaded: LoadResult, _: object) -> tuple[Diagnostic, ...]:
        fix = Fix("Make it heavier", (TextEdit(Span(start, start + 1), "2"),), Safety.UNSAFE, keeps)
        offered = fix if loaded.content == text else None
        return tuple(replace(each, fix=offered) for each in loaded.diagnostics if each.rule.name == "unknown-element")

    monkeypatch.setattr("twinform.compiler.fixing.fix_rounds.with_fixes", offer)
    fixed = apply_fixes(text, LoadOptions(), unsafe=True)
    assert fixed.data == text.replace(b"'1'/>", made + b"/>", 1)
    assert bool(fixed.changes) == (keeps is None)
