"""The settings of a project."""

from pathlib import Path

import pytest

from .conftest import Run

LIMITLESS = """\
<robot name="r">
  <link name="a"/><link name="b"/>
  <joint name="j" type="revolute"><parent link="a"/><child link="b"/><limit lower="0" upper="1"/></joint>
</robot>
"""
FILL = ["convert", "limitless.urdf", "--to", "urdf", "--passes", "@fill"]


@pytest.fixture
def here(here: Path) -> Path:
    """The folder with the files and one more, as the current one."""
    (here / "limitless.urdf").write_text(LIMITLESS)
    return here


@pytest.mark.parametrize(
    "text",
    [
        "[pipelines]\nfill = 'fill-limits{effort=5 velocity=2}'",
        "[[pipelines.fill]]\npass = 'fill-limits'\neffort = 5\nvelocity = 2",
        "[pipelines]\nfill = [{pass = 'fill-limits', effort = 5}, {pass = '@fast'}]\nfast = 'fill-limits{velocity=2}'",
        "[pipelines]\nfill = '@strong,@fast'\nstrong = 'fill-limits{effort=5}'\nfast = 'fill-limits{velocity=2}'",
    ],
)
def test_a_pipeline_is_called_by_its_name(run: Run, here: Path, text: str) -> None:
    Path("twinform.toml").write_text(text)
    done = run(*FILL)
    assert done.exit_code == 0, done.stderr
    assert 'effort="5" velocity="2"' in done.stdout


def test_the_nearest_configuration_counts(run: Run, here: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    Path("twinform.toml").write_text("[pipelines]\nfill = 'fill-limits{effort=5 velocity=2}'")
    below = here / "below/further"
    below.mkdir(parents=True)
    monkeypatch.chdir(below)
    assert run("convert", here / "limitless.urdf", *FILL[2:]).exit_code == 0
    (here / "below/pyproject.toml").write_text("[project]\nname = 'twinform-user'")
    assert run("convert", here / "limitless.urdf", *FILL[2:]).exit_code == 0
    (here / "below/pyproject.toml").write_text("[tool.twinform.pipelines]\nfill = 'fill-limits{effort=7 velocity=2}'")
    assert 'effort="7"' in run("convert", here / "limitless.urdf", *FILL[2:]).stdout
    (here / "below/twinform.toml").write_text("[pipelines]\nfill = 'fill-limits{effort=9 velocity=2}'")
    assert 'effort="9"' in run("convert", here / "limitless.urdf", *FILL[2:]).stdout
    assert 'effort="5"' in run("convert", here / "limitless.urdf", *FILL[2:], "--config", here / "twinform.toml").stdout


def test_without_configuration_there_are_no_names(run: Run, here: Path) -> None:
    assert "no pipeline is called fill: no configuration names any" in run(*FILL).stderr
    Path("twinform.toml").write_text("[pipelines]\nfill = 'fill-limits'")
    done = run(*FILL, "--no-config")
    assert (done.exit_code, "no pipeline is called fill" in done.stderr) == (2, True)
    assert run(*FILL, "--no-config", "--config", "limitless.urdf").exit_code == 2


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("[pipelines\n", "twinform.toml:1: Expected ']' at the end of a table declaration"),
        ("a = 1\nb = \n", "twinform.toml:2: Invalid value"),
        ("[pipelins]\n", "twinform.toml: pipelins: there is no such key; did you mean pipelines?"),
        ("speed = 1\n", "twinform.toml: speed: there is no such key; there are allow, baseline, carriers, "),
        ("strict = 'yes'", "twinform.toml: strict: should be a valid boolean"),
        ("sdf-version = '2.0'", "twinform.toml: sdf-version: SDF has no version '2.0'; it has 1.2, "),
        ("urdf-version = '2.0'", "twinform.toml: urdf-version: should be '1.0', '1.1' or '1.2'"),
        ("pipelines = 1", "twinform.toml: pipelines: should be a valid table"),
        ("paths = ['nowhere']", "twinform.toml: paths: 'nowhere' is no folder"),
        ("allow = ['unknown-elemnt']", "allow: no rule is called unknown-elemnt; did you mean unknown-element?"),
        ("allow = ['unknown-element']\ndeny = ['unknown-element']", "unknown-element is allowed and denied"),
        ("passes = 'fill-limit'", "twinform.toml: passes: no pass is called fill-limit; did you mean fill-limits?"),
        ("passes = '@fil'\n[pipelines]\nfill = ''", "no pipeline is called fil in"),
        ("[pipelines]\nfill = 3", "twinform.toml: pipelines.fill: expected text, or a list of tables"),
        ("[pipelines]\nfill = 'fill-limits{efort=1}'", "pipelines.fill: fill-limits has no option efort"),
        ("[[pipelines.fill]]\npass = 'fill-limits'\nefort = 1", "twinform.toml: pipelines.fill[0].efort: fill-"),
        ("[pipelines]\n'a b' = ''", 'twinform.toml: pipelines."a b": the name of a pipeline takes letters'),
        ("[pipelines]\nfill = '@b'\nb = '@fill'", "a pipeline stands for itself: fill -> b -> fill"),
        ("[pipelines]\nfill = '@fill'", "a pipeline stands for itself: fill -> fill"),
        ("exclude = 'build'", "twinform.toml: exclude: should be a valid list"),
        ("[[files]]\nstrict = true", "twinform.toml: files[0].match: Field required"),
        ("[[files]]\nmatch = []", "twinform.toml: files[0].match: List should have at least 1 item"),
        ("[[files]]\nmatch = ['*.urdf']\nalow = []", "files[0].alow: there is no such key; did you mean allow?"),
        ("[[files]]\nmatch = ['*.urdf']\nallow = ['x']", "twinform.toml: files[0].allow: no rule is called x"),
        ("[[files]]\nmatch = ['!']", "twinform.toml: files[0].match: "),
        ("[[files]]\nmatch = ['*.urdf']\npasses = 'no'", "files[0].passes: no pass is called no"),
        (b"a = 1\n# \xff", "twinform.toml:2: the file is not UTF-8"),
        ("a = " + "[" * 100_000, "twinform.toml: it is nested too deeply"),
        ("#" * 2**21, "is larger than"),
    ],
)  # fmt: skip
def test_what_is_wrong_is_reported_with_its_place(run: Run, here: Path, text: str | bytes, complaint: str) -> None:
    Path("twinform.toml").write_bytes(text.encode() if isinstance(text, str) else text)
    arguments = FILL if "pipelines" in str(text) and "passes" not in str(text) else FILL[:4]
    done = run(*arguments)
    assert done.exit_code == 2
    assert complaint in done.stderr


