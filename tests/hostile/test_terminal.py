"""Nothing that a stranger has written drives the terminal: no command prints a character that one would obey."""

import os
import unicodedata
from collections.abc import Iterator, Sequence
from pathlib import Path

import pytest

from tests.profile import DEEP
from tests.write_files import write_files

from .child import twinform
from .every_command import FILES, INVOCATIONS, run

_TEXT = "e\x9b31m\u202e\u2066\u200f\u061c\u2028\u2029v"
"""What may stand in XML."""
_NAME = f"{_TEXT}\x1b]0;title\x07\r\x7f\n::error::x\n##[error]x"
_UNDECODABLE = os.fsdecode(b"u\xff\x9b31m")
_MODEL = f"""\
<robot name="{_TEXT}" {_TEXT[-1]}="{_TEXT}">
  <!-- {_TEXT} -->
  <link name="{_TEXT}"><visual name="{_TEXT}"><geometry><mesh filename="{_TEXT}.stl"/></geometry></visual></link>
  <link name="{_TEXT}"><inertial><mass value="{_TEXT}"/></inertial></link>
  <joint name="{_TEXT}" type="{_TEXT}"><parent link="{_TEXT}"/><child link="{_TEXT}"/></joint>
  <gazebo reference="{_TEXT}"><{_TEXT[0]}>{_TEXT}</{_TEXT[0]}></gazebo>
</robot>
"""
_GOOD = f'<robot name="{_TEXT}"><link name="{_TEXT}"/></robot>'
_XACRO = f"""\
<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:arg name="a" default="{_TEXT}"/>
  <link name="$(arg a)"/>
  ${{xacro.warning('{_TEXT}' + chr(27))}} ${{unknown_{_TEXT[0]} + '{_TEXT}'}} $(optenv HOSTILE) $(find {_TEXT})
</robot>
"""
_FAULT = """\
{"twinform": "\\u001b[1m", "python": "", "source": "\\u009b\\u202e", "fault": "exception", "error": "\\u001b",
 "traceback": "\\u001b", "again": true, "pipeline": "%s",
 "document": {"models": [{"name": "m", "links": [{"name": "l"}]}]}}
"""
_CONFIGURATION = """\
["\\u001b]0;t\\u0007\\u009b\\u202e"]
"\\u001b" = "\\u001b"
["check"]
"\\u001b]0;t\\u0007\\u202e" = "\\u001b"
"""
_VALUES = """\
deny = ["\\u001b]0;t\\u0007\\u202e"]
check-passes = "\\u001b{"
[pipelines]
"\\u001b\\u202e" = "\\u001b"
"""
_NO_MENTION = "\u200b"
"""Stands in Markdown behind what GitHub would take for the number of an issue."""
_FILES = {
    f"{_NAME}.urdf": _MODEL,
    f"{_UNDECODABLE}.urdf": _GOOD,
    f"{_NAME}.urdf.xacro": _XACRO,
    f"{_NAME}.json": _FAULT % "fill-inertia",
    "pipeline.json": _FAULT % "\\u001b\\u202e",
    f"{_NAME}/good.urdf": _GOOD,
    f"{_NAME}.sdf": f'<sdf version="1.9"><model name="{_TEXT}"><link name="{_TEXT}"/><include><uri>model://{_TEXT}</uri>'
    f"</include></model></sdf>",
    f"{_NAME}.txt.urdf": "no model \x1b",
}


_FEW = (f"{_NAME}.urdf", f"{_NAME}.json")


