"""What a configuration or a reproducer of somebody else may do: read what lies beside it, and write nothing."""

import json
import os
from pathlib import Path

import pytest
from pydantic import BaseModel

from twinform.cli.config_settings import FileSettings, FormatSettings, ProjectSettings
from twinform.cli.config_trust import HELD, is_own

from .conftest import GOOD, Run

BRIDGE = "bridge-config{file=bridge.yaml}"
HEADER = "# Made by twinform for ros_gz_bridge"


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A project of the caller's own, as the current folder, in a folder that is not its business."""
    project = tmp_path / "project"
    project.mkdir()
    (project / "r.urdf").write_text(GOOD)
    (tmp_path / "outside").mkdir()
    (tmp_path / "outside/other.urdf").write_text(GOOD.replace("base", "palm"))
    monkeypatch.chdir(project)
    return project


@pytest.fixture
def foreign(monkeypatch: pytest.MonkeyPatch) -> None:
    """The caller is somebody else than the owner of the files."""
    monkeypatch.setattr("twinform.cli.config_trust._ADMINISTRATOR", -1)
    monkeypatch.setattr(os, "geteuid", lambda: 12345)


def configure(text: str, folder: str = ".") -> None:
    Path(folder, "twinform.toml").write_text(text)


CONFIGURED = {"for all": (f"passes = '{BRIDGE}'", ()), "by name": (f"[pipelines]\nb = '{BRIDGE}'", ("--passes", "@b"))}


@pytest.mark.parametrize(("text", "words"), CONFIGURED.values(), ids=CONFIGURED.keys())
def test_a_pass_of_ones_own_configuration_writes_below_the_result(
    run: Run, here: Path, text: str, words: tuple[str, ...]
) -> None:
    configure(text)
    assert run("convert", "r.urdf", "-o", "out/r.sdf", *words).exit_code == 0
    assert Path("out/bridge.yaml").read_text().startswith(HEADER)
    assert not Path("bridge.yaml").exists()


@pytest.mark.usefixtures("foreign")
@pytest.mark.parametrize(("text", "words"), CONFIGURED.values(), ids=CONFIGURED.keys())
def test_a_pass_of_somebody_elses_configuration_writes_nothing(
    run: Run, here: Path, text: str, words: tuple[str, ...]
) -> None:
    configure(text)
    done = run("convert", "r.urdf", "-o", "out/r.sdf", *words)
    assert (done.exit_code, Path("out").exists()) == (2, False)
    assert f"type --passes '{BRIDGE}' yourself, or give --trust-config" in done.stderr
    assert run("convert", "r.urdf", "-o", "out/r.sdf", "--passes", BRIDGE).exit_code == 0
    Path("out/bridge.yaml").unlink()
    for order in (("--trust-config", *words), (*words, "--trust-config")):
        assert run("convert", "r.urdf", "-o", "out/r.sdf", *order).exit_code == 0
        assert Path("out/bridge.yaml").exists()


@pytest.mark.usefixtures("foreign")
def test_passes_of_somebody_elses_configuration_are_listed_and_the_others_run(run: Run, here: Path) -> None:
    configure(f"passes = 'check-inertia'\n[pipelines]\nb = '{BRIDGE}'")
    assert f"@b\n    {BRIDGE}" in run("passes").stdout
    assert run("convert", "r.urdf", "-o", "r.sdf").exit_code == 0