def test_a_key_in_pyproject_has_its_whole_name(run: Run, here: Path) -> None:
    Path("pyproject.toml").write_text("[tool.twinform]\nstrct = true")
    assert "pyproject.toml: tool.twinform.strct: there is no such key; did you mean strict?" in run(*FILL).stderr
    Path("pyproject.toml").write_text("[tool]\ntwinform = 1")
    assert "pyproject.toml: tool.twinform: " in run(*FILL).stderr


def test_a_pyproject_that_is_named_has_to_have_our_table(run: Run, here: Path) -> None:
    Path("pyproject.toml").write_text("[project]\nname = 'a'")
    assert run("check", "good.urdf").exit_code == 0
    done = run("check", "good.urdf", "--config", "pyproject.toml")
    assert (done.exit_code, "pyproject.toml: tool.twinform: there is no such table" in done.stderr) == (2, True)


def test_settings_are_the_defaults_of_options(run: Run, here: Path) -> None:
    Path("twinform.toml").write_text(
        "sdf-version = '1.9'\ncarriers = false\nstrict = true\npasses = 'fill-limits{effort=4}'"
    )
    assert '<sdf version="1.9">' in run("convert", "good.urdf").stdout
    assert '<sdf version="1.10">' in run("convert", "good.urdf", "--sdf-version", "1.10").stdout
    assert run("convert", "good.urdf", "--to", "urdf").exit_code == 0
    assert run("check", "warned.urdf").exit_code == 1
    assert run("check", "warned.urdf", "--no-strict").exit_code == 0
    assert run("check", "warned.urdf", "--no-config").exit_code == 0
    assert run("convert", "good.urdf", "--print-pipeline").stdout.startswith("fill-limits{effort=4},")
    without_passes = run("convert", "good.urdf", "--print-pipeline", "--passes", "").stdout
    assert "fill-limits" not in without_passes
    assert "carry-urdf{carriers=false}" in without_passes


