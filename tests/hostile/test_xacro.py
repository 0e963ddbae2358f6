"""What xacro files may not do: leave their folders, write, start programs, or run without an end."""

import os
from collections.abc import Iterable
from pathlib import Path

import pytest

from tests.hostile.child import rules, twinform
from tests.hostile.xacro_escapes import BESIDE, ESCAPES
from tests.profile import DEEP

_NAMESPACE = 'xmlns:xacro="http://www.ros.org/wiki/xacro"'
_SECONDS = 30
"""For the command with a dozen files; each file has its own process besides."""
_KINDS = sorted({name.partition(":")[0] for name in ESCAPES})


def _doubling(levels: int) -> str:
    macros = [f'<xacro:macro name="m{n}"><xacro:m{n + 1}/><xacro:m{n + 1}/></xacro:macro>' for n in range(levels)]
    return "".join(macros) + f'<xacro:macro name="m{levels}"><link name="x"/></xacro:macro><xacro:m0/>'


FORBIDDEN = {
    "a device": ('<xacro:include filename="/dev/zero"/>', "outside of the folders"),
    "a pipe": ('<xacro:include filename="pipe"/>', "no file"),
    "including itself": ('<xacro:include filename="r.urdf.xacro"/>', "r.urdf.xacro includes r.urdf.xacro"),
    "a macro that calls itself": ('<xacro:macro name="m"><xacro:m/></xacro:macro><xacro:m/>', "without an end"),
    "properties in a circle": (
        '<xacro:property name="a" value="${b}"/><xacro:property name="b" value="${a}"/><link name="${a}"/>',
        "is defined by itself",
    ),
    "a million elements": ("<x/>" * 1_000_000, "tags"),
}
ENDLESS = {
    "macros that double": (_doubling(60), "more than 10 seconds of the processor"),
    "parameters that are torn apart": (f"<xacro:macro name='m' params='a:={'b' * 60}\"'/>", "more than 10 seconds"),
}


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    inside = tmp_path / "project"
    (inside / ".git").mkdir(parents=True)
    (tmp_path / "secret.yaml").write_text("a: 1")
    (inside / "link.yaml").symlink_to(tmp_path / "secret.yaml")
    os.mkfifo(inside / "pipe")
    for name, content in BESIDE.items():
        (inside / name).write_text(content)
    return inside


def _write(folder: Path, body: str, name: str = "r.urdf.xacro") -> str:
    (folder / name).write_text(f'<robot {_NAMESPACE} name="r"><link name="a"/>\n{body}\n</robot>')
    return name


def _lines(output: str, file: str) -> Iterable[str]:
    return [line for line in output.splitlines() if line.startswith(f"{file}:")]


@pytest.mark.parametrize("kind", _KINDS)
def test_an_escape_does_nothing_but_give_a_located_error(kind: str, folder: Path) -> None:
    chosen = [name for name in ESCAPES if name.startswith(f"{kind}:")][:: 1 if DEEP else 3]
    files = {_write(folder, ESCAPES[name][0], f"{n}.urdf.xacro"): name for n, name in enumerate(chosen)}
    before = sorted(folder.parent.rglob("*"))
    outcome = twinform("check", "--no-cache", *files, folder=folder, seconds=_SECONDS)
    assert outcome.code == 1
    for file, name in files.items():
        (line,) = _lines(outcome.output, file)
        assert line.endswith("[xacro-error]"), name
        assert any(words in line for words in ESCAPES[name][1].split("|")), name
        assert len(line) < 1500
    assert sorted(folder.parent.rglob("*")) == before
    assert all(Path(path).is_relative_to(folder) for path in outcome.opened)


@pytest.mark.parametrize("name", FORBIDDEN)
def test_xacro_is_kept_from(name: str, folder: Path) -> None:
    body, words = FORBIDDEN[name]
    outcome = twinform("check", _write(folder, body), folder=folder)
    assert (outcome.code, rules(outcome.output)) == (1, ["xacro-error"]), outcome.output[:2000]
    assert words in outcome.output
    assert len(outcome.output) < 5000


@pytest.mark.deep
@pytest.mark.parametrize("name", ENDLESS)
def test_what_has_no_end_is_stopped_where_it_is(name: str, folder: Path) -> None:
    body, words = ENDLESS[name]
    outcome = twinform("check", _write(folder, body), folder=folder, seconds=_SECONDS)
    assert (outcome.code, rules(outcome.output)) == (1, ["xacro-error"]), outcome.output[:2000]
    assert words in outcome.output
    assert outcome.output.startswith("r.urdf.xacro:2: ")


def test_without_xacro_nothing_of_it_is_looked_at(folder: Path) -> None:
    outcome = twinform("check", "--no-xacro", _write(folder, '<link name="${9**9**9}"/>'), folder=folder)
    assert (outcome.code, rules(outcome.output)) == (1, ["xacro-refused"])
    assert outcome.opened == frozenset()


def test_data_and_files_of_its_own_folder_may_be_read(folder: Path) -> None:
    (folder / "data.yaml").write_text("wheel: 0.3")
    (folder / "wheel_1.xacro").write_text(f'<robot {_NAMESPACE}><link name="part"/></robot>')
    load = "${xacro.load_yaml('data.yaml')['wheel']}"
    file = _write(folder, f'<xacro:include filename="wheel_*.xacro"/><link name="b{load}"/>')
    outcome = twinform("check", file, folder=folder)
    assert rules(outcome.output) == ["several-roots"]
    assert "'a', 'part', 'b0.3'" in outcome.output
