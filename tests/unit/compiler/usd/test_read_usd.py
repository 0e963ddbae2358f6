"""USD files as stages of layers: what they name is read by the rules for files, and what is broken is reported."""

import os
import zipfile
from pathlib import Path

import pytest
from click.testing import CliRunner

import twinform
from tests.snippets import INERTIAL
from twinform.cli import main
from twinform.diagnostics import Diagnostic
from twinform.installation import install_command
from twinform.passes.mesh_jobs.job import MeshJob, MeshResult

Sdf = pytest.importorskip("pxr.Sdf", reason="usd-core is not installed")

URDF = f'<robot name="r"><link name="a">{INERTIAL}</link></robot>'.encode()
_MASS = "float physics:mass = 1\nfloat3 physics:diagonalInertia = (1, 1, 1)"
_BODY = 'prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]'
HEAD = '#usda 1.0\n(\n    defaultPrim = "r"\n    metersPerUnit = 1\n    upAxis = "Z"\n)\n'


def body(name: str, inside: str = "", head: str = _BODY) -> str:
    return f'def Xform "{name}" ({head})\n{{\n{_MASS}\n{inside}\n}}\n'


def robot(inside: str) -> str:
    return f'{HEAD}def Xform "r"\n{{\n{inside}\n}}\n'


STAGE = robot(body("a"))


def refused(path: Path | bytes) -> tuple[Diagnostic, ...]:
    with pytest.raises(twinform.CompileError) as caught:
        twinform.diff(URDF, path)
    return caught.value.diagnostics


def rule_names(path: Path | bytes) -> list[str]:
    return [each.rule.name for each in refused(path)]


def _project(folder: Path, text: str = STAGE, name: str = "robot.usda") -> Path:
    (folder / "twinform.toml").touch()
    path = folder / name
    path.write_text(text)
    return path


def test_a_text_is_read_whatever_way_it_comes(tmp_path: Path) -> None:
    path = _project(tmp_path)
    assert twinform.diff(URDF, path).same
    assert twinform.diff(path, URDF).same
    assert twinform.diff(URDF, STAGE.encode()).same
    assert twinform.diff(path, path).same


def test_a_binary_layer_says_the_same_as_its_text(tmp_path: Path) -> None:
    _write_binary(tmp_path / "robot.usdc")
    assert (tmp_path / "robot.usdc").read_bytes().startswith(b"PXR-USDC")
    assert twinform.diff(URDF, tmp_path / "robot.usdc").same


def _write_binary(path: Path) -> None:
    made = Sdf.Layer.CreateAnonymous("text.usda")
    made.ImportFromString(STAGE)
    made.Export(str(path))


def test_a_package_is_read_with_all_that_is_in_it(tmp_path: Path) -> None:
    _package(tmp_path / "robot.usdz", {"robot.usda": _referring("./parts/a.usda"), "parts/a.usda": STAGE})
    assert twinform.diff(URDF, tmp_path / "robot.usdz").same
    _package(tmp_path / "lost.usdz", {"robot.usda": _referring("../robot.usda"), "parts/a.usda": STAGE})
    (found,) = refused(tmp_path / "lost.usdz")
    assert found.rule.name == "unresolved-uri"
    assert "is not in the package" in found.message


def _package(path: Path, members: dict[str, str], compression: int = zipfile.ZIP_STORED) -> None:
    with zipfile.ZipFile(path, "w", compression) as package:
        for name, text in members.items():
            package.writestr(name, text)


def _referring(asset: str) -> str:
    return robot(f'def Xform "held" (prepend references = @{asset}@)\n{{\n}}')


def test_layers_are_found_beside_the_one_that_names_them(tmp_path: Path) -> None:
    path = _project(tmp_path, _referring("./parts/first.usda"))
    (tmp_path / "parts").mkdir()
    (tmp_path / "parts/first.usda").write_text(_referring("second.usda"))
    (tmp_path / "parts/second.usda").write_text(STAGE)
    assert twinform.diff(URDF, path).same


