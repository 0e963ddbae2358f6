"""How fast batches are, in seconds of processors, so that other work on the machine does not matter."""

from pathlib import Path

import pytest

from testbed.batches.runs import Folder, run
from twinform.compiler.batch import of_folder


@pytest.fixture
def folder(corpus: Path, tmp_path: Path) -> Folder:
    """All models of the corpus."""
    names = tmp_path / "names"
    names.write_text("\n".join(entry.path for entry in of_folder(corpus)))
    return Folder(tmp_path, names)


@pytest.mark.deep
def test_two_workers_are_nearly_twice_one_and_nothing_to_do_takes_no_time(folder: Folder) -> None:
    one = run(folder.command("one", "--jobs", "1"))
    two = run(folder.command("two", "--jobs", "2"))
    assert one.children / max(two.children / 2, two.own) >= 1.8  # where each process has a processor
    assert folder.results("one") == folder.results("two")
    idle = run(folder.command("two", "--jobs", "2"))
    assert idle.own < 4
    assert idle.children == 0
    assert idle.summary.endswith(f"({idle.summary.split()[0]} known from before)")
