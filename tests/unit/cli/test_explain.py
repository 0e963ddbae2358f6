from twinform.diagnostics import catalog

from .conftest import Run

HEADINGS = ["What it finds", "Why it matters", "Example", "Better", "References"]


def test_every_rule_has_a_page_with_all_headings(run: Run) -> None:
    for name in catalog():
        done = run("explain", name)
        assert done.exit_code == 0
        lines = done.stdout.splitlines()
        assert lines[0].startswith(f"{name} (")
        assert [line for line in lines if line in HEADINGS] == HEADINGS, name


def test_without_a_rule_all_are_listed(run: Run) -> None:
    assert [line.split()[0] for line in run("explain").stdout.splitlines()] == list(catalog())


def test_an_unknown_rule_exits_2_with_the_nearest_names(run: Run) -> None:
    done = run("explain", "missing-elemnt")
    assert (done.exit_code, done.stdout) == (2, "")
    assert "the nearest are missing-element" in done.stderr
    assert "lists all" in run("explain", "zzzzzzzz").stderr