@pytest.mark.parametrize("arc", ["prepend references", "prepend payload"])
def test_a_layer_that_is_nowhere_is_reported_where_it_is_named(tmp_path: Path, arc: str) -> None:
    path = _project(tmp_path, robot(f'def Xform "held" (\n{arc} = @./nowhere.usda@)\n{{\n}}'))
    (found,) = refused(path)
    assert found.rule.name == "unresolved-uri"
    assert "'./nowhere.usda' is not found" in found.message
    assert (found.location.file, found.location.line) == (str(path), path.read_text().split("@")[0].count("\n") + 1)


@pytest.mark.parametrize("asset", ["../secret.usda", "link.usda", "{}/secret.usda", "file://{}/secret.usda"])
def test_a_layer_outside_of_the_root_is_not_read(tmp_path: Path, asset: str) -> None:
    (tmp_path / "secret.usda").write_text(STAGE)
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine/link.usda").symlink_to(tmp_path / "secret.usda")
    path = _project(tmp_path / "mine", _referring(asset.format(tmp_path)))
    (found,) = refused(path)
    assert found.rule.name == "uri-leaves-folder"


@pytest.mark.parametrize("asset", ["/etc/hostname", "http://example.org/a.usda", "https://x/a.usda", "/dev/zero", ""])
def test_nothing_else_is_looked_up(tmp_path: Path, asset: str) -> None:
    inside = f'def Xform "held" (prepend references = @{asset}@</r>)\n{{\n}}'
    assert set(rule_names(_project(tmp_path, robot(inside)))) <= {
        "unresolved-uri",
        "uri-leaves-folder",
        "unreadable-file",
        "no-links",
    }


def test_a_folder_and_a_pipe_are_no_layers(tmp_path: Path) -> None:
    (tmp_path / "folder.usda").mkdir()
    os.mkfifo(tmp_path / "pipe.usda")
    for name in ("folder.usda", "pipe.usda"):
        (found,) = refused(_project(tmp_path, _referring(f"./{name}")))
        assert found.rule.name == "unreadable-file"
        assert f"the layer names './{name}': " in found.message


def test_clips_and_variants_open_no_file(tmp_path: Path) -> None:
    (tmp_path / "clip.usda").write_text(STAGE)
    clips = 'clips = { dictionary default = { asset[] assetPaths = [@./clip.usda@]\nstring primPath = "/r"\n} }'
    assert twinform.diff(URDF, _project(tmp_path, robot(body("a", head=f"{_BODY}\n{clips}")))).same
    variant = 'variantSet "v" = { "x" (prepend references = @./gone.usda@) { } }'
    text = robot(body("a", variant, f'{_BODY}\nvariants = {{ string v = "x" }}\nprepend variantSets = "v"'))
    assert rule_names(_project(tmp_path, text)) == ["unresolved-uri"]


@pytest.mark.parametrize("text", [b"#usda 1.0\n}", b"PXR-USDC"])
def test_bytes_that_are_broken_are_no_missing_file(text: bytes) -> None:
    with pytest.raises(twinform.CompileError) as caught:
        twinform.diff(URDF, text)
    assert not isinstance(caught.value, FileNotFoundError)
    with pytest.raises(twinform.CompileError) as caught:
        twinform.convert(text, to="sdf")
    assert [each.rule.name for each in caught.value.diagnostics] == ["usd-only-compared"]
    assert not isinstance(caught.value, FileNotFoundError)


