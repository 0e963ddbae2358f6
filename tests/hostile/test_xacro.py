"""What xacro files may not do: leave their folders, write, start programs, or run without an end."""

import os
from pathlib import Path

import pytest

from tests.hostile.child import rules, twinform

_NAMESPACE = 'xmlns:xacro="http://www.ros.org/wiki/xacro"'


def _use(expression: str) -> str:
    return f'<link name="${{{expression}}}"/>'


def _doubling(levels: int) -> str:
    macros = [f'<xacro:macro name="m{n}"><xacro:m{n + 1}/><xacro:m{n + 1}/></xacro:macro>' for n in range(levels)]
    return "".join(macros) + f'<xacro:macro name="m{levels}"><link name="x"/></xacro:macro><xacro:m0/>'


FORBIDDEN = {
    "classes behind a lambda": (_use("(lambda: ().__class__.__base__.__subclasses__())()"), "must not use"),
    "classes behind a list": (_use("[x.__class__ for x in (1,)]"), "must not use"),
    "frames of a generator": (_use("[g.gi_frame.f_back for g in [(i for i in (1,))]]"), "must not use"),
    "builtins of eval": ("<link name='$(eval __import__)'/>", "double underscore"),
    "opening a file": ("<link name='$(eval open)'/>", "not defined"),
    "reading data outside": (_use("xacro.load_yaml('/etc/passwd')"), "outside of the folders"),
    "reading data above": (_use("xacro.load_yaml('../secret.yaml')"), "outside of the folders"),
    "reading data through a link": (_use("xacro.load_yaml('link.yaml')"), "outside of the folders"),
    "reading a pipe": (_use("xacro.load_yaml('pipe')"), "it is no file"),
    "including a file outside": ('<xacro:include filename="/etc/passwd"/>', "outside of the folders"),
    "including a file above": ('<xacro:include filename="../secret.yaml"/>', "outside of the folders"),
    "including a device": ('<xacro:include filename="/dev/zero"/>', "no file"),
    "including a pipe": ('<xacro:include filename="pipe"/>', "no file"),
    "including itself": ('<xacro:include filename="r.urdf.xacro"/>', "without an end"),
    "a package with dots": ('<xacro:include filename="$(find ../../etc)/passwd"/>', "leads out"),
    "a macro that calls itself": ('<xacro:macro name="m"><xacro:m/></xacro:macro><xacro:m/>', "without an end"),
    "properties in a circle": (
        '<xacro:property name="a" value="${b}"/><xacro:property name="b" value="${a}"/><link name="${a}"/>',
        "circular",
    ),
    "a text beyond the memory": (_use("'x' * 10**13"), "more memory"),
    "a list beyond the memory": (_use("['x' * 10**6 + str(i) for i in python.range(10**12)]"), "more memory"),
    "a million elements": ("<x/>" * 1_000_000, "tags"),
}
STOPPED = {"a number without an end": _use("10**10**9"), "macros that double": _doubling(60)}


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    inside = tmp_path / "project"
    (inside / ".git").mkdir(parents=True)
    (tmp_path / "secret.yaml").write_text("a: 1")
    (inside / "link.yaml").symlink_to(tmp_path / "secret.yaml")
    os.mkfifo(inside / "pipe")
    return inside


def _write(folder: Path, body: str) -> None:
    (folder / "r.urdf.xacro").write_text(f'<robot {_NAMESPACE} name="r"><link name="a"/>\n{body}\n</robot>')


@pytest.mark.parametrize("name", FORBIDDEN)
def test_xacro_is_kept_from(name: str, folder: Path) -> None:
    body, words = FORBIDDEN[name]
    _write(folder, body)
    outcome = twinform("check", "r.urdf.xacro", folder=folder)
    assert (outcome.code, rules(outcome.said)) == (2, ["xacro-error"]), outcome.said[:2000]
    assert words in outcome.said
    assert len(outcome.said) < 5000


@pytest.mark.deep
@pytest.mark.parametrize("name", STOPPED)
def test_what_has_no_end_is_stopped(name: str, folder: Path) -> None:
    _write(folder, STOPPED[name])
    outcome = twinform("check", "r.urdf.xacro", folder=folder)
    assert (outcome.code, rules(outcome.said)) == (2, ["xacro-error"]), outcome.said[:2000]


def test_without_xacro_nothing_of_it_is_looked_at(folder: Path) -> None:
    _write(folder, _use("10**10**9"))
    outcome = twinform("check", "--no-xacro", "r.urdf.xacro", folder=folder)
    assert (outcome.code, rules(outcome.said)) == (2, ["xacro-refused"])
    assert outcome.opened == frozenset()


def test_data_and_files_of_its_own_folder_may_be_read(folder: Path) -> None:
    (folder / "data.yaml").write_text("wheel: 0.3")
    (folder / "part_1.xacro").write_text(f'<robot {_NAMESPACE}><link name="part"/></robot>')
    load = "${xacro.load_yaml('data.yaml')['wheel']}"
    _write(folder, f'<xacro:include filename="part_*.xacro"/><link name="b{load}"/>')
    outcome = twinform("check", "r.urdf.xacro", folder=folder)
    assert rules(outcome.said) == ["several-roots"]
    assert "'a', 'part', 'b0.3'" in outcome.said
