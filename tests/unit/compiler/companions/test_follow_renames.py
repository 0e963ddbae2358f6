"""Renames in companion files: every name that means the part changes, and no other byte does."""

import re
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from twinform.compiler.companions.follow_renames import Renames, follow_in, leaves_in
from twinform.compiler.companions.name_places import mentions

_LINES = st.sampled_from(
    [
        "    joints: [other, @]",
        "    joints:\n      - other\n      - @   # hip stays here",
        "    joint: @",
        "    left_wheel_names: [@,other]",
        "    gains:\n      @: {p: 1.0, label: hip}",
        "    note: hip\n    # joints: [hip]",
        "    text: |\n      joints: [hip]",
        "    base_frame_id: hip",
        "    constraints: {goal_time: 1.0, @: {goal: 0.1}}",
    ]
)
_PLAIN = {"hip": "plain", "'hip'": "single", '"hip"': "double"}


@st.composite
def _files(draw: st.DrawFn) -> str:
    """A file with `@` for each place of the name of a joint; `hip` elsewhere is something else."""
    head = draw(st.sampled_from(["", "# café 🤖\n", "\ufeff", "%YAML 1.1\n---\n"]))
    nodes = draw(st.lists(_LINES, min_size=1, max_size=6))
    lines = [f"node_{number}:\n  ros__parameters:\n{line}" for number, line in enumerate(nodes)]
    text = head + "\n\n".join(lines) + draw(st.sampled_from(["", "\n", "\n\n# end"]))
    return text.replace("\n", "\r\n") if draw(st.booleans()) else text


_NEW = st.one_of(
    st.from_regex(r"[a-z_][a-z0-9_]{0,8}", fullmatch=True),
    st.sampled_from(["with blank", "1", "a: b", "- x", "it's", "#x", 'say "x"', "q\\x", "{x}", "è", "*x", "true"]),
)


@given(_files(), st.sampled_from(sorted(_PLAIN)), _NEW)
def test_a_rename_changes_the_names_and_no_other_byte(marked: str, written: str, new: str) -> None:
    before = marked.replace("@", written).encode()
    followed = follow_in(Path("controllers.yaml"), before, Renames({}, {"hip": new}))
    assert (followed.changed, followed.left) == (marked.count("@"), ())
    spellings = (re.escape(each) for each in _spellings(written, new))
    place = f"(?:{'|'.join(spellings)})"
    assert re.fullmatch(place.join(map(re.escape, marked.split("@"))), followed.after.decode())
    assert _joints(followed.after) == [new if each == "hip" else each for each in _joints(before)]


def _spellings(written: str, new: str) -> list[str]:
    """How a name may be written where the old one was."""
    single = "'{}'".format(new.replace("'", "''"))
    match _PLAIN[written]:
        case "plain":
            return [new, single]
        case "single":
            return [single]
        case _:
            return ['"{}"'.format(new.replace("\\", "\\\\").replace('"', '\\"'))]


def _joints(data: bytes) -> list[str]:
    kinds = {"joint", "driven joint", "interface"}
    return [each.text for each in mentions(leaves_in(Path("c.yaml"), data)) if each.kind in kinds]


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("    max_effort_interface: hip/effort", "    max_effort_interface: leg/effort"),
        ("    front_wheels_names: [pid/hip]", "    front_wheels_names: [pid/leg]"),
        ("    gains.hip.p: 1.0", "    gains.leg.p: 1.0"),
        ("    base_frame_id: /trunk", "    base_frame_id: /body"),
        ("    joints: [hipp, hip_2, hip]", "    joints: [hipp, hip_2, leg]"),
        ("    base_frame_id: hip", "    base_frame_id: hip"),
    ],
)
def test_parts_of_a_text_that_are_the_name_follow(before: str, after: str) -> None:
    head = "node:\n  ros__parameters:\n"
    followed = follow_in(Path("c.yaml"), (head + before).encode(), Renames({"trunk": "body"}, {"hip": "leg"}))
    assert followed.after.decode() == head + after


def test_what_cannot_be_changed_in_the_text_is_said() -> None:
    data = b'node:\n  ros__parameters:\n    joints: ["h\\x69p", other]\n    gains.hip.p: 1.0\n'
    followed = follow_in(Path("c.yaml"), data, Renames({}, {"hip": "a.b"}))
    assert (followed.after, followed.left) == (data, ("hip", "hip"))


@given(st.sampled_from(["'", '"']), st.sampled_from(["", "\r\n", "  <!-- hip & 'trunk' -->\n"]), _NEW)
def test_srdf_follows_in_its_attributes(quote: str, between: str, new: str) -> None:
    lines = ['<?xml version="1.0"?>\n<robot name=~hip~>', "<group name=~hip~>", "<joint  name = ~@~/>"]
    lines += ["<link name=~hip~/>", "</group>", "<passive_joint\n name=~@~ />", "</robot>"]
    marked = between.join(lines).replace("~", quote)
    before = marked.replace("@", "hip")
    followed = follow_in(Path("r.srdf"), before.encode(), Renames({}, {"hip": new}))
    escaped = new.replace("&", "&amp;").replace("<", "&lt;").replace("'", "&apos;").replace('"', "&quot;")
    assert followed.after.decode() == marked.replace("@", escaped)
