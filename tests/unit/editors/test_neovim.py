"""The settings for Neovim, in a real one."""

from pathlib import Path

import pytest

from testbed.editor.neovim import MISSING, PROGRAM, Neovim, neovim

pytestmark = [pytest.mark.slow, pytest.mark.skipif(PROGRAM is None, reason=MISSING)]
TEXT = '<robot name="r">\n  \n  <link name="base"/>\n  <link name="base"/>\n</robot>\n'
REST = [line.strip() for line in TEXT.splitlines()[2:]]


def type_in_second_line(one: Neovim, keys: str, line: str) -> None:
    one.keys(keys)
    # Neovim's own indentation of XML may change
    one.wait(lambda: [each.strip() for each in one.lines] == [TEXT.splitlines()[0], line, *REST])


def test_a_file_is_edited_with_findings_and_closing_tags(tmp_path: Path) -> None:
    file = tmp_path / "arm.urdf"
    file.write_text(TEXT, encoding="utf-8")
    with neovim(file) as one:
        assert one.lua("vim.bo.filetype") == "xml"
        one.wait(lambda: one.lua("#vim.diagnostic.get(0)"))
        assert "base" in one.lua("vim.diagnostic.get(0)[1].message")

        one.keys("2GA")
        type_in_second_line(one, '<lt>joint name="j"', '<joint name="j"')
        type_in_second_line(one, ">", '<joint name="j"></joint>')
        type_in_second_line(one, "<lt>axis><lt>/", '<joint name="j"><axis></axis></joint>')
        # the cursor is behind the end tag, inside of the element around it
        type_in_second_line(one, "!", '<joint name="j"><axis></axis>!</joint>')


def test_completion_writes_what_it_offers(tmp_path: Path) -> None:
    file = tmp_path / "arm.urdf"
    file.write_text(
        '<robot name="r">\n  <link name="base"/>\n  <joint name="j" type=""/>\n</robot>\n', encoding="utf-8"
    )
    with neovim(file) as one:
        one.keys('3G3f"a<C-x><C-o>')
        one.wait(lambda: one.lua("vim.fn.pumvisible()"))
        words = [each["word"] for each in one.lua("vim.fn.complete_info({ 'items' }).items")]
        assert "revolute" in words