@pytest.mark.parametrize(
    ("name", "content", "message"),
    [
        ("a.usda", b"", "the file is empty"),
        ("a.usdz", b" \n", "the file is empty"),
        ("a.usda", b"hello", "cannot read it as USD"),
        ("a.usda", b"#usda 1.0\ndef Xform {", "cannot read it as USD"),
        ("a.usda", b"#usda 1.0\n\xff\xfe", "neither a text of USD in UTF-8 nor a binary layer"),
        ("a.usdc", b"PXR-USDC", "cannot read it as USD"),
        ("a.usdc", b"PXR-USDC\0\x08\0\0\0\0\0\0" + b"\xff" * 200, "cannot read it as USD"),
        ("a.usdz", b"PK\3\4" + bytes(40), "the package is broken"),
    ],
)
def test_what_is_broken_is_said(tmp_path: Path, name: str, content: bytes, message: str) -> None:
    (tmp_path / name).write_bytes(content)
    (found,) = refused(tmp_path / name)
    assert found.rule.name == "unreadable-file"
    assert message in found.message


def test_a_compressed_package_is_refused(tmp_path: Path) -> None:
    _package(tmp_path / "a.usdz", {"robot.usda": STAGE + " " * 9999}, zipfile.ZIP_DEFLATED)
    assert "is compressed" in refused(tmp_path / "a.usdz")[0].message


