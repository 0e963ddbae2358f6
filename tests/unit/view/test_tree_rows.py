"""The tree of the panel: nothing of a robot is left out, and every row says which link it is."""

import html
import re

import pytest

from tests.chains import chain
from twinform.compiler import LoadOptions
from twinform.compiler.scene import Scene
from twinform.view import read_subject
from twinform.view.words import Mark, tree

from .test_words import LOOP


def _scene(text: str) -> Scene:
    subject, _ = read_subject(text.encode(), LoadOptions())
    assert subject is not None
    return subject.scene


def _links(shown: str) -> list[str]:
    return [html.unescape(each) for each in re.findall(r'data-twinform-link="([^"]*)"', shown)]


def test_a_joint_that_closes_a_loop_is_listed_where_it_closes_it():
    shown = tree(_scene(LOOP), {})
    assert sorted(_links(shown)) == ["a", "b", "c", "c"]
    assert all(f"fixed {joint}" in shown for joint in ("ab", "bc", "ac"))


@pytest.mark.parametrize("count", [1, 2, 59, 60, 61, 1000])
def test_a_chain_is_listed_whole_and_nested_no_deeper_than_browsers_can(count: int):
    shown = tree(_scene(chain(count)), {})
    assert _links(shown) == [f"l{i}" for i in range(count)]
    assert shown.count("<details") == shown.count("</details>") == min(count - 1, 60)


def test_children_are_below_their_parent_and_no_other():
    text = """<robot name="r"><link name="a"/><link name="b"/><link name="c"/><link name="d"/>
      <joint name="ab" type="fixed"><parent link="a"/><child link="b"/></joint>
      <joint name="bc" type="fixed"><parent link="b"/><child link="c"/></joint>
      <joint name="ad" type="fixed"><parent link="a"/><child link="d"/></joint></robot>"""
    extras = r"<style>.*?</style>| *<span.*?</span>|</?summary>|</?button[^>]*>"
    plain = re.sub(extras, "", tree(_scene(text), {}), flags=re.DOTALL)
    assert plain.endswith("<details open>a<details open>b<div>c</div></details><div>d</div></details></div>")


def test_large_trees_begin_folded():
    shown = tree(_scene(chain(400)), {})
    assert shown.count("<details open>") == 1


def test_marks_stand_beside_their_link():
    shown = tree(_scene(LOOP), {"b": [Mark("!", "red", 'what "is" wrong')]})
    (mark,) = re.findall(r'<span class="mark".*?</span>', shown)
    assert mark == '<span class="mark" style="color:red" title="what &quot;is&quot; wrong">!</span>'
