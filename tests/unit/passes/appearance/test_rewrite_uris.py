"""URIs between schemes, where files are really there; round trips give the same."""

from pathlib import Path

import pytest

import twinform
from twinform.ir import Mesh, walk
from twinform.passes import parse_pipeline

ROBOT = "<robot name='r'><link name='a'>{}</link></robot>"
SHAPE = "<visual><geometry><mesh filename='{}'/></geometry></visual>"


@pytest.fixture
def package(tmp_path: Path) -> Path:
    """A package that is a model as well, with a mesh, and a robot in a folder of its own."""
    folder = tmp_path / "arm_1.2"
    for inner in ("meshes", "urdf"):
        (folder / inner).mkdir(parents=True)
    (folder / "package.xml").write_text("<package><name>arm</name></package>")
    (folder / "model.config").write_text("<model/>")
    (folder / "meshes" / "a b.stl").write_text("solid a\nendsolid a\n")
    return folder


def rewritten(package: Path, uri: str, options: str) -> tuple[str | None, list[str]]:
    robot = package / "urdf" / "robot.urdf"
    robot.write_text(ROBOT.format(SHAPE.format(uri)))
    made = twinform.convert(robot, to="urdf", passes=f"rewrite-uris{{{options}}}")
    found = next(node.uri for node in walk(made.document) if isinstance(node, Mesh))
    return found, [each.rule.name for each in made.diagnostics]


def test_each_scheme_leads_to_each(package: Path) -> None:
    spelt = {
        "package": "package://arm/meshes/a b.stl",
        "model": "model://arm_1.2/meshes/a b.stl",
        "relative": "../meshes/a b.stl",
        "file": (package / "meshes/a b.stl").as_uri(),
    }
    for start, uri in spelt.items():
        for to, expected in spelt.items():
            if {start, to} != {"package", "model"}:  # these two only have other schemes
                assert rewritten(package, uri, f"to={to}") == (expected, []), f"{start} to {to}"


def test_a_package_and_a_model_of_one_name_need_no_file(package: Path) -> None:
    assert rewritten(package, "package://gone/a.stl", "to=model") == ("model://gone/a.stl", [])
    assert rewritten(package, "model://gone/a.stl", "to=package") == ("package://gone/a.stl", [])


def test_a_path_from_the_root_counts_as_a_file(package: Path) -> None:
    path = str(package / "meshes" / "a b.stl")
    assert rewritten(package, path, "to=package") == ("package://arm/meshes/a b.stl", [])


def test_a_root_that_is_named_goes_before_all(package: Path) -> None:
    (package / "meshes" / "a.stl").write_text("")
    options = f'to=model roots="shapes={package / "meshes"}"'
    assert rewritten(package, "../meshes/a.stl", options) == ("model://shapes/a.stl", [])
    assert (
        rewritten(package, "package://shapes/a.stl", options.replace("to=model", "to=relative"))[0] == "../meshes/a.stl"
    )


@pytest.mark.parametrize(
    ("uri", "options"),
    [
        ("package://gone/a.stl", "to=file"),
        ("missing.stl", "to=package"),
        ("https://fuel.gazebosim.org/1.0/a/models/b/tip/files/c.stl", "to=relative"),
        ("package://../../etc/passwd", "to=file"),
        ("model://", "to=relative"),
    ],
)
def test_what_cannot_be_mapped_stays_and_is_reported(package: Path, uri: str, options: str) -> None:
    assert rewritten(package, uri, options) == (uri, ["unmapped-uri"])


@pytest.mark.parametrize("uri", ["__default__", "ftp://host/a.stl", "data:text/plain,a", "package://arm/a.stl"])
def test_plain_names_and_other_schemes_are_left_alone(package: Path, uri: str) -> None:
    assert rewritten(package, uri, "to=package") == (uri, [])


def test_a_file_in_no_package_has_no_name(tmp_path: Path) -> None:
    (tmp_path / "urdf").mkdir()
    mesh = tmp_path / "a.stl"
    mesh.write_text("")
    assert rewritten(tmp_path, str(mesh), "to=package") == (str(mesh), ["unmapped-uri"])


def test_a_text_without_a_folder_has_no_relative_paths(package: Path) -> None:
    text = ROBOT.format(SHAPE.format(package / "meshes" / "a b.stl"))
    made = twinform.convert(text.encode(), to="urdf", passes="rewrite-uris{to=relative}")
    assert "unmapped-uri" in [each.rule.name for each in made.diagnostics]


def test_links_are_named_as_they_were_followed(package: Path) -> None:
    link = package.parent / "linked"
    link.symlink_to(package)
    found, _ = rewritten(link, "package://arm/meshes/a b.stl", "to=relative")
    assert found == "../meshes/a b.stl"


@pytest.mark.parametrize("options", ["", "to=http", "to=file roots=arm", "to=file roots=a/b=c", "to=file kinds=sound"])
def test_options_that_mean_nothing_are_refused(options: str) -> None:
    with pytest.raises(ValueError, match="rewrite-uris"):
        parse_pipeline(f"rewrite-uris{{{options}}}")
