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


def test_a_feature_has_its_file_and_what_every_profile_says(run: Run) -> None:
    done = run("explain", "shapes/size-zero")
    assert done.exit_code == 0
    assert done.stdout.startswith("shapes/size-zero (URDF)\nA box with a side of 0: Is it taken?\n\n<robot")
    assert "  MuJoCo 3.x to 4.0: refuses: a shape has a size\n" in done.stdout
    assert "  Gazebo Classic 11: nothing is known\n" in done.stdout
    assert done.stdout.endswith("docs/reference/who_reads_what/shapes.md#size-zero\n")


def test_an_unknown_feature_exits_2_with_the_nearest_name(run: Run) -> None:
    done = run("explain", "joints/mimik")
    assert (done.exit_code, done.stdout) == (2, "")
    assert "did you mean 'joints/mimic'?" in done.stderr
