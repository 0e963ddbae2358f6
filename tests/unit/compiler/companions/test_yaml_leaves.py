"""YAML of companion files: values and their places; and files that are hostile, broken or no YAML at all."""

import time
from pathlib import Path

import pytest

from twinform.compiler.companions.check_companion import check_companion, is_companion
from twinform.compiler.companions.name_places import mentions
from twinform.compiler.companions.yaml_leaves import YamlError, read_yaml
from twinform.compiler.input.load_options import LoadOptions

_NODE = b"node:\n  ros__parameters:\n"


def _names(data: bytes) -> list[tuple[str, str]]:
    parameters = read_yaml(data)
    found = [(each.kind, each.text) for each in mentions(parameters.leaves)]
    assert all(each.place.of(parameters.text) == each.text for each in mentions(parameters.leaves))
    return found


@pytest.mark.parametrize(
    "text",
    [
        "joints: [hip, knee]",
        "joints:\n      - hip\n      - 'knee'",
        'joints: ["hip", # one\n      knee ]',
        "{joints: [hip, knee]}",
        "joints: &both [hip, knee]",
        "<<: {joints: [hip, knee]}",
        '"joints": [!!str hip, "knee"]',
    ],
)
def test_names_are_found_however_they_are_written(text: str) -> None:
    data = f"node:\n  ros__parameters:\n    {text}\n"
    assert _names(data.encode()) == [("driven joint", "hip"), ("driven joint", "knee")]
    assert _names(b"\xef\xbb\xbf# caf\xc3\xa9 \xf0\x9f\xa4\x96\r\n" + data.replace("\n", "\r\n").encode()) == [
        ("driven joint", "hip"),
        ("driven joint", "knee"),
    ]


def test_an_alias_means_the_values_that_it_stands_for() -> None:
    data = b"x: &both [hip, knee]\n/**:\n  node:\n    ros__parameters:\n      joints: *both\n"
    assert _names(data) == [("driven joint", "hip"), ("driven joint", "knee")]


def test_parameters_with_dots_are_the_steps_that_they_stand_for() -> None:
    data = _NODE + b"    gains.hip.p: 1.0\n    gains.hip.d: 0.1\n    constraints: {knee.goal: 0.1}\n"
    assert _names(data) == [("joint", "hip"), ("joint", "hip"), ("joint", "knee")]


_BOMB = "a0: &a0 [x, x]\n" + "".join(f"a{n}: &a{n} [{', '.join([f'*a{n - 1}'] * 9)}]\n" for n in range(1, 12))
_BROKEN = {
    "bomb": _BOMB.encode() + _NODE + b"    joints: *a11\n",
    "itself": _NODE + b"    joints: &j [hip, *j]\n",
    "deep": _NODE + b"    joints: " + b"[" * 20_000,
    "deep_blocks": _NODE + b"    joints:\n      " + b"- " * 2000,
    "nul": _NODE + b"    joints: [\0]\n",
    "latin": _NODE + b"    joints: [caf\xe9]\n",
    "binary": _NODE + bytes(range(256)) * 8,
    "open": _NODE + b"    joints: [hip, knee\n",
    "alias": _NODE + b"    joints: *nowhere\n",
    "tabs": _NODE + b"\tjoints: [hip]\n",
    "version": b"%YAML 9.9\n---\n" + _NODE + b"    joints: [hip]\n",
}


@pytest.mark.parametrize("name", _BROKEN)
def test_what_is_broken_or_hostile_is_one_finding_at_its_place(name: str, tmp_path: Path) -> None:
    path = tmp_path / "controllers.yaml"
    path.write_bytes(_BROKEN[name])
    started = time.process_time()
    with pytest.raises(YamlError):
        read_yaml(_BROKEN[name])
    assert is_companion(path, _BROKEN[name])
    (finding,) = check_companion(path, LoadOptions()).diagnostics
    assert (finding.rule.name, finding.location.line > 0) == ("broken-parameters", True)
    assert time.process_time() - started < 5


def test_tags_make_nothing_and_own_ones_are_for_xacro() -> None:
    data = _NODE + b"    joints: [!!python/name:os.system ls, hip]\n"
    assert _names(data) == [("driven joint", "ls"), ("driven joint", "hip")]
    path = Path("limits.yaml")
    assert not is_companion(path, b"joint_limits:\n  hip: {max_velocity: !degrees 90}\n")
    assert is_companion(path, b"joint_limits:\n  hip: {max_velocity: 1.5}\n")


def test_what_is_too_large_or_a_template_is_left_alone() -> None:
    data = _NODE + b"    joints: [hip]\n"
    path = Path("controllers.yaml")
    assert is_companion(path, data)
    assert not is_companion(path, data + b"# " + b"x" * 2**19)
    assert not is_companion(path, data + b"    x: {{ y }}\n")
    assert not is_companion(Path("controllers.txt"), data)
