"""What is said where a xacro file cannot be expanded, and what it could have meant."""

from pathlib import Path

import pytest

import twinform

HEAD = '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">\n'
BASE = '<xacro:macro name="base" params="height *shape"><link name="${height}"/></xacro:macro>\n'
MASS = '<xacro:macro name="body" params="mass"><mass value="${0.5 * mass}"/></xacro:macro>\n'
PARTS = {
    "a.xacro": f'{HEAD}<xacro:include filename="r.urdf.xacro"/></robot>',
    "broken.xacro": f'{HEAD}<xacro:If value="1">\n</xacro:if></robot>',
}
CASES = {
    "a property with a typo": (
        '<xacro:property name="base_mass" value="1"/>\n<link name="${base_mas}"/>',
        "r.urdf.xacro:3: property 'base_mas' is not defined, in ${base_mas}",
        "did you mean 'base_mass' (r.urdf.xacro:2)?",
    ),
    "a macro with a typo": (
        f"{BASE}<xacro:bas/>",
        "r.urdf.xacro:3: there is no macro 'bas'",
        "did you mean 'base' (r.urdf.xacro:2)?",
    ),
    "a macro of a file": (
        "<xacro:imu/>",
        "r.urdf.xacro:2: there is no macro 'imu'",
        "if it is in a file, include that before this line",
    ),
    "a parameter with a typo": (
        f'{BASE}<xacro:base heigth="1"/>',
        "r.urdf.xacro:3: macro 'base' has no parameter 'heigth'",
        "did you mean 'height'?",
    ),
    "a parameter that there is not": (
        f'{BASE}<xacro:base color="red"/>',
        "r.urdf.xacro:3: macro 'base' has no parameter 'color'",
        "it has height, shape",
    ),
    "a parameter that lacks": (
        f"{MASS}<xacro:body/>",
        "r.urdf.xacro:3: macro 'body' is called without its parameter 'mass'",
        None,
    ),
    "a block that lacks": (
        f'{BASE}<xacro:base height="1"/>',
        "r.urdf.xacro:3: macro 'base' is called with fewer elements inside than it has blocks: 'shape'",
        None,
    ),
    "a block too many": (
        f'{MASS}<xacro:body mass="1"><box/></xacro:body>',
        "r.urdf.xacro:3: macro 'body' is called with <box> inside, for which it has no block",
        None,
    ),
    "a block that there is not": (
        '<xacro:insert_block name="shape"/>',
        "r.urdf.xacro:2: there is no block 'shape'",
        None,
    ),
    "braces without the dollar": (
        f'{MASS}<xacro:body mass="{{wheel_mass}}"/>',
        (
            "r.urdf.xacro:2: mass is the text '{wheel_mass}', not a number (in macro 'body', "
            "called at r.urdf.xacro:3), in ${0.5 * mass}"
        ),
        "did you mean ${wheel_mass}?",
    ),
    "files in a circle": (
        '<xacro:include filename="a.xacro"/>',
        # where the stack of Python ends
        (
            "a.xacro:2: r.urdf.xacro includes a.xacro, which includes r.urdf.xacro"
            " or r.urdf.xacro:2: r.urdf.xacro includes a.xacro, which includes r.urdf.xacro"
        ),
        None,
    ),
    "macros in a circle": (
        '<xacro:macro name="a"><xacro:b/></xacro:macro><xacro:macro name="b"><xacro:a/></xacro:macro><xacro:a/>',
        "r.urdf.xacro:2: macro 'a' calls 'b', which calls 'a', without an end",
        None,
    ),
    "a property of itself": (
        '<xacro:property name="a" value="1"/><xacro:property name="a" value="${a + 1}"/><link name="${a}"/>',
        "r.urdf.xacro:2: property 'a' is defined by itself: a -> a",
        'lazy_eval="false" takes the value that a property has before',
    ),
    "another case in an included file": (
        '<xacro:include filename="broken.xacro"/>',
        "broken.xacro:3: not well-formed XML: </xacro:if> ends the <xacro:If> of line 2",
        "write </xacro:If>",
    ),
}


@pytest.mark.parametrize("name", CASES)
def test_a_failure_is_said_in_words_for_everybody(name: str, tmp_path: Path) -> None:
    body, words, help = CASES[name]
    for file, text in {**PARTS, "r.urdf.xacro": f"{HEAD}{body}\n</robot>"}.items():
        (tmp_path / file).write_text(text)
    found = twinform.check(tmp_path / "r.urdf.xacro").diagnostics[-1]
    assert f"{Path(found.location.file).name}:{found.location.line}: {found.message}" in words.split(" or ")
    assert found.help == help


def test_a_prefix_without_a_namespace_is_declared_by_a_fix(tmp_path: Path) -> None:
    path = tmp_path / "r.urdf.xacro"
    path.write_text('<robot name="r">\n<xacro:property name="a" value="1"/>\n</robot>')
    (found,) = twinform.check(path).diagnostics
    assert found.message == "not well-formed XML: the prefix 'xacro' of <xacro:property> is not declared"
    assert found.help == 'add xmlns:xacro="http://www.ros.org/wiki/xacro" to the root element'


def test_a_macro_that_is_called_twice_is_named_where_it_is_called(tmp_path: Path) -> None:
    macro = '<xacro:macro name="wheel" params="side">\n<link name="${side}_wheel"/>\n</xacro:macro>\n'
    calls = '<xacro:wheel side="left"/>\n<xacro:wheel side="right"/>\n<xacro:wheel side="left"/>\n'
    (tmp_path / "r.urdf.xacro").write_text(f"{HEAD}{macro}{calls}</robot>")
    diagnostics = twinform.check(tmp_path / "r.urdf.xacro").diagnostics
    found = next(each for each in diagnostics if each.rule.name == "duplicate-name")
    assert (found.message, found.location.line) == ("link 'left_wheel' is defined twice", 3)
    assert found.help == '<xacro:wheel side="left"> is called at r.urdf.xacro:5 and r.urdf.xacro:7'
