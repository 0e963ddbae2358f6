"""Documents as JSON: what does not fit is reported with its line and path, and nothing of it gets lost silently."""

import json
from typing import Any

import pytest

import twinform
from twinform.compiler import CompileError, LoadResult
from twinform.diagnostics import Location

ROBOT: dict[str, Any] = {"format": "urdf", "models": [{"name": "r", "links": [{"name": "a"}]}]}
LINK = "/robot[@name='r']/link[@name='a']"
MODEL: dict[str, Any] = {"format": "sdf", "version": "1.11", "models": [{"name": "m", "links": [{"name": "a"}]}]}


def _check(data: object) -> LoadResult:
    text = data if isinstance(data, str) else json.dumps(data, indent=1)
    return twinform.check(text.encode(errors="surrogatepass"), name="robot.json")


def _errors(data: object) -> list[tuple[int, str, str]]:
    found = [each for each in _check(data).diagnostics if each.is_error]
    assert {each.rule.name for each in found} <= {"invalid-value"}
    assert {each.location.file for each in found} <= {"robot.json"}
    return [
        (each.location.line, each.location.path, each.message.removeprefix(f"{each.location.path or 'the document'}: "))
        for each in found
    ]


def _robot(**model: Any) -> dict[str, Any]:
    return {**ROBOT, "models": [{**ROBOT["models"][0], **model}]}


def _with_mass(mass: object) -> dict[str, Any]:
    inertia = dict.fromkeys(("ixx", "iyy", "izz"), 1) | dict.fromkeys(("ixy", "ixz", "iyz"), 0)
    return _robot(links=[{"name": "a", "inertial": {"mass": mass, "inertia": inertia}}])


def _deep(levels: int) -> dict[str, Any]:
    element: dict[str, Any] = {"name": "x"}
    for _ in range(levels):
        element = {"name": "x", "children": [element]}
    return element