def test_a_file_is_somebody_elses_by_owner_or_by_who_may_write(here: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    file = Path("twinform.toml")
    file.write_text("")
    assert is_own(file)
    file.chmod(0o666)
    assert not is_own(file)
    file.chmod(0o664)  # the group is often the caller's own
    here.chmod(0o777)
    assert not is_own(file)
    here.chmod(0o1777)  # as /tmp: nobody can replace it
    assert is_own(file)
    Path("link.toml").symlink_to(file)
    assert is_own(Path("link.toml"))
    assert not is_own(Path("missing.toml"))
    monkeypatch.delattr(os, "geteuid")  # a system without such owners
    assert not is_own(file)


NOT_BELOW = [
    "home/.bashrc",
    "../b.yaml",
    "/tmp/b.yaml",
    "a/../../b.yaml",
    "~/b.yaml",
    ".git/b.yaml",
    "",
    "a//b.yaml",
    "a\\..\\b.yaml",
]


@pytest.mark.parametrize("file", NOT_BELOW)
@pytest.mark.parametrize("configured", [True, False])
def test_a_pass_names_no_file_elsewhere(run: Run, here: Path, file: str, configured: bool) -> None:
    pipeline = f"bridge-config{{file={json.dumps(file)}}}"
    configure(f"passes = '''{pipeline}'''" if configured else "")
    done = run("convert", "r.urdf", "-o", "r.sdf", *(() if configured else ("--passes", pipeline)))
    assert (done.exit_code, Path("r.sdf").exists()) == (2, False)
    assert "takes a path below the folder of the result" in done.stderr
    assert sorted(each.name for each in here.parent.iterdir()) == ["outside", "project"]


def test_a_pass_makes_yaml_only(run: Run, here: Path) -> None:
    done = run("convert", "r.urdf", "-o", "r.sdf", "--passes", "bridge-config{file=Makefile}")
    assert (done.exit_code, "takes the name of a YAML file" in done.stderr) == (2, True)


def test_a_pass_follows_no_link_out_of_the_folder(run: Run, here: Path) -> None:
    Path("out").mkdir()
    Path("out/away").symlink_to(here.parent / "outside")
    Path("out/alias.yaml").symlink_to(here.parent / "outside/new.yaml")
    os.mkfifo("out/pipe.yaml")
    for name in ("away/b.yaml", "alias.yaml", "pipe.yaml"):
        done = run("convert", "r.urdf", "-o", "out/r.sdf", "--passes", f"bridge-config{{file={name}}}")
        assert (done.exit_code, Path("out/r.sdf").exists()) == (2, False)
        assert f"{name} leads out of out, or to what is no file" in done.stderr
    assert [each.name for each in (here.parent / "outside").iterdir()] == ["other.urdf"]


@pytest.mark.parametrize("words", [(), ("-o", "-"), ("-o", "/dev/null")])
def test_a_pass_needs_a_result_to_write_beside(run: Run, here: Path, words: tuple[str, ...]) -> None:
    done = run("convert", "r.urdf", *words, "--to", "sdf", "--passes", BRIDGE)
    assert (done.exit_code, done.stdout) == (2, "")
    assert "bridge.yaml is to be written beside the result: name a file with -o" in done.stderr


def test_a_pass_replaces_only_what_twinform_has_written(run: Run, here: Path) -> None:
    Path("bridge.yaml").write_text("# by hand\n")
    words = ("convert", "r.urdf", "-o", "r.sdf", "--passes", BRIDGE)
    done = run(*words)
    assert (done.exit_code, Path("r.sdf").exists(), Path("bridge.yaml").read_text()) == (2, False, "# by hand\n")
    assert "bridge.yaml is there, and twinform has not written it" in done.stderr
    Path("bridge.yaml").unlink()
    for _ in range(2):
        assert run(*words).exit_code == 0
    assert Path("bridge.yaml").read_text().startswith(HEADER)


def test_a_file_of_a_pass_appears_with_the_result_or_not_at_all(run: Run, here: Path) -> None:
    Path("wrong.urdf").write_text(GOOD.replace("</robot>", '<link name="base"/></robot>'))
    assert run("convert", "wrong.urdf", "-o", "out/r.sdf", "--passes", BRIDGE).exit_code == 1
    assert (
        run("convert", "r.urdf", "-o", "out/r.sdf", "--passes", f"{BRIDGE},{ATTACH.format(file='none')}").exit_code == 1
    )
    assert not Path("out").exists()


def test_a_file_of_a_pass_is_for_one_input(run: Run, here: Path) -> None:
    done = run("convert", "r.urdf", "../outside/other.urdf", "-o", "out", "--passes", BRIDGE)
    assert (done.exit_code, Path("out").exists()) == (2, False)
    done = run("batch", "convert", ".", "../out", "--to", "sdf", "--passes", BRIDGE)
    assert (done.exit_code, Path("../out").exists()) == (2, False)
    assert "bridge-config makes a file beside a result, and a batch has many" in done.stderr


def _reproducer(pipeline: str, source: str) -> None:
    models: list[object] = [{"name": "r", "links": [{"name": "base"}]}]
    found: dict[str, object] = {
        "twinform": "0.1.0",
        "python": "3.11",
        "source": source,
        "fault": "exception",
        "error": "x",
        "traceback": "",
        "again": False,
        "document": {"format": "sdf", "version": "1.9", "models": models},
        "pipeline": pipeline,
    }
    Path("repro.json").write_text(json.dumps(found))


def test_a_reproducer_writes_nothing(run: Run, here: Path) -> None:
    for pipeline in (BRIDGE, 'bridge-config{file="/tmp/b.yaml"}', 'bridge-config{file="home/.bashrc"}'):
        _reproducer(pipeline, "r.sdf")
        before = sorted(here.parent.rglob("*"))
        assert run("reproduce", "repro.json").exit_code in {0, 2}
        assert sorted(here.parent.rglob("*")) == before


@pytest.mark.parametrize(
    ("file", "source"),
    [
        ("../outside/arm.sdf", "r.sdf"),
        ("{outside}/arm.sdf", "r.sdf"),
        ("away/arm.sdf", "r.sdf"),
        ("model://arm.sdf", "{outside}/r.sdf"),
        ("model://arm.sdf", "../outside/r.sdf"),
    ],
)
def test_a_reproducer_reads_nothing_outside_of_its_folder(run: Run, here: Path, file: str, source: str) -> None:
    outside = here.parent / "outside"
    outside.mkdir(exist_ok=True)
    (outside / "arm.sdf").write_text('<sdf version="1.9"><model name="arm"><link name="secret"/></model></sdf>')
    Path("away").symlink_to(outside)
    named = file.format(outside=outside)
    _reproducer(f"attach{{file='{named}' to=base}}", source.format(outside=outside))
    done = run("reproduce", "repro.json")
    assert "[unread-document]" in done.stderr or "[unresolved-uri]" in done.stderr, done.stderr
    assert "secret" not in done.stderr


def test_a_reproducer_reads_what_lies_beside_it_and_where_path_says(run: Run, here: Path) -> None:
    (here / "parts").mkdir()
    for folder in (here, here / "parts"):
        (folder / "arm.sdf").write_text('<sdf version="1.9"><model name="arm"><link name="a"/></model></sdf>')
    _reproducer("attach{file=arm.sdf to=base}", "/elsewhere/r.sdf")
    assert "[unread-document]" not in run("reproduce", "repro.json").stderr


LEAVING = {"up": "../outside", "absolute": "{outside}", "a link": "away", "up and down": "sub/../../outside"}


@pytest.mark.parametrize("path", LEAVING.values(), ids=LEAVING.keys())
def test_folders_of_a_configuration_stay_below_it(run: Run, here: Path, path: str) -> None:
    Path("sub").mkdir()
    Path("away").symlink_to(here.parent / "outside")
    path = path.format(outside=here.parent / "outside")
    configure(f"paths = ['sub', '.', 'sub/../sub', '{path}']")
    done = run("check", "r.urdf")
    assert done.exit_code == 2
    assert "twinform.toml: paths: " in done.stderr
    assert "leads out of the folder of the configuration; give --trust-config if this is meant" in done.stderr
    assert run("check", "r.urdf", "--trust-config").exit_code == 0
    assert run("check", "r.urdf", "--no-config").exit_code == 0
    assert run("check", "r.urdf", "--config", "twinform.toml").exit_code == 2


def test_a_home_folder_is_no_setting_of_a_configuration(run: Run, here: Path) -> None:
    configure("paths = ['~']")
    assert "is no folder" in run("check", "r.urdf").stderr


ATTACH = 'attach{{file="{file}" to=base}}'


@pytest.mark.parametrize("file", ["../outside/other.urdf", "{outside}/other.urdf", "away/other.urdf"])
def test_models_that_a_configuration_attaches_lie_below_it(run: Run, here: Path, file: str) -> None:
    Path("away").symlink_to(here.parent / "outside")
    pipeline = ATTACH.format(file=file.format(outside=here.parent / "outside"))
    configure(f"[pipelines]\nhand = '{pipeline}'")
    done = run("convert", "r.urdf", "--to", "urdf", "--passes", "@hand")
    assert (done.exit_code, done.stdout) == (1, "")
    assert "leads out of the folder of the configuration that names it; give --trust-config" in done.stderr
    named = ("--path", str(here.parent / "outside")) if file.startswith("away") else ()  # which is a link
    command = ("convert", "r.urdf", "--to", "urdf", *named, "--passes")
    assert "palm" in run(*command, "@hand", "--trust-config").stdout
    assert "palm" in run(*command, pipeline).stdout
    Path("hand.urdf").write_text(GOOD.replace("base", "palm"))
    configure(f"[pipelines]\nhand = '{ATTACH.format(file='hand.urdf')}'")
    assert "palm" in run("convert", "r.urdf", "--to", "urdf", "--passes", "@hand").stdout


@pytest.mark.parametrize("entry", ["folder", "file"])
def test_the_search_ends_at_the_top_of_the_repository(
    run: Run, here: Path, monkeypatch: pytest.MonkeyPatch, entry: str
) -> None:
    configure("strct = true", "..")
    below = here / "below"
    below.mkdir()
    monkeypatch.chdir(below)
    assert run("check", "../r.urdf").exit_code == 2
    if entry == "folder":
        (here / ".git").mkdir()
    else:
        (here / ".git").write_text("gitdir: elsewhere\n")
    assert run("check", "../r.urdf").exit_code == 0
    configure("strct = true", "../..")
    configure("strict = 1", "..")  # the top itself is looked at
    assert "strict: should be a valid boolean" in run("check", "../r.urdf").stderr


def test_the_search_ends_at_the_home_of_the_user(run: Run, here: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    configure("strct = true", "..")
    monkeypatch.setenv("HOME", str(here))
    assert run("check", "r.urdf").exit_code == 0
    configure("strct = true")
    assert run("check", "r.urdf").exit_code == 2


def test_every_setting_is_held_to_something_and_the_page_says_to_what() -> None:
    settings = {**_keys(ProjectSettings), **{f"files.{key}": "" for key in _keys(FileSettings)}}
    settings |= {f"format.{key}": "" for key in _keys(FormatSettings)}
    assert HELD.keys() == settings.keys() - {"files", "format"}
    page = (Path(__file__).parents[3] / "docs/how-to/set-up-a-project.md").read_text()
    rows = [line.strip("| \n").split(" | ") for line in page.splitlines() if line.startswith("| `")]
    said = {key.strip("`"): hold for keys, hold, *_ in rows for key in keys.split(", ")}
    assert said == HELD


def _keys(model: type[BaseModel]) -> dict[str, str]:
    return {field.alias or name: "" for name, field in model.model_fields.items()}


@pytest.mark.usefixtures("foreign")
def test_a_pass_of_another_package_is_nothing_for_somebody_elses_configuration(
    run: Run, here: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    configure("passes = 'check-limits'")
    assert run("convert", "r.urdf", "-o", "r.sdf").exit_code == 0
    monkeypatch.setattr("twinform.cli.config_trust.BUILT_IN", {})
    done = run("convert", "r.urdf", "-o", "r.sdf")
    assert done.exit_code == 2
    assert "check-limits comes from another package, and the configuration is somebody else's" in done.stderr
    assert run("convert", "r.urdf", "-o", "r.sdf", "--trust-config").exit_code == 0
