"""Every SDF that the compiler writes from a good source is read by libsdformat without an error."""

from collections.abc import Iterator
from pathlib import Path
from typing import Literal

import pytest

import twinform
from testbed.corpus.files import CorpusFile, Kind
from testbed.corpus.there_and_back import SDF_VERSION
from tests.corpus.portions import chunks
from twinform.compiler.advising import assess_file
from twinform.compiler.input.load_options import LoadOptions
from twinform.profiles import parse
from twinform.testing.oracles import libsdformat
from twinform.testing.oracles.libsdformat import describe

CASES = Path(__file__).parents[1] / "cases" / "convert"
_FIXED = 3
"""The number that libsdformat has for a fixed joint."""
URDF, SDF = chunks(Kind.URDF), chunks(Kind.SDF)


@pytest.fixture(autouse=True)
def reader() -> None:
    if not libsdformat.available():
        pytest.skip(libsdformat.MISSING)


@pytest.mark.parametrize("chunk", URDF)
def test_sdf_made_from_urdf_that_libsdformat_takes_is_read(corpus: Path, chunk: str, tmp_path: Path):
    assert corpus.is_dir()
    assert _errors(_good(URDF[chunk]), tmp_path) == {}


@pytest.mark.parametrize("chunk", SDF)
def test_an_sdf_model_that_libsdformat_takes_is_read_when_written_again(corpus: Path, chunk: str, tmp_path: Path):
    assert corpus.is_dir()
    # worlds take long; `make report NAME=oracle` has them too
    assert _errors((file for file in _good(SDF[chunk]) if _is_model_alone(file)), tmp_path) == {}


@pytest.mark.parametrize("chunk", SDF)
def test_urdf_made_from_a_model_that_libsdformat_takes_is_read(corpus: Path, chunk: str, tmp_path: Path):
    assert corpus.is_dir()
    assert _errors((file for file in _good(SDF[chunk]) if _is_model_alone(file)), tmp_path, to="urdf") == {}


def _is_model_alone(file: CorpusFile) -> bool:
    # what an include names is found from the place of the file, which is not where the result lies
    return file.row["format"] == "sdf" and not file.row["uses_include"]


def _good(files: tuple[CorpusFile, ...]) -> Iterator[CorpusFile]:
    return (file for file in files if file.row.get("libsdformat12") == "ok")


def _errors(
    files: Iterator[CorpusFile], folder: Path, to: Literal["sdf", "urdf"] = "sdf"
) -> dict[str, tuple[str, ...]]:
    outputs = dict(_converted(files, folder, to))
    return {outputs[path]: verdict.errors for path, verdict in libsdformat.judge(outputs).items() if not verdict.ok}


def _converted(files: Iterator[CorpusFile], folder: Path, to: Literal["sdf", "urdf"]) -> Iterator[tuple[Path, str]]:
    for number, file in enumerate(files):
        path = folder.resolve() / f"{number}.{to}"
        version = SDF_VERSION if file.kind is Kind.URDF else None
        try:
            path.write_text(twinform.convert(file.path, to=to, sdf_version=version).text, encoding="utf-8")
        except twinform.CompileError:
            continue  # what is refused, and why, is the corpus report's business
        yield path, file.name


def test_good_and_bad_files_are_distinguished(tmp_path: Path):
    good, bad, missing = tmp_path / "good.sdf", tmp_path / "bad.sdf", tmp_path / "missing.sdf"
    good.write_text("<sdf version='1.9'><model name='m'><link name='a'/></model></sdf>")
    bad.write_text("<sdf version='1.9'><model name='m'/></sdf>")
    verdicts = libsdformat.judge([good, bad, missing])
    assert [verdicts[path].ok for path in (good, bad, missing)] == [True, False, False]
    assert "at least one link" in verdicts[bad].errors[0]


def test_a_file_that_the_library_does_not_survive_spoils_no_other(tmp_path: Path):
    crash, good = tmp_path / "crash.urdf", tmp_path / "good.sdf"
    inertial = "<inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial>"
    link = f"<link name='a'>{inertial}</link><gazebo reference='a'><dampingFactor>foo</dampingFactor></gazebo>"
    crash.write_text(f"<robot name='r'>{link}</robot>")
    good.write_text("<sdf version='1.9'><model name='m'><link name='a'/></model></sdf>")
    verdicts = libsdformat.judge([crash, good])
    assert not verdicts[crash].ok
    assert verdicts[good].ok


def test_names_with_scopes_are_refused_but_in_plugins_and_behind_prefixes(tmp_path: Path):
    elements = {
        "plain": "<api name='a::b'/>",
        "inner": "<api><part name='a::b'/></api>",
        "plugin": "<plugin name='a::b' filename='p'><api name='a::b'/></plugin>",
        "prefix": "<v:api xmlns:v='urn:v' name='a::b'><part name='a::b'/></v:api>",
    }
    paths = {name: tmp_path / f"{name}.sdf" for name in elements}
    for name, path in paths.items():
        path.write_text(f"<sdf version='1.9'><model name='m'><link name='a'>{elements[name]}</link></model></sdf>")
    verdicts = libsdformat.judge(paths.values())
    taken = {name for name, path in paths.items() if verdicts[path].ok}
    assert taken == {"plugin", "prefix"}
    ours = {name for name, path in paths.items() if not any(d.is_error for d in twinform.check(path).diagnostics)}
    assert taken == ours