WRONG: dict[str, tuple[object, list[tuple[int, str, str]]]] = {
    "no JSON": ("{", [(1, "", "not JSON: Expecting property name enclosed in double quotes (column 2)")]),
    "nothing in it": ("{}", [(1, "", "has no 'format'")]),
    "an unknown format": (
        {"format": "urdff"},
        [(2, "format", "Input should be 'urdf', 'sdf' or 'mjcf'")],
    ),
    "no model": ({**ROBOT, "models": []}, [(3, "models", "has 0 items; expected 1")]),
    "two robots": (
        {**ROBOT, "models": [{"name": name, "links": [{"name": "a"}]} for name in "rs"]},
        [(3, "models", "has 2 items; expected 1")],
    ),
    "a robot in a robot": (
        _robot(models=[{"name": "s", "links": [{"name": "b"}]}]),
        [
            (
                11,
                "models/0/models",
                'URDF cannot express [{"name": "s", "links": [{"name": "b"}]}]; a file in that format leaves it out',
            )
        ],
    ),
    "what only SDF has": (
        _robot(links=[{"name": "a", "gravity": False}]),
        [(9, "models/0/links/0/gravity", "URDF cannot express false; a file in that format leaves it out")],
    ),
    "a number that no double holds": (
        json.dumps(_with_mass(7), indent=1).replace("7", "1e999"),
        [(9, f"{LINK}/inertial/mass/@value", "'value' of <mass> is 'inf'; expected a finite number")],
    ),
    "a whole number that no double holds": (
        _with_mass(10**400),
        [(10, "models/0/links/0/inertial/mass", "Input should be a valid number")],
    ),
    "NaN": (
        _with_mass(float("nan")),
        [(1, "", 'not JSON: NaN is no number of JSON; SDF may have the word "NaN" in quotes')],
    ),
    "a word that only SDF has for a number": (
        _with_mass("Infinity"),
        [(9, f"{LINK}/inertial/mass/@value", "'value' of <mass> is 'inf'; expected a finite number")],
    ),
    "truth as a number": (
        _with_mass(True),
        [(10, "models/0/links/0/inertial/mass", "URDF cannot express true; a file in that format has 1.0 there")],
    ),
    "a name twice": (
        '{"format": "urdf", "format": "sdf"}',
        [(1, "", "not JSON: an object has the field 'format' twice")],
    ),
    "too many digits": ('{"a":' + "9" * 5000 + "}", [(1, "", "not JSON: a number has more than 4,300 digits")]),
    "too deep": ('{"a":' + "[" * 100_000, [(1, "", "not JSON: it is nested too deep")]),
    "deep, and read": (
        {**ROBOT, "models": json.loads("[" * 850 + "]" * 850)},
        [(4, "models/0", "is no object")],
    ),
    "another version": (
        {**ROBOT, "$schema": "urn:twinform:document:9"},
        [
            (
                13,
                "$schema",
                "is \"urn:twinform:document:9\"; expected 'urn:twinform:document:1'",
            )
        ],
    ),
    "a character that XML does not have": (
        _robot(name="a\x01"),
        [(5, "models/0/name", 'is "a\\u0001", which XML cannot hold here')],
    ),
    "half a character": (
        '{"format": "urdf", "models": [{"name": "\\ud800", "links": [{"name": "a"}]}]}',
        [(1, "models/0/name", 'is "\\ud800", which XML cannot hold here')],
    ),
    "a name with a blank for an element": (
        _robot(opaque=[{"element": {"name": "a b"}}]),
        [(14, "models/0/opaque/0/element/name", 'is "a b", which XML cannot hold here')],
    ),
    "a part that is nothing": (
        _robot(opaque=[{"at": "x"}]),
        [
            (
                12,
                "models/0/opaque/0",
                "has 0 of element or attribute or text; expected one",
            )
        ],
    ),
    "a field that only Python has": (
        _robot(source=["a.urdf", 1, None, "robot"]),
        [(11, "models/0/source", "is no field of this object")],
    ),
    "an order that is none": (_robot(order=[1]), [(11, "models/0/order", "is no list of the names of arrays")]),
    "a number in quotes": (
        _with_mass("7"),
        [(10, "models/0/links/0/inertial/mass", 'URDF cannot express "7"; a file in that format has 7.0 there')],
    ),
    "elements that are too deep": (
        _robot(opaque=[{"element": _deep(300)}]),
        [],
    ),
    "a shape that there is not": (
        _robot(links=[{"name": "a", "visuals": [{"geometry": {"shape": {"kind": "spere", "radius": 1}}}]}]),
        [
            (
                12,
                "models/0/links/0/visuals/0/geometry/shape",
                (
                    "Input tag 'spere' found using 'kind' does not match any of the expected tags: 'box', 'cylinder', "
                    "'sphere', 'capsule', 'cone', 'ellipsoid', 'plane', 'mesh', 'empty', 'heightmap', 'image', "
                    "'polyline'"
                ),
            )
        ],
    ),
    "an attribute twice": (
        _robot(opaque=[{"attribute": ["a", "1"]}, {"attribute": ["a", "2"]}]),
        [
            (
                11,
                "models/0/opaque",
                (
                    'URDF cannot express [{"attribute": ["a", "1"]}, {"attribute": ["a", "2"]}]; '
                    'a file in that format has [{"attribute": ["a", "2"]}] there'
                ),
            )
        ],
    ),
    "an attribute with a field of its own": (
        _robot(opaque=[{"element": {"name": "link", "attributes": [["name", "a"]]}}], links=[{"name": "b"}]),
        [],
    ),
    "blanks that no text has": (
        {
            **MODEL,
            "models": [
                {
                    **MODEL["models"][0],
                    "plugins": [{"name": "p", "filename": "f", "content": [{"name": "x", "text": " 1 "}]}],
                }
            ],
        },
        [
            (
                19,
                "models/0/plugins/0/content/0/text",
                'SDF cannot express " 1 "; a file in that format has "1" there',
            )
        ],
    ),
}


@pytest.mark.parametrize("name", WRONG)
def test_what_does_not_fit_is_reported_with_its_place(name: str) -> None:
    data, expected = WRONG[name]
    found = _errors(data) if expected else []
    assert [each[:2] for each in found] == [each[:2] for each in expected]
    assert [each[2] for each in found] == [each[2] for each in expected]
    loaded = _check(data)
    assert not loaded.accepted
    with pytest.raises(CompileError):
        twinform.convert(json.dumps(data).encode() if not isinstance(data, str) else data.encode(), to="sdf")


def test_a_value_that_is_nearly_right_is_guessed() -> None:
    (found,) = _check({"format": "urdff"}).diagnostics
    assert found.help == "did you mean 'urdf'?"
    (found,) = _check(
        _robot(links=[{"name": "a", "visuals": [{"geometry": {"shape": {"kind": "spere"}}}]}])
    ).diagnostics
    assert found.help == "did you mean 'sphere'?"
    (found,) = _check(_robot(link=[])).diagnostics
    assert found.help == "did you mean 'links'?"


def test_findings_about_the_model_have_the_line_of_the_json() -> None:
    data = _robot(links=[{"name": "a"}, {"name": "b"}, {"name": "a"}])
    lines = json.dumps(data, indent=1).splitlines()
    (found,) = [each for each in _check(data).diagnostics if each.rule.name == "duplicate-name"]
    assert found.location.file == "robot.json"
    assert found.location.path == "/robot[@name='r']/link[@name='a']"
    assert [number for number, line in enumerate(lines, 1) if '"name": "a"' in line][1] == found.location.line + 1


