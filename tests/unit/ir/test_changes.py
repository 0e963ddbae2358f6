from collections.abc import Callable

import pytest

import twinform
from twinform.ir import Document, Link, Model
from twinform.ir.changes import ChangeKind, NodeChange, changes, count_changes

ROBOT = """
<sdf version="1.11"><model name="m">
  <link name="a"><inertial><mass>1</mass></inertial>
    <visual name="v"><geometry><box><size>1 1 1</size></box></geometry></visual></link>
  <link name="b"><mine:tag xmlns:mine="urn:mine">1</mine:tag></link>
  <plugin name="p" filename="lib"><gain>1</gain><gain>2</gain></plugin>
</model></sdf>
"""
OLD = twinform.loads(ROBOT)


def summaries(text: str) -> list[str]:
    """The changes that lead to a text, without their values where a node is new or gone."""
    new = twinform.loads(text)
    return [f"{each.how} {each.path}" for each in changes(OLD, new)]


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        ("", "", []),
        ("<mass>1", "<mass>2", ["~ /models['m']/links['a']/inertial/mass"]),
        (
            "<inertial><mass>1</mass></inertial>",
            "",
            ["- /models['m']/links['a']/inertial", "- /models['m']/links['a']/inertial/mass"],
        ),
        ('<link name="b">', '<link name="c">', ["~ /models['m']/links['c']/name"]),
        (
            "<box><size>1 1 1</size></box>",
            "<sphere><radius>1</radius></sphere>",
            [
                "- /models['m']/links['a']/visuals['v']/geometry/shape",
                "- /models['m']/links['a']/visuals['v']/geometry/shape/kind",
                "- /models['m']/links['a']/visuals['v']/geometry/shape/size",
                "+ /models['m']/links['a']/visuals['v']/geometry/shape",
                "+ /models['m']/links['a']/visuals['v']/geometry/shape/kind",
                "+ /models['m']/links['a']/visuals['v']/geometry/shape/radius",
            ],
        ),
        (">1</mine", ">3</mine", ["- /models['m']/links['b']/opaque[0]", "+ /models['m']/links['b']/opaque[0]"]),
        (
            "<gain>1</gain><gain>2</gain>",
            "<gain>2</gain><gain>1</gain>",
            ["> /models['m']/plugins['p']/content"],
        ),
        (
            '<link name="b">',
            '<link name="b"><sensor name="s" type="imu"/>',
            [f"+ /models['m']/links['b']/sensors['s']{field}" for field in ("", "/name", "/type")],
        ),
        ("</model>", '<link name="a2"/></model>', ["+ /models['m']/links['a2']", "+ /models['m']/links['a2']/name"]),
    ],
)
def test_each_change_has_its_path(old: str, new: str, expected: list[str]) -> None:
    assert summaries(ROBOT.replace(old, new, 1) if old else ROBOT) == expected


def test_a_part_without_fields_belongs_to_its_node() -> None:
    new = twinform.loads(ROBOT.replace(">1</mine", ">3</mine"))
    link = "/models['m']/links['b']"
    before, after = OLD.models[0].links[1].opaque[0], new.models[0].links[1].opaque[0]
    assert list(changes(OLD, new)) == [
        NodeChange(ChangeKind.REMOVED, link, f"{link}/opaque[0]", before, None),
        NodeChange(ChangeKind.ADDED, link, f"{link}/opaque[0]", None, after),
    ]


def test_a_value_is_reported_with_its_node_and_what_it_was() -> None:
    body = "/models['m']/links['a']/inertial"
    heavy = twinform.loads(ROBOT.replace("<mass>1", "<mass>2"))
    assert list(changes(OLD, heavy)) == [NodeChange(ChangeKind.CHANGED, body, f"{body}/mass", 1.0, 2.0)]
    none = twinform.loads(ROBOT.replace("<inertial><mass>1</mass></inertial>", ""))
    assert list(changes(OLD, none)) == [
        NodeChange(ChangeKind.REMOVED, body, body),
        NodeChange(ChangeKind.REMOVED, body, f"{body}/mass", 1.0, None),
    ]
    assert list(changes(none, OLD)) == [
        NodeChange(ChangeKind.ADDED, body, body),
        NodeChange(ChangeKind.ADDED, body, f"{body}/mass", None, 1.0),
    ]


def test_parts_are_added_to_and_taken_from_lists_that_have_none() -> None:
    sensor = "/models['m']/links['b']/sensors['s']"
    new = twinform.loads(ROBOT.replace('<link name="b">', '<link name="b"><sensor name="s" type="imu"/>'))
    assert list(changes(OLD, new)) == [
        NodeChange(ChangeKind.ADDED, sensor, sensor),
        NodeChange(ChangeKind.ADDED, sensor, f"{sensor}/name", None, "s"),
        NodeChange(ChangeKind.ADDED, sensor, f"{sensor}/type", None, "imu"),
    ]
    assert list(changes(new, OLD)) == [
        NodeChange(ChangeKind.REMOVED, sensor, sensor),
        NodeChange(ChangeKind.REMOVED, sensor, f"{sensor}/name", "s", None),
        NodeChange(ChangeKind.REMOVED, sensor, f"{sensor}/type", "imu", None),
    ]


def with_links(change: Callable[[tuple[Link, ...]], tuple[Link, ...]]) -> Document:
    model: Model = OLD.models[0]
    return OLD.copy(models=(model.copy(links=change(model.links)),))


def test_another_order_is_one_change() -> None:
    (only,) = changes(OLD, with_links(lambda links: links[::-1]))
    assert f"{only.how} {only.path} {only.new}" == """> /models['m']/links ["['b']", "['a']"]"""


def test_nodes_are_counted_once() -> None:
    new = with_links(lambda links: (links[0].copy(kinematic=True, gravity=False), *links[1:]))
    assert count_changes(OLD, new) == (1, 0, 0)
    assert count_changes(OLD, with_links(lambda links: links[1:])) == (0, 0, 5)
    assert count_changes(with_links(lambda links: links[1:]), OLD) == (0, 5, 0)
    assert count_changes(OLD, OLD) == (0, 0, 0)
