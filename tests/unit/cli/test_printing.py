"""Printing: one place, and nothing in a text for people that a terminal would obey."""

import re
from pathlib import Path

import pytest

import twinform
from twinform.cli.printing import print_document, print_line, print_text, styled

_ROOT = Path(twinform.__file__).parent / "cli"
_ANOTHER_WAY = re.compile(r"click\.(secho|echo|style)\b|sys\.std(out|err)\.(write|buffer)|(?<![\w.])print\(")


def test_commands_print_in_one_place() -> None:
    files = [file for file in _ROOT.rglob("*.py") if _ANOTHER_WAY.search(file.read_text(encoding="utf-8"))]
    assert files == [_ROOT / "printing.py"]


def test_a_text_keeps_its_lines_and_a_line_is_one(capsysbinary: pytest.CaptureFixture[bytes]) -> None:
    print_text("a\tb\n\x1b[1m\udcff\r")
    print_line("a\nb")
    assert capsysbinary.readouterr().out == b"a\tb\n\\x1b[1m\\udcff\\r\na\\nb\n"


def test_styles_are_for_terminals(capsysbinary: pytest.CaptureFixture[bytes]) -> None:
    print_text(styled("a", "red"), err=True)
    assert capsysbinary.readouterr().err == b"a\n"


def test_a_document_is_printed_as_it_is(capsysbinary: pytest.CaptureFixture[bytes]) -> None:
    print_document("\x9b\u202e\r\n")
    print_document(b"\xff\x1b")
    assert capsysbinary.readouterr().out == "\x9b\u202e\r\n".encode() + b"\xff\x1b"