@pytest.mark.parametrize("static", ["", "<static>false</static>"])
def test_static_models_that_are_flattened_are_fixed_to_the_world(static: str, tmp_path: Path):
    inner = "<model name='in'><static>true</static><link name='b'/></model>"
    text = f"<sdf version='1.9'><model name='m'>{static}<link name='a'/>{inner}</model></sdf>"
    path = tmp_path / "flat.sdf"
    path.write_text(twinform.convert(text.encode(), to="sdf", passes="flatten-models").text)
    assert [(joint["kind"], joint["parent"], joint["child"]) for joint in describe(path)["joints"]] == [
        (_FIXED, "world", "in_b")
    ]


@pytest.mark.parametrize(
    "name", ["closed_loops", "frame_link", "gazebo_joint", "gazebo_tags", "scoped_elements", "world_link"]
)
def test_what_is_carried_is_passed_over_in_silence(name: str, tmp_path: Path):
    """Carriers and annotations are no concern of Gazebo."""
    made = twinform.convert(CASES / f"{name}.urdf", to="sdf", sdf_version=SDF_VERSION).text
    path = tmp_path.resolve() / "made.sdf"
    path.write_text(made)
    assert "<tf:from " in made
    assert libsdformat.judge([path])[path].console == ""


def test_loops_are_closed_where_urdf_has_their_ends(tmp_path: Path):
    path = tmp_path / "made.sdf"
    path.write_text(twinform.convert(CASES / "closed_loops.urdf", to="sdf", sdf_version=SDF_VERSION).text)
    joints = {joint["name"]: joint for joint in describe(path)["joints"]}
    for name in ("pin", "hinge", "rocker_coupler_loop", "cross"):
        assert (joints[name]["parent"], joints[name]["child"]) == ("rocker", "coupler")
        assert joints[name]["pose"][:3] == pytest.approx([0.4, 0, 0.4])  # of the rocker's end, in the model


def test_numbers_too_small_for_sdf_are_taken_in_urdf_and_in_the_sdf_made_of_it(tmp_path: Path):
    urdf, sdf, refused = CASES / "tiny_numbers.urdf", tmp_path / "made.sdf", tmp_path / "as_written.sdf"
    sdf.write_text(twinform.convert(urdf, to="sdf", sdf_version=SDF_VERSION).text, encoding="utf-8")
    refused.write_text(sdf.read_text().replace("1.1754943508222875e-38", "1e-38"), encoding="utf-8")
    verdicts = libsdformat.judge([urdf, sdf, refused])
    assert [verdicts[path].ok for path in (urdf, sdf, refused)] == [True, True, False]


def test_the_smallest_number_that_is_taken_in_sdf_is_taken_in_the_urdf_made_of_it(tmp_path: Path):
    sdf, urdf, refused = CASES / "smallest_number.sdf", tmp_path / "made.urdf", tmp_path / "as_written.urdf"
    urdf.write_text(twinform.convert(sdf, to="urdf").text, encoding="utf-8")
    refused.write_text(urdf.read_text().replace("2.3e-308", "2.2250738585072014e-308"), encoding="utf-8")
    verdicts = libsdformat.judge([sdf, urdf, refused])
    assert [verdicts[path].ok for path in (sdf, urdf, refused)] == [True, True, False]


_TINY_PARTS = """\
<sdf version="1.9">
  <model name="m">
    <link name="a">
      <velocity_decay><linear>1e-310</linear></velocity_decay>
      <collision name="c">
        <geometry><sphere><radius>1</radius></sphere></geometry>
        <surface><friction><ode><mu>1e-310</mu></ode></friction></surface></collision>
      <visual name="v">
        <geometry><sphere><radius>1</radius></sphere></geometry><transparency>1e-400</transparency></visual>
      <sensor name="s" type="camera">
        <camera><horizontal_fov>1</horizontal_fov><clip><near>1e-310</near></clip></camera></sensor>
    </link>
    <link name="b"/>
    <joint name="j" type="revolute">
      <parent>a</parent>
      <child>b</child>
      <axis><xyz>0 0 1</xyz></axis>
      <physics><ode><limit><cfm>1e-310</cfm></limit></ode></physics>
    </joint>
  </model>
</sdf>"""


@pytest.mark.parametrize("text", [(CASES / "tiny_in_gazebo.urdf").read_text(), _TINY_PARTS], ids=["urdf", "sdf"])
def test_tiny_numbers_without_a_field_are_taken_in_all_that_is_made_of_them(text: str, tmp_path: Path):
    ways: tuple[Literal["sdf", "urdf"], ...] = ("urdf", "sdf") if "<sdf" in text else ("sdf", "urdf")
    paths = [tmp_path / f"source.{ways[1]}", *(tmp_path / f"made.{to}" for to in ways)]
    paths[0].write_text(text, encoding="utf-8")
    for to, before, path in zip(ways, paths, paths[1:], strict=False):
        path.write_text(twinform.convert(before, to=to, sdf_version=SDF_VERSION).text, encoding="utf-8")
    verdicts = libsdformat.judge(paths)
    assert [verdicts[path].ok for path in paths] == [False, True, True]
    assert [_has_tiny_numbers(path) for path in paths] == [True, False, False]


def _has_tiny_numbers(path: Path) -> bool:
    (found,) = assess_file(path, parse("gazebo"), LoadOptions())
    return "tiny-number" in {each.finding.rule.name for each in found.judgments}
