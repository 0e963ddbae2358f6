"""`twinform format`."""

from pathlib import Path

import pytest

from .conftest import BROKEN, Run

UGLY = '<robot name="r"><!-- a --><link name="a"/>  <!-- the base -->\n\n\n\n</robot>'
NICE = '<robot name="r">\n  <!-- a -->\n  <link name="a"/>  <!-- the base -->\n\n\n</robot>\n'


@pytest.fixture
def files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with a file to be formatted, one that is, and one that is no XML."""
    monkeypatch.chdir(tmp_path)
    for name, text in {"ugly": UGLY, "nice": NICE, "broken": BROKEN}.items():
        Path(f"{name}.urdf").write_text(text)
    return tmp_path


def test_files_are_formatted(run: Run, files: Path) -> None:
    untouched = Path("nice.urdf").stat().st_mtime_ns
    done = run("format", "ugly.urdf", "nice.urdf")
    assert (done.exit_code, done.stdout, done.stderr) == (0, "", "1 file formatted, 1 unchanged\n")
    assert Path("ugly.urdf").read_text() == NICE
    assert Path("nice.urdf").stat().st_mtime_ns == untouched


def test_check_lists_what_would_change(run: Run, files: Path) -> None:
    done = run("format", "--check", "ugly.urdf", "nice.urdf")
    assert (done.exit_code, done.stdout, done.stderr) == (1, "ugly.urdf\n", "1 file would change, 1 unchanged\n")
    assert Path("ugly.urdf").read_text() == UGLY
    assert run("format", "--check", "nice.urdf").exit_code == 0


def test_diff_shows_what_would_change(run: Run, files: Path) -> None:
    done = run("format", "--diff", "ugly.urdf", "nice.urdf")
    assert done.exit_code == 1
    assert done.stdout.splitlines() == [
        "--- ugly.urdf",
        "+++ ugly.urdf",
        "@@ -1,5 +1,6 @@",
        '-<robot name="r"><!-- a --><link name="a"/>  <!-- the base -->',
        '+<robot name="r">',
        "+  <!-- a -->",
        '+  <link name="a"/>  <!-- the base -->',
        " ",
        " ",
        "-",
        "-</robot>",
        "\\ No newline at end of file",
        "+</robot>",
    ]
    assert Path("ugly.urdf").read_text() == UGLY


def test_standard_input_goes_to_standard_output(run: Run, files: Path) -> None:
    done = run("format", "-", text=UGLY.encode("utf-16"))
    assert (done.exit_code, done.stdout_bytes) == (0, NICE.encode("utf-16"))
    assert run("format", "--check", "-", text=UGLY).stdout == "<stdin>\n"


def test_what_is_no_xml_stays_and_the_others_are_formatted(run: Run, files: Path) -> None:
    done = run("format", "broken.urdf", "missing.urdf", "ugly.urdf")
    assert done.exit_code == 2
    assert "broken.urdf:3:3: error: not well-formed XML: " in done.stderr
    assert "missing.urdf: error: cannot read the file" in done.stderr
    assert done.stderr.endswith("1 file formatted, 0 unchanged, 2 could not be formatted\n")
    assert (Path("broken.urdf").read_text(), Path("ugly.urdf").read_text()) == (BROKEN, NICE)


@pytest.mark.parametrize(
    ("data", "complaint"),
    [
        (b"", "<stdin>: error: the file is empty"),
        (b"\n<?xml version='1.0'?><a/>", "<stdin>:2:1: error: not well-formed XML: <?xml ...?> does not stand at"),
        (b"<a><!-- -- --></a>", "<stdin>:1:9: error: not well-formed XML: "),
        (b"<!DOCTYPE a><a/>", "<stdin>:1:1: error: the document has a DOCTYPE"),
        (b"<?xml version='1.0' encoding='no-such'?><a/>", "<stdin>:1: error: the encoding 'no-such'"),
        (b"<a>\xff</a>", "<stdin>:1:4: error: not well-formed XML: "),
        (b'{"robot": 1}', "<stdin>:1:1: error: not well-formed XML: "),
        (b"<a><!" + b"-" * 100, "<stdin>:1:4: error: not well-formed XML: "),
    ],
)
def test_what_cannot_be_formatted_is_refused(run: Run, data: bytes, complaint: str) -> None:
    done = run("format", "-", text=data)
    assert (done.exit_code, done.stdout) == (2, "")
    assert complaint in done.stderr


def test_a_file_beyond_the_limit_is_refused(run: Run, files: Path) -> None:
    done = run("format", "--max-size", "10", "ugly.urdf")
    assert (done.exit_code, Path("ugly.urdf").read_text()) == (2, UGLY)
    assert "more than 10 bytes" in done.stderr


def test_a_file_that_must_not_be_written_stays(run: Run, files: Path) -> None:
    Path("ugly.urdf").chmod(0o444)
    done = run("format", "ugly.urdf")
    assert (done.exit_code, Path("ugly.urdf").read_text()) == (2, UGLY)
    assert "ugly.urdf is read-only" in done.stderr


def test_the_target_of_a_link_is_written_and_its_mode_stays(run: Run, files: Path) -> None:
    Path("ugly.urdf").chmod(0o640)
    Path("link.urdf").symlink_to("ugly.urdf")
    assert run("format", "link.urdf").exit_code == 0
    assert (Path("link.urdf").is_symlink(), Path("ugly.urdf").read_text()) == (True, NICE)
    assert Path("ugly.urdf").stat().st_mode & 0o777 == 0o640


def test_settings_say_how(run: Run, files: Path) -> None:
    Path("twinform.toml").write_text('[format]\nindent = "tab"\nnumbers = "shortest"\nsort-attributes = true\n')
    text = '<link name="a">\n\t<mass value="1.0" name="b"/>\n</link>\n'
    assert run("format", "-", text=text).stdout == '<link name="a">\n\t<mass name="b" value="1"/>\n</link>\n'
    spaced = text.replace("\t", "   ")
    assert run("format", "--indent", "3", "--numbers", "kept", "--no-sort-attributes", "-", text=text).stdout == spaced
    assert run("format", "--no-config", "-", text=text).stdout == text.replace("\t", "  ")


@pytest.mark.parametrize(
    ("line", "complaint"),
    [
        ("indent = 99", "format.indent"),
        ("indents = 2", "format.indents: there is no such key; did you mean indent?"),
        ("numbers = 1", "format.numbers"),
    ],
)
def test_settings_that_mean_nothing_are_refused(run: Run, files: Path, line: str, complaint: str) -> None:
    Path("twinform.toml").write_text(f"[format]\n{line}\n")
    done = run("format", "ugly.urdf")
    assert (done.exit_code, Path("ugly.urdf").read_text()) == (2, UGLY)
    assert complaint in done.stderr


def test_an_indent_that_means_nothing_is_wrong_usage(run: Run, files: Path) -> None:
    assert run("format", "--indent", "many", "ugly.urdf").exit_code == 2
