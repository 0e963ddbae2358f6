"""Files that are made and committed."""

from pathlib import Path

import pytest

from generators.__main__ import MADE, texts_of
from testbed.generated_files import marked, out_of_date, write


@pytest.mark.parametrize("target", MADE)
def test_what_is_committed_is_up_to_date(target: str) -> None:
    assert out_of_date(texts_of(target)) == []


def test_files_are_renewed_and_left_over_pages_go(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    texts = marked({tmp_path / name: f"# {name}\n\nText.\n" for name in ("a.md", "b.md", "in/c.py")})
    (tmp_path / "by_hand.md").write_text("# By hand\n")
    gone, old = tmp_path / "gone.md", tmp_path / "a.md"
    gone.write_text(texts[old])
    old.write_text("old")
    assert out_of_date(texts) == [gone, old, tmp_path / "b.md", tmp_path / "in/c.py"]
    assert f"{old} is out of date; run `make generate`\n" in capsys.readouterr().err
    write(texts)
    assert out_of_date(texts) == []
    assert sorted(each.name for each in tmp_path.iterdir()) == ["a.md", "b.md", "by_hand.md", "in"]
    assert old.read_text() == "# a.md\n\n<!-- Made by `make generate`; do not edit. -->\n\nText.\n"


def test_one_page_alone_says_nothing_of_those_beside_it(tmp_path: Path) -> None:
    other = marked({tmp_path / "other.md": "# Other\n"})
    write(other)
    write(marked({tmp_path / "one.md": "# One\n"}))
    assert out_of_date(other) == []
