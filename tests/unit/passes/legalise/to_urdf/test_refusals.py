"""What URDF cannot express at all, and which model of a world it is."""

import pytest

from twinform.diagnostics import Fate

from .models import LINK, arm, joint, link, lower, read

WORLD = "<world name='w'><gravity>0 0 -1</gravity><model name='m'>{}</model><model name='n'>{}</model></world>"


def test_a_model_is_taken_out_of_a_world_by_name() -> None:
    document = read(LINK, around=WORLD.replace("{}", LINK))
    root, sink = lower(document, model="n")
    assert root.get("name") == "n"
    lost = [entry.message for entry in sink.entries if entry.rule.name == "outside-model"]
    assert len(lost) == 3
    assert all(entry.fate is Fate.DROPPED for entry in sink.entries if entry.rule.name == "outside-model")


@pytest.mark.parametrize(
    ("text", "around", "rule", "message"),
    [
        (LINK, WORLD.replace("{}", LINK), "model-not-chosen", "w::m, w::n"),
        (LINK, "<include><uri>model://x</uri></include>", "include-not-expanded", "model://x"),
        (
            LINK + "<include><uri>model://x</uri></include>",
            "<model name='m'>{}</model>",
            "include-not-expanded",
            "model://x",
        ),
        (
            arm("screw", "<thread_pitch>0</thread_pitch>"),
            "<model name='m'>{}</model>",
            "joint-type-unsupported",
            "screw",
        ),
        (link("<inertial auto='true'/>"), "<model name='m'>{}</model>", "automatic-inertia", "'a'"),
        (link("<pose relative_to='x'>0 0 0 0 0 0</pose>"), "<model name='m'>{}</model>", "dangling-frame", "'x'"),
        (arm("revolute", "<axis><xyz>0 0 0</xyz></axis>"), "<model name='m'>{}</model>", "zero-axis", "'j'"),
        (link("<inertial><mass>nan</mass></inertial>"), "<model name='m'>{}</model>", "unsayable-number", "nan"),
        (
            LINK + "<frame name='f' attached_to='a'/>" + joint("fixed", child="f"),
            "<model name='m'>{}</model>",
            "self-joint",
            "'a'",
        ),
    ],
)
def test_what_urdf_cannot_express_at_all_is_an_error(text: str, around: str, rule: str, message: str) -> None:
    _, sink = lower(read(text, around=around))
    found = [each for each in sink.diagnostics if each.is_error]
    assert [each.rule.name for each in found] == [rule]
    assert message in found[0].message
    assert found[0].location.path
