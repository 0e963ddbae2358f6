"""Markdown: short, and read by a parser of it as nothing but what was meant."""

from pathlib import Path

from markdown_it import MarkdownIt
from markdown_it.token import Token

from twinform.report import build_report, markdown
from twinform.report.markdown import LARGEST, escaped

from .models import EVIL, EXAMPLES, WRONG, hostile, two_versions

_NAMES = (
    EVIL,
    "`code`",
    "a|b",
    "*bold* _it_ ~~no~~",
    "[link](http://example.org)",
    "![image](x)",
    "@somebody",
    "org/project#12",
    "https://example.org",
    "www.example.org",
    "<!-- -->",
    "&lt;b&gt;",
    "\\",
    "```",
    "# title",
    "> quote",
    "- item",
    "1. item",
    "GH-12",
)


def _tokens(text: str) -> list[Token]:
    found = MarkdownIt("commonmark").enable("table").enable("strikethrough").parse(text)
    return [inner for token in found for inner in (token, *(token.children or ()))]


def test_a_name_is_shown_as_it_is_and_does_nothing() -> None:
    for name in _NAMES:
        row = f"| a |\n| --- |\n| {escaped(name)} |\n"
        tokens = _tokens(row)
        kinds = {token.type for token in tokens if not token.type.startswith(("table", "thead", "tbody", "tr", "t"))}
        assert kinds <= {"inline", "text", "text_special"}, (name, kinds)
        words = "".join(token.content for token in tokens if token.type in {"text", "text_special"})
        assert words.removeprefix("a").replace("\u200b", "") == name


def test_github_makes_no_mention_issue_or_address_of_a_name() -> None:
    for name in ("@somebody", "project#12", "https://example.org", "www.example.org", "GH-12"):
        words = "".join(token.content for token in _tokens(escaped(name)) if token.type in {"text", "text_special"})
        assert name not in words
        assert words.replace("\u200b", "") == name


def test_the_verdict_comes_first_and_losses_are_listed() -> None:
    lines = markdown(build_report(EXAMPLES / "rover.urdf", EXAMPLES / "arm.urdf", view=None)).splitlines()
    assert lines[0] == "## rover \\(rover\\.urdf\\) compared with arm \\(arm\\.urdf\\)"
    assert "* different robots: 55 differences, 1 note" in lines
    assert "* rover\\.urdf in SDF: 478 expressed, 40 carried, 1 approximated, 0 dropped" in lines
    assert "<details><summary>Differences: 55</summary>" in lines
    assert "```mermaid" in lines
    assert "rover in rover\\.urdf: 9 links, 8 joints, 4 degrees of freedom, 10.44 kg" in lines


def test_two_versions_of_a_robot_are_told_apart_and_no_folder_is_named(tmp_path: Path) -> None:
    lines = markdown(build_report(*two_versions(tmp_path), view=None)).splitlines()
    before, after = (escaped(f"{name}/arm.urdf") for name in ("before", "after"))
    assert lines[0] == f"## arm \\({before}\\) compared with arm \\({after}\\)"
    assert [line.partition(":")[0] for line in lines if "links," in line] == [f"arm in {before}", f"arm in {after}"]
    assert escaped(str(tmp_path)) not in "\n".join(lines)


def test_errors_are_in_it() -> None:
    text = markdown(build_report(WRONG.encode(), view=None))
    assert "<details open><summary>Errors: 1</summary>" in text
    assert "joint \\'j\\' has the parent \\'bse\\', but there is no such link" in text


def test_hostile_names_open_nothing() -> None:
    text = markdown(build_report(hostile().encode(), hostile(mass=2).encode(), view=None))
    allowed = ("<details", "</details", "<summary")
    for token in _tokens(text):
        if token.type in {"html_block", "html_inline"}:
            assert all(line.startswith(allowed) for line in token.content.split("\n") if line), token.content
        assert token.type not in {"link_open", "image"}


def test_it_is_never_longer_than_a_comment_may_be() -> None:
    name = "\N{ROBOT FACE}" * 1000
    links = "".join(f'<link name="{name}{i}"><bad{i}/></link>' for i in range(200))
    text = markdown(build_report(f'<robot name="{name}">{links}</robot>'.encode(), view=None))
    assert len(text.encode()) <= LARGEST
    assert "more" in text
