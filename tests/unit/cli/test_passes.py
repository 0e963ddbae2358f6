from twinform.passes import registered_passes

from .conftest import Run


def test_all_passes_are_listed_with_their_summaries(run: Run) -> None:
    lines = run("passes").stdout.splitlines()
    assert [line.split()[0] for line in lines] == list(registered_passes())
    assert all(line.endswith(".") for line in lines)


def test_page_has_options_types_defaults_and_an_example(run: Run) -> None:
    page = run("passes", "fill-limits").stdout
    assert page.startswith("fill-limits (from twinform)\n")
    assert "  effort: number (default: not set)\n      The greatest effort, in N m or N.\n" in page
    assert "  joints: text (default: *)\n" in page
    assert "Example\n  fill-limits{" in page
    assert "eps: number (default: 1e-06)" in run("passes", "check-inertia").stdout


def test_an_unknown_pass_exits_2(run: Run) -> None:
    done = run("passes", "fill-limit")
    assert done.exit_code == 2
    assert "there are" in done.stderr