def test_folders_of_the_project_are_looked_in(run: Run, here: Path) -> None:
    (here / "project/stock/crate").mkdir(parents=True)
    (here / "project/stock/crate/model.config").write_text(
        '<model><name>crate</name><sdf version="1.11">model.sdf</sdf></model>'
    )
    (here / "project/stock/crate/model.sdf").write_text(
        '<sdf version="1.11"><model name="c"><link name="a"/></model></sdf>'
    )
    world = '<sdf version="1.11"><world name="w"><include><uri>model://crate</uri></include></world></sdf>'
    Path("world.sdf").write_text(world)
    (here / "project/twinform.toml").write_text("paths = ['stock']")
    assert run("check", "world.sdf", "--expand-includes").exit_code == 1
    assert run("check", "world.sdf", "--expand-includes", "--config", "project/twinform.toml").exit_code == 0


def test_findings_are_allowed_and_denied(run: Run, here: Path) -> None:
    assert run("check", "warned.urdf").exit_code == 0
    done = run("check", "warned.urdf", "--allow", "unknown-element")
    assert "unknown-element" not in done.stdout
    assert done.stderr.rstrip().endswith("; 1 allowed")
    assert run("check", "warned.urdf", "--deny", "unknown-element").exit_code == 1
    assert run("convert", "warned.urdf", "-o", "out.sdf", "--deny", "unknown-element").exit_code == 1
    assert not Path("out.sdf").exists()
    Path("twinform.toml").write_text("deny = ['unknown-element']")
    assert run("check", "warned.urdf").exit_code == 1
    assert run("check", "warned.urdf", "--allow", "unknown-element").exit_code == 0


def test_every_error_can_be_allowed(run: Run, here: Path) -> None:
    rules = {
        line.split("[")[-1].rstrip("]")
        for line in run("check", "wrong.urdf").stdout.splitlines()
        if ": error: " in line
    }
    assert rules
    done = run("check", "wrong.urdf", *(f"--allow={rule}" for rule in rules))
    assert (done.exit_code, "; 1 allowed" in done.stderr) == (0, True)
    done = run("check", "broken.urdf", "--allow", "not-well-formed")
    assert (done.exit_code, done.stdout, "1 could not be read; 1 allowed" in done.stderr) == (0, "", True)
    assert run("convert", "broken.urdf", "--to", "sdf", "--allow", "not-well-formed").exit_code == 2


def test_unknown_rules_are_wrong_usage(run: Run, here: Path) -> None:
    done = run("check", "good.urdf", "--deny", "unknown-elemnt")
    assert (done.exit_code, "did you mean unknown-element?" in done.stderr) == (2, True)


@pytest.mark.parametrize("line", ["max-size = '1kB'", "max-size = 1000", "max-tags = 9"])
@pytest.mark.usefixtures("here")
def test_limits_may_be_settings(run: Run, line: str) -> None:
    Path("twinform.toml").write_text(line)
    Path("good.urdf").write_text(Path("good.urdf").read_text() + "<!-- -->" * 200)
    done = run("check", "good.urdf")
    assert done.exit_code == 1
    assert "give a larger --max-" in done.stdout
    assert run("check", "good.urdf", "--max-size", "1MB", "--max-tags", "1000").exit_code == 0


@pytest.mark.parametrize(
    "line", ["max-size = 'many'", "max-size = 0", "max-size = true", "max-tags = 0", "max-tags = ''"]
)
@pytest.mark.usefixtures("here")
def test_limits_that_mean_nothing_are_no_settings(run: Run, line: str) -> None:
    Path("twinform.toml").write_text(line)
    done = run("check", "good.urdf")
    assert done.exit_code == 2
    assert f"twinform.toml: {line.partition(' ')[0]}" in done.stderr
