"""MJCF of a stranger: copies without end, files that name themselves or others' files, and carriers that are no XML."""

import re
from pathlib import Path

import pytest

from tests.hostile.child import twinform

_RULE = re.compile(r"\[([a-z-]+)\](?:, \d+ x)?$", re.MULTILINE)
"""A finding of the terminal ends with its rule."""
_GEOM = '<geom size="1"/>'


def _world(content: str, around: str = "") -> str:
    return f"<mujoco>{around}<worldbody>{content}</worldbody></mujoco>"


def _copies(times: int, count: str) -> str:
    return _world(f'<replicate count="{count}">' * times + _GEOM + "</replicate>" * times)


_SELF = '<asset><model name="m" file="r.xml"/></asset><worldbody><attach model="m" prefix="a"/></worldbody>'
_ENTITY = "&lt;!DOCTYPE a [&lt;!ENTITY b SYSTEM 'secret'>]>&lt;link>&amp;b;&lt;/link>"
_LONG = "1 " * 500_000
_DOCUMENTS: dict[str, tuple[str, set[str]]] = {
    "a billion copies": (_copies(1, "1000000000"), {"oversized-file"}),
    "copies of copies": (_copies(10, "100"), {"oversized-file"}),
    "a billion copies in scientific notation": (_copies(1, "1e9"), {"invalid-value"}),
    "a billion copies of nothing": (_world('<replicate count="1000000000"/>'), set()),
    "copies with long names": (
        _world(f'<replicate count="5000" sep="{"x" * 1_000_000}"><body name="a">{_GEOM}</body></replicate>'),
        {"oversized-file"},
    ),
    "copies of long lists": (
        _world(f'<replicate count="5000"><geom size="1" user="{_LONG}"/></replicate>'), {"oversized-file"},
    ),
    "a class with a long list": (
        _world(_GEOM * 5000, f'<default><geom user="{_LONG}"/></default>'), {"oversized-file"},
    ),
    "20,000 geoms in 200 frames": (
        _world('<frame euler="1 2 3">' * 200 + _GEOM * 20_000 + "</frame>" * 200), set(),
    ),
    "1,000 bodies deep": (_world("<body>" * 1000 + "</body>" * 1000), {"oversized-file"}),
    "100,000 geoms": (_world(_GEOM * 100_000), {"oversized-file"}),
    "an include of itself": ('<mujoco><include file="r.xml"/></mujoco>', {"include-cycle"}),
    "an attachment of itself": (f"<mujoco>{_SELF}</mujoco>", {"include-cycle"}),
    "classes in themselves": (
        _world("", '<default><default class="a"><default class="a"/></default></default>'), {"duplicate-name"},
    ),
    "angles of nothing": (_world('<geom size="1" euler="nan inf 0"/>'), {"zero-axis"}),
    "a carrier that is no XML": (
        _world(_GEOM, '<custom><text name="twinform:link:a" data="&lt;link"/></custom>'), {"stale-carrier"},
    ),
    "a carrier with an entity": (
        _world(_GEOM, f'<custom><text name="twinform:link:a" data="{_ENTITY}"/></custom>'), {"stale-carrier"},
    ),
    "5,000 bodies without names": (_world(f"<body>{_GEOM}</body>" * 5_000), set()),
}  # fmt: skip


@pytest.mark.parametrize("name", _DOCUMENTS)
def test_a_file_is_read_or_refused_and_costs_no_more_than_its_size(name: str, tmp_path: Path) -> None:
    text, expected = _DOCUMENTS[name]
    (tmp_path / "r.xml").write_text(text)
    outcome = twinform("check", "r.xml", folder=tmp_path)
    assert "Traceback" not in outcome.output
    assert set(_RULE.findall(outcome.output)) == expected, outcome.output[:2000]


_FILES = (
    '<include file="{}"/>',
    '<asset><mesh name="m" file="{}"/></asset><worldbody><geom type="mesh" mesh="m"/></worldbody>',
    '<asset><texture name="t" type="2d" file="{}"/></asset>',
    '<asset><hfield name="h" file="{}" size="1 1 1 1"/></asset>',
    '<asset><model name="m" file="{}"/></asset><worldbody><attach model="m" prefix="a"/></worldbody>',
)


@pytest.mark.parametrize("content", _FILES)
@pytest.mark.parametrize("spelling", ["../secret.xml", "{}/secret.xml", "file://{}/secret.xml", "link.xml"])
def test_nothing_outside_of_its_folder_is_read(spelling: str, content: str, tmp_path: Path) -> None:
    inside = tmp_path / "inside"
    inside.mkdir()
    (inside / ".git").mkdir()
    (tmp_path / "secret.xml").write_text("<mujoco model='TOLD'><worldbody/></mujoco>")
    (inside / "link.xml").symlink_to(tmp_path / "secret.xml")
    (inside / "r.xml").write_text(f"<mujoco>{content.format(spelling.format(tmp_path))}</mujoco>")
    for command in (("check",), ("convert", "--to", "sdf")):
        outcome = twinform(*command, "r.xml", folder=inside)
        assert "Traceback" not in outcome.output
        assert "TOLD" not in outcome.output
        assert [each for each in outcome.opened if str(each).endswith("r.xml")]
        assert not [each for each in outcome.opened if str(each).endswith("/secret.xml")], outcome.opened


_TWICE = '<asset><model name="m" file="{}.xml"/></asset><worldbody>{}</worldbody>'


_KEYS = '<keyframe><key qpos="1"/></keyframe>'
_ATTACHED: dict[str, tuple[str, str, set[str]]] = {
    "twice": ("ab", _world(f"<body>{_GEOM}</body>"), {"oversized-file"}),
    "twice, with keyframes": ("ab", _world(f"<body><joint/>{_GEOM}</body>", _KEYS), {"oversized-file"}),
    "twice, and empty": ("ab", _world(""), set()),
    "200 times": ("0123456789" * 20, _world(""), set()),
}


@pytest.mark.parametrize("name", _ATTACHED)
def test_models_that_attach_others_cost_what_comes_of_them(name: str, tmp_path: Path) -> None:
    """Each of 24 small files has the next one in it several times."""
    prefixes, last, expected = _ATTACHED[name]
    attach = "".join(f'<attach model="m" prefix="{each}"/>' for each in prefixes)
    keys = _KEYS if "keyframes" in name else ""
    for number in range(24):
        text = _TWICE.format(number + 1, attach) + keys
        (tmp_path / f"{number}.xml").write_text(f"<mujoco>{text}</mujoco>")
    (tmp_path / "24.xml").write_text(last)
    outcome = twinform("check", "0.xml", folder=tmp_path)
    assert "Traceback" not in outcome.output
    assert set(_RULE.findall(outcome.output)) == expected, outcome.output[:2000]


def test_5000_includes_take_linear_time(tmp_path: Path) -> None:
    for number in range(5_000):
        (tmp_path / f"{number}.xml").write_text(f"<mujocoinclude>{_GEOM}</mujocoinclude>")
    (tmp_path / "r.xml").write_text(_world("".join(f'<include file="{number}.xml"/>' for number in range(5_000))))
    outcome = twinform("check", "r.xml", folder=tmp_path)
    assert outcome.code == 0, outcome.output[:2000]
