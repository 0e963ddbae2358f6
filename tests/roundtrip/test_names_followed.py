"""What names a link or joint of a URDF names it in the SDF too, whatever that calls it, and on the way back."""

from hypothesis import given
from hypothesis import strategies as st
from lxml import etree

import twinform
from tests.profile import examples
from tests.snippets import INERTIAL
from twinform.schemas import XmlElement

_NAMES = st.lists(st.sampled_from(["a", "b", "arm", "arm_joint", "__tip__"]), unique=True)
_TYPES = st.sampled_from(["continuous", "fixed"])


@st.composite
def _robots(draw: st.DrawFn) -> tuple[str, list[str], list[str]]:
    """A robot of which a plugin names every link and joint, and these names."""
    links = ["base", *draw(_NAMES)]
    joints = draw(st.permutations(["a", "b", "arm", "arm_joint", "__tip__", "j"]))[: len(links) - 1]
    leaders = [joint for joint in joints if draw(st.booleans())]
    parts = [f'<link name="{name}">{INERTIAL}</link>' for name in links]
    for number, joint in enumerate(joints):
        mimic = f'<mimic joint="{draw(st.sampled_from([*leaders, "nobody"]))}"/>' if draw(st.booleans()) else ""
        ends = f'<parent link="{links[number]}"/><child link="{links[number + 1]}"/>'
        parts.append(f'<joint name="{joint}" type="{draw(_TYPES)}">{ends}<axis xyz="0 0 1"/>{mimic}</joint>')
    named = [f"<link_name>{name}</link_name>" for name in links] + [f"<joint>{name}</joint>" for name in joints]
    plugin = f'<gazebo><plugin name="p" filename="p">{"".join(named)}</plugin></gazebo>'
    return f'<robot name="r">{"".join(parts)}{plugin}</robot>', links, joints


def _named(root: XmlElement, tag: str) -> list[str]:
    return [each.text or "" for each in root.iterfind(f".//plugin/{tag}")]


def _called(root: XmlElement, tag: str) -> set[str]:
    return {each.get("name") or "" for each in root.iterfind(f".//{tag}")}


@given(_robots())
@examples(0.3)
def test_parameters_of_plugins_follow_what_is_renamed(robot: tuple[str, list[str], list[str]]) -> None:
    text, links, joints = robot
    there = twinform.convert(text.encode(), to="sdf")
    sdf = etree.fromstring(there.text.encode())
    of_links, of_joints = _named(sdf, "link_name"), _named(sdf, "joint")
    assert len(of_links) == len(links)
    assert {*of_links} <= _called(sdf, "link")
    assert len(of_joints) == len(joints)
    assert {*of_joints} <= _called(sdf, "joint")
    assert "unknown-leader" not in [each.rule.name for each in twinform.check(there.text.encode()).diagnostics]
    back = etree.fromstring(twinform.convert(there.text.encode(), to="urdf").text.encode())
    assert (_named(back, "link_name"), _named(back, "joint")) == ([*links], [*joints])