def test_a_binary_layer_that_was_cut_off_is_refused(tmp_path: Path) -> None:
    _write_binary(tmp_path / "robot.usdc")
    content = (tmp_path / "robot.usdc").read_bytes()
    for size in range(8, len(content), len(content) // 12):
        (tmp_path / "cut.usdc").write_bytes(content[:size])
        assert rule_names(tmp_path / "cut.usdc") == ["unreadable-file"]


def test_a_reference_to_a_prim_that_is_not_there_is_an_error(tmp_path: Path) -> None:
    (tmp_path / "part.usda").write_text(STAGE)
    inside = 'def Xform "held" (prepend references = @./part.usda@</other>)\n{\n}'
    (found,) = refused(_project(tmp_path, robot(inside)))
    assert "cannot be composed" in found.message


def test_layers_that_name_each_other_are_an_error(tmp_path: Path) -> None:
    (tmp_path / "part.usda").write_text(_referring("./robot.usda"))
    assert set(rule_names(_project(tmp_path, _referring("./part.usda")))) == {"unreadable-file"}


@pytest.mark.parametrize(
    ("line", "what"),
    [
        ("float physics:mass = nan", "physics:mass"),
        ("float physics:mass = inf", "physics:mass"),
        ('double3 xformOp:translate = (nan, 0, 0)\nuniform token[] xformOpOrder = ["xformOp:translate"]', "transform"),
    ],
)
def test_numbers_that_are_not_finite_are_reported_at_their_prim(tmp_path: Path, line: str, what: str) -> None:
    text = robot(body("a").replace("float physics:mass = 1", line))
    (found,) = refused(_project(tmp_path, text))
    assert found.rule.name == "invalid-value"
    assert what in found.message
    assert found.location.path == "/r/a"


def test_a_joint_between_bodies_that_are_not_there_is_reported(tmp_path: Path) -> None:
    joint = 'def PhysicsFixedJoint "j"\n{\nrel physics:body0 = </r/a>\nrel physics:body1 = </r/gone>\n}'
    (found,) = refused(_project(tmp_path, robot(body("a") + joint)))
    assert (found.rule.name, found.location.path) == ("dangling-link", "/r/j")


def test_a_stage_without_bodies_has_no_robot(tmp_path: Path) -> None:
    assert rule_names(_project(tmp_path, robot('def Xform "a" {\n}'))) == ["no-links"]


def test_instances_in_instances_are_counted_before_they_fill_the_memory(tmp_path: Path) -> None:
    classes = "".join(
        f'class Xform "c{level}"\n{{\n'
        + "".join(
            f'def Xform "x{at}" (instanceable = true\nprepend inherits = </c{level - 1}>)\n{{\n}}\n' for at in range(10)
        )
        + "}\n"
        for level in range(1, 9)
    )
    text = f'{STAGE}class Xform "c0"\n{{\n}}\n{classes}def Xform "all" (prepend inherits = </c8>)\n{{\n}}\n'
    (found,) = refused(_project(tmp_path, text))
    assert "more than 100,000 prims" in found.message


def test_all_layers_together_are_held_to_the_limit(tmp_path: Path) -> None:
    path = _project(tmp_path, _referring("./part.usda"))
    (tmp_path / "part.usda").write_text(STAGE + "#" * 2000)
    with pytest.raises(twinform.CompileError) as caught:
        twinform.diff(URDF, path, max_size=2000)
    assert [each.rule.name for each in caught.value.diagnostics] == ["oversized-file"]


def _arm(name: str, links: int) -> str:
    root = _BODY.replace("]", ', "PhysicsArticulationRootAPI"]')
    parts = [body("a", head=root), *(body(f"l{at}") for at in range(1, links))]
    joint = 'def PhysicsFixedJoint "j{1}"\n{{\nrel physics:body0 = </w/{0}/a>\nrel physics:body1 = </w/{0}/l{1}>\n}}\n'
    joints = (joint.format(name, at) for at in range(1, links))
    return f'def Xform "{name}"\n{{\n{"".join(parts)}{"".join(joints)}}}\n'


def test_of_several_articulations_the_largest_is_compared_or_the_one_that_is_named(tmp_path: Path) -> None:
    path = _project(tmp_path, f'{HEAD}def Xform "w"\n{{\n{_arm("small", 1)}{_arm("large", 2)}}}\n')
    assert [each.name for each in twinform.diff(URDF, path).differences] == ["l1", "j1"]
    assert twinform.diff(URDF, path, model="small").same


def test_articulations_with_the_names_of_one_robot_are_that_robot(tmp_path: Path) -> None:
    arms = _arm("left", 2) + _arm("right", 2).replace('"a"', '"b"').replace("/a>", "/b>").replace("l1", "m1").replace(
        "j1", "k1"
    )
    path = _project(tmp_path, f'{HEAD}def Xform "w"\n{{\n{arms}}}\n')
    links = "".join(f'<link name="{name}">{INERTIAL}</link>' for name in ("w", "a", "b", "l1", "m1"))
    joint = '<joint name="{}" type="fixed"><parent link="{}"/><child link="{}"/></joint>'
    joints = "".join(
        joint.format(*each) for each in (("x", "w", "a"), ("y", "w", "b"), ("j1", "a", "l1"), ("k1", "b", "m1"))
    )
    found = twinform.diff(f'<robot name="r">{links}{joints}</robot>'.encode(), path)
    assert {each.name for each in found.differences if not each.aspect} == {"w", "x", "y"}


def test_bodies_in_each_other_are_one_robot_whatever_else_is_said_of_them(tmp_path: Path) -> None:
    root = _BODY.replace("]", ', "PhysicsArticulationRootAPI"]')
    path = _project(tmp_path, robot(body("a", body("b", head=root), head=root)))
    assert [each.name for each in twinform.diff(URDF, path).differences] == ["b"]


def test_a_library_that_is_not_installed_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    class Missing:
        def do(self, _: MeshJob) -> MeshResult:
            return MeshResult({}, trouble="missing", message="pxr")

    monkeypatch.setattr("twinform.passes.mesh_jobs.child_process.usd", Missing)
    (found,) = refused(_project(tmp_path))
    assert (found.rule.name, found.help) == ("usd-reader-missing", f"run: {install_command('usd')}")


@pytest.mark.parametrize("words", [["convert", "--to", "urdf"], ["check"], ["graph"], ["stats"]])
def test_no_other_command_reads_usd(tmp_path: Path, words: list[str]) -> None:
    path = _project(tmp_path)
    done = CliRunner().invoke(main, [*words, str(path)])
    assert done.exit_code in {1, 2}
    assert "usd-only-compared" in done.output + done.stderr
    assert path.read_text() == STAGE