def _obeyed(output: str) -> set[str]:
    """The characters in an output that drive a terminal, or that it cannot show."""
    found = {each for each in output if unicodedata.category(each) in {"Cc", "Cf", "Cs", "Zl", "Zp"}}
    return found - {"\n", "\t", _NO_MENTION}


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder whose files have hostile names and contents."""
    found = tmp_path_factory.mktemp("hostile")
    write_files(found, FILES)
    for name, text in _FILES.items():
        (found / name).parent.mkdir(exist_ok=True)
        (found / name).write_text(text, errors="surrogateescape")
    (found / f"{_NAME}-link.urdf").symlink_to(f"{_NAME}-nowhere")
    return found


def _calls(command: str, folder: Path) -> Iterator[Sequence[str]]:
    words = command.split()
    yield [*words, f"--{_NAME}"]
    yield [*words, f"{_NAME}-nowhere.urdf"]
    if DEEP:
        yield [*words, _NAME, "--path", _NAME]
    names = [each.name for each in sorted(folder.iterdir()) if each.name[0] in "eu"] if DEEP else _FEW
    if command in {"passes", "schema", "view", "fuel add", "fuel list"}:
        yield [*words, _UNDECODABLE]
    elif command == "reproduce":
        yield from ([*words, each] for each in names if each.endswith(".json"))
        yield [*words, "pipeline.json"]
    elif command == "diff":
        yield from ([*words, each, f"{_UNDECODABLE}.urdf"] for each in names)
    elif command == "explain":
        yield [*words, _UNDECODABLE]
    else:
        yield from ([*words, each] for each in names)


_WITH_OPTIONS = (
    *(["check", "--format", each] for each in ("concise", "github", "junit", "json", "sarif")),
    ["check", "--notes", "--all", "--for", "portable", "--deny", _TEXT],
    ["check", "--fix", "--diff"],
    ["format", "--check"],
    ["format", "--diff"],
    ["fix", "--diff"],
    ["convert", "--to", "sdf", "--ledger", "-", "--print-changes"],
    ["convert", "--to", "sdf", "--check", "-o", _NAME],
    ["convert", "--to", _NAME],
    ["convert", "--to", "sdf", "--passes", _NAME],
    ["convert", "--to", "sdf", "--passes", f"rename{{from='{_TEXT}',to=x}}"],
    ["graph", "--format", "dot"],
    ["report", "--format", "md"],
    ["package", "--kind", "both", "-o", "out"],
    ["stats", "--format", "json"],
)


_TALKERS = ("batch", "view", "lsp", "mcp")


@pytest.mark.parametrize("command", [each for each in INVOCATIONS if not each.startswith(_TALKERS)])
def test_a_command_escapes_what_strangers_wrote(command: str, folder: Path) -> None:
    for words in _calls(command, folder):
        done = twinform(*words, folder=folder)
        if command != "convert" or done.code:  # its result is the model's own
            assert not _obeyed(done.output), (words, done.output)
        assert "Traceback" not in done.output or command == "reproduce", (words, done.output)


@pytest.mark.parametrize(
    "words", _WITH_OPTIONS, ids=lambda words: " ".join(words[:3]).encode("unicode_escape").decode()
)
def test_options_change_nothing_about_it(words: Sequence[str], folder: Path) -> None:
    for name in (*_FEW, f"{_NAME}.urdf.xacro") if DEEP else _FEW[:1]:
        done = twinform(*words, name, folder=folder)
        if words[0] != "convert" or done.code:
            assert not _obeyed(done.output), (words, done.output)
        assert "Traceback" not in done.output, (words, done.output)
        assert "\n::error::x" not in done.output, done.output


@pytest.mark.parametrize("text", [_CONFIGURATION, _VALUES])
@pytest.mark.parametrize("command", ["check", "convert", "format", "passes", "batch check"])
def test_configurations_are_escaped(command: str, text: str, tmp_path: Path) -> None:
    write_files(tmp_path, FILES)
    (tmp_path / "twinform.toml").write_text(text)
    words = [
        *command.split(),
        *(["--to", "sdf"] if command == "convert" else []),
        *(["cube.urdf"] if command != "passes" else []),
    ]
    done = twinform(*words, folder=tmp_path)
    assert done.code
    assert not _obeyed(done.output), done.output


def test_a_batch_escapes_names_and_messages(folder: Path) -> None:
    done = run(["batch", "check", ".", "--jobs", "1"], folder)
    output = (done.output + done.errors).decode()
    assert "error::x" in output
    assert not _obeyed(output), output
    assert "\n::error::x" not in output
