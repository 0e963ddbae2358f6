"""Somebody else's package: installed into an empty folder, its pass and its rule are there at once."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.distributions import write_distribution

pytestmark = pytest.mark.slow

_ROOT = Path(__file__).parents[1]
_ROBOT = '<robot name="r"><link name="Base Link"/></robot>'


@pytest.fixture(scope="session")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder that the example is installed into, without what it depends on and without a network."""
    source, folder = tmp_path_factory.mktemp("source") / "plugin", tmp_path_factory.mktemp("site")
    shutil.copytree(_ROOT / "examples/plugin", source)
    options = ["--quiet", "--disable-pip-version-check", "--no-index", "--no-deps", "--no-build-isolation"]
    install = [sys.executable, "-m", "pip", "install", *options, "--target", str(folder), str(source)]
    subprocess.run(install, check=True, capture_output=True)
    return folder


def twinform(site: str | Path, *arguments: str, text: str = "") -> subprocess.CompletedProcess[str]:
    """Run the command where the package is installed."""
    return subprocess.run(
        [sys.executable, "-m", "twinform", *arguments],
        cwd=_ROOT,
        env={**os.environ, "PYTHONPATH": str(site)},
        input=text,
        capture_output=True,
        text=True,
        check=False,
    )


def test_the_pass_is_listed_and_has_a_page(site: Path) -> None:
    listed = twinform(site, "passes").stdout
    assert "\ncheck-names (from twinform-house-style)\n    Find links and joints whose names" in f"\n{listed}"
    assert "  pattern: text (default: [a-z][a-z0-9_]*)" in twinform(site, "passes", "check-names").stdout.replace(
        '"', ""
    )


def test_the_pass_runs_in_a_pipeline_and_reports_by_its_rule(site: Path) -> None:
    done = twinform(site, "convert", "-", "--to", "sdf", "--passes", "check-names,check-inertia", text=_ROBOT)
    assert done.returncode == 0
    assert "warning: 'Base Link' is an unusual name [unusual-name]" in done.stderr
    denied = twinform(site, "convert", "-", "--passes", "check-names", "--deny", "unusual-name", text=_ROBOT)
    assert denied.returncode == 1


def test_its_fix_is_offered_and_applied(site: Path) -> None:
    robot = '<robot name="r"><link name="Base Link"/><gazebo reference="Base Link"/></robot>'
    arguments = ("check", "--fix", "--unsafe-fixes", "--passes", "check-names", "-")
    done = twinform(site, *arguments, text=robot)
    assert (done.returncode, done.stdout) == (0, robot.replace("Base Link", "base_link"))
    assert "fixed 1 x unusual-name" in done.stderr


def test_the_rule_has_a_page_and_names_who_brings_it(site: Path) -> None:
    page = twinform(site, "explain", "unusual-name").stdout
    assert page.startswith("unusual-name (warning) (from twinform-house-style)\n")
    assert "Scripts of the house" in page
    assert "unusual-name" in twinform(site, "explain").stdout


def test_our_own_pages_are_ours_alone(site: Path) -> None:
    check = [sys.executable, "-m", "generators", "docs/reference/passes.md", "docs/reference/rules.md", "--check"]
    subprocess.run(check, cwd=_ROOT, env={**os.environ, "PYTHONPATH": str(site)}, check=True)


@pytest.mark.parametrize(
    ("entry", "command", "complaint"),
    [
        (
            ("twinform.passes", "check-names", "late_comer:CheckNames"),
            "passes",
            "late-comer and twinform-house-style both register a pass called check-names",
        ),
        (
            ("twinform.passes", "check-inertia", "late_comer:CheckInertia"),
            "passes",
            "late-comer and twinform both register a pass called check-inertia",
        ),
        (
            ("twinform.rules", "unusual-name", "twinform_house_style.rules:UNUSUAL_NAME"),
            "explain",
            "late-comer and twinform-house-style both register a rule called unusual-name",
        ),
        (
            ("twinform.rules", "unknown-element", "twinform.diagnostics.rules:UNKNOWN_ELEMENT"),
            "explain",
            "twinform and late-comer both register a rule called unknown-element",
        ),
        (("twinform.rules", "gone", "no_such_module:GONE"), "explain", "late-comer registers the rule gone but"),
        (("twinform.rules", "path", "pathlib:Path"), "explain", "late-comer registers the rule path but pathlib:Path"),
    ],
)
def test_a_name_that_is_taken_names_both_owners(
    site: Path, tmp_path: Path, entry: tuple[str, str, str], command: str, complaint: str
) -> None:
    group, name, target = entry
    write_distribution(tmp_path, "late-comer", {name: target}, group=group)
    done = twinform(f"{site}{os.pathsep}{tmp_path}", command)
    assert done.returncode == 2
    assert complaint in done.stderr


def test_the_list_of_passes_for_programs_names_the_owner(site: Path) -> None:
    found = json.loads(twinform(site, "passes", "--format", "json").stdout)["passes"]
    assert {each["owner"] for each in found if each["name"] == "check-names"} == {"twinform-house-style"}