def test_sdf_may_have_what_is_no_number_of_json() -> None:
    limit = {"lower": "-Infinity", "upper": "Infinity", "effort": "NaN"}
    axis: dict[str, Any] = {"xyz": [0, 0, 1], "limit": limit}
    joint = {"name": "j", "type": "revolute", "parent": "world", "child": "a", "axis": axis}
    data = {**MODEL, "models": [{**MODEL["models"][0], "joints": [joint]}]}
    made = twinform.convert(json.dumps(data).encode(), to="sdf", sdf_version="1.11").text
    assert "<lower>-inf</lower>" in made
    assert json.loads(twinform.convert(made.encode(), to="json").text)["models"] == data["models"]
    axis["xyz"] = [0, 0, "Infinity"]
    assert len(_errors(data)) == 1


def test_a_byte_order_mark_and_empty_fields_are_nothing() -> None:
    text = "\ufeff" + json.dumps(_robot(links=[{"name": "a", "opaque": [], "visuals": []}]))
    assert twinform.loads(text) == twinform.loads(json.dumps(ROBOT))


ORDERED = """<robot name="r">
  <link name="a"/>
  <joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint>
  <material name="m"><color rgba="1 0 0 1"/></material>
  <link name="b"><collision><geometry><box size="1 1 1"/></geometry></collision>
    <visual><geometry><box size="1 1 1"/></geometry></visual></link>
</robot>"""


def test_parts_of_several_kinds_keep_their_order() -> None:
    made = twinform.convert(ORDERED.encode(), to="json").text
    model = json.loads(made)["models"][0]
    assert model["order"] == ["links", "joints", "materials", "links"]
    assert model["links"][1]["order"] == ["collisions", "visuals"]
    assert twinform.convert(made.encode(), to="urdf").text == twinform.convert(ORDERED.encode(), to="urdf").text


def test_what_gazebo_elements_add_has_the_place_that_it_has_without_json() -> None:
    shape = "<geometry><box size='1 1 1'/></geometry>"
    text = f"""<robot name="r">
      <link name="a">
        <visual>{shape}</visual>
        <collision>{shape}</collision>
      </link>
      <gazebo reference="a"><sensor name="s" type="imu"/></gazebo>
    </robot>"""
    made = twinform.convert(text.encode(), to="json").text
    assert twinform.convert(made.encode(), to="sdf").text == twinform.convert(text.encode(), to="sdf").text


@pytest.mark.parametrize("kinds", [[], ["links"], ["joints"] * 9, ["links", "joints", "links", "links", "materials"]])
def test_an_order_that_does_not_fit_loses_nothing(kinds: list[str]) -> None:
    data = json.loads(twinform.convert(ORDERED.encode(), to="json").text)
    data["models"][0]["order"] = kinds
    assert twinform.loads(json.dumps(data)) == twinform.loads(ORDERED)


def test_spellings_are_kept_as_long_as_they_fit() -> None:
    text = '<sdf version="1.11"><model name="m"><static>1</static><link name="a"/></model></sdf>'
    made = twinform.convert(text.encode(), to="json").text
    assert json.loads(made)["models"][0]["spelling"] == {"static": "1"}
    assert "<static>1</static>" in twinform.convert(made.encode(), to="sdf").text
    edited = made.replace('"static": true', '"static": false')
    assert "<static>false</static>" in twinform.convert(edited.encode(), to="sdf").text


def test_what_follows_from_the_joints_of_urdf_is_not_written() -> None:
    made = json.loads(twinform.convert(ORDERED.encode(), to="json").text)["models"][0]
    assert "pose" not in made["links"][1]
    assert "pose" not in made["joints"][0]
    assert twinform.loads(twinform.convert(ORDERED.encode(), to="json").text) == twinform.loads(ORDERED)


def test_findings_of_a_file_are_those_of_its_json() -> None:
    text = b'<robot name="r"><link name="a"/><foo/></robot>'
    without = twinform.check(text)
    made = twinform.convert(text, to="json").text
    assert [each.rule for each in twinform.check(made.encode()).diagnostics] == [
        each.rule for each in without.diagnostics
    ]
    assert twinform.check(made.encode()).diagnostics[0].location == Location("<bytes>", 15, "/robot[@name='r']/foo")


def test_elements_that_are_as_deep_as_xml_allows_go_there_and_back() -> None:
    text = f"<robot name='r'><link name='a'/>{'<x>' * 250}{'</x>' * 250}</robot>"
    made = twinform.convert(text.encode(), to="json").text
    own = twinform.convert(text.encode(), to="urdf").text
    assert twinform.convert(made.encode(), to="urdf").text == own


def test_null_says_that_nothing_was_written() -> None:
    text = json.dumps(_robot(links=[{"name": "a", "inertial": None}]))
    assert twinform.loads(text) == twinform.loads(json.dumps(ROBOT))
