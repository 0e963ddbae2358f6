"""The page: every section, from what the compiler says; nothing in it that is not text or ours."""

import json
import re
from html.parser import HTMLParser
from pathlib import Path

import pytest
from click.testing import CliRunner

import twinform
from tests.chains import chain
from twinform.cli import main
from twinform.compiler import LoadOptions, check
from twinform.compiler.compare import Comparison
from twinform.compiler.resolve_uris import SearchPath
from twinform.diagnostics import Fate, Location
from twinform.ir import Document
from twinform.report import build_report, html
from twinform.report.relative_paths import relative_to_here, with_relative_paths
from twinform.view import NotDrawn, StandaloneView, ViewerMissingError

from .models import EVIL, EXAMPLES, PAGE, WRONG, hostile, no_page, stand_in, two_versions

pytestmark = pytest.mark.slow


class _Page(HTMLParser):
    """Tags with their attributes, and the text outside of scripts and styles."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.tags: list[tuple[str, dict[str, str | None]]] = []
        self.text = ""
        self._hidden = 0
        self.feed(text)
        self.close()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append((tag, dict(attrs)))
        self._hidden += tag in {"script", "style"}

    def handle_endtag(self, tag: str) -> None:
        self._hidden -= tag in {"script", "style"}

    def handle_data(self, data: str) -> None:
        self.text += "" if self._hidden else data

    def all(self, tag: str) -> list[dict[str, str | None]]:
        return [found for name, found in self.tags if name == tag]


def _page(first: str | Path | bytes, second: str | Path | bytes | None = None) -> _Page:
    return _Page(html(build_report(first, second, view=stand_in)))


def test_every_section_is_there_and_in_the_contents() -> None:
    page = _page(EXAMPLES / "rover.urdf", EXAMPLES / "arm.urdf")
    anchors = [found["id"] for found in page.all("section")]
    assert anchors == [
        "differences", "view", "findings", "tree", "conversion", "statistics", "masses", "reach", "meshes",
    ][: len(anchors)]  # fmt: skip
    assert len(anchors) >= 8
    links = {found["href"] for found in page.all("a")}
    assert {f"#{anchor}" for anchor in anchors} <= links
    assert {link[1:] for link in links if link} <= {found.get("id") for _, found in page.tags}


def test_the_ledger_is_that_of_a_conversion() -> None:
    made = twinform.convert(EXAMPLES / "rover.urdf", to="sdf").ledger
    text = _page(EXAMPLES / "rover.urdf").text
    assert f"in SDF: {made.expressed} expressed, {made.count(Fate.CARRIED)} carried" in text
    for entry in made.entries:
        assert entry.message in text


def test_the_findings_are_those_of_a_check_with_their_lines() -> None:
    path = Path(__file__).parents[2] / "cases/check/all_at_once.urdf"
    page = _page(path)
    for each in check(path).diagnostics:
        assert each.message in page.text
        assert each.rule.name in page.text
    assert '<parent link="bse"/>' in page.text
    assert "^^^" in page.text


def test_masses_and_inertias_are_those_of_the_file() -> None:
    page = _page(EXAMPLES / "rover.urdf")
    values = {float(found["data-value"] or 0) for found in page.all("td") if "data-value" in found}
    document = twinform.load(EXAMPLES / "rover.urdf")
    inertials = [link.inertial for link in document.models[0].links if link.inertial]
    assert inertials
    for each in inertials:
        assert each.inertia
        assert {each.mass, each.inertia.izz} <= values


def test_differences_have_values_amounts_and_places(tmp_path: Path) -> None:
    other = tmp_path / "heavier.urdf"
    other.write_text((EXAMPLES / "arm.urdf").read_text().replace('<mass value="4"/>', '<mass value="5"/>'))
    text = _page(EXAMPLES / "arm.urdf", other).text
    assert "different robots: 1 difference, 0 notes" in text
    assert re.search(r"inertial/mass\s*4 kg\s*5 kg\s*by 1 kg, 20 %", text)
    assert "heavier.urdf:25" in text


def test_the_title_says_which_robots_of_which_files() -> None:
    one, two = _page(EXAMPLES / "rover.urdf"), _page(EXAMPLES / "rover.urdf", EXAMPLES / "arm.urdf")
    assert "rover (rover.urdf): report" in one.text
    assert "rover (rover.urdf) compared with arm (arm.urdf): report" in two.text
    same = (EXAMPLES / "arm.urdf").read_bytes()
    assert "arm (A) compared with arm (B): report" in _page(same, same).text


def test_two_versions_of_a_robot_are_told_apart(tmp_path: Path) -> None:
    page = _page(*two_versions(tmp_path))
    assert "arm in before/arm.urdf" in page.text
    assert "arm in after/arm.urdf" in page.text
    assert page.text.count("Of arm (before/arm.urdf).") >= 4
    assert "before/arm.urdf in SDF: " in page.text


def test_advice_says_which_of_two_files_it_is_about(tmp_path: Path) -> None:
    wheel = '<collision><geometry><mesh filename="wheel.stl"/></geometry></collision>'
    vertices = "".join(f"vertex {x} {y} 0\n" for x, y in ((0, 0), (1, 0), (0, 1)))
    facets = f"facet normal 0 0 1\nouter loop\n{vertices}endloop\nendfacet\n" * 2000
    for name in ("before", "after"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "wheel.stl").write_text(f"solid a\n{facets}endsolid a\n")
        (tmp_path / name / "leo.urdf").write_text(f'<robot name="leo"><link name="l">{wheel}</link></robot>')
    text = _page(tmp_path / "before/leo.urdf", tmp_path / "after/leo.urdf").text
    assert "leo in before/leo.urdf has " in text
    assert "leo in after/leo.urdf has " in text


@pytest.mark.parametrize("here", [".", "before", "/"])
def test_no_folder_of_the_machine_is_in_a_report(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, here: str) -> None:
    files = two_versions(tmp_path)
    monkeypatch.chdir(tmp_path / here)
    missing = NotDrawn("base", "visual", "", f"{str(files[0].parent / 'gone.stl')!r} is not found")
    search = SearchPath.of([tmp_path / "meshes"])

    def view(*_: object) -> StandaloneView:
        return StandaloneView(PAGE, (missing,))

    report = build_report(*files, LoadOptions(search=search), view=view)
    text = _Page(html(report)).text
    # the line of the file that a finding is about stands as it is written
    said = "\n".join(line for line in text.splitlines() if not re.match(r"\d+ \| ", line.strip()))
    assert str(tmp_path) not in said.replace(f'filename="{tmp_path.as_uri()}', "")
    assert "arm.urdf:25" in text
    assert "looked in" in text
    assert "^^^" in text, "lines of a file are found by its real name"


def test_paths_of_elements_are_whole_wherever_the_report_is_made() -> None:
    shorten = relative_to_here([], SearchPath())
    here = Path.cwd()
    location = Location(str(here / "a.urdf"), 1, f"{here}/link")
    assert with_relative_paths(location, shorten) == Location("a.urdf", 1, f"{here}/link")
    nested = Path("..", here.name, "tests")
    assert relative_to_here([str(nested / "a.urdf")], SearchPath())(f"{here.resolve()}/tests/x") == "tests/x"
    assert shorten(f"looked in {here}, {here}/b and {here}-c") == f"looked in ., b and {here}-c"


def test_a_file_with_errors_has_a_report_without_a_view() -> None:
    report = build_report(WRONG.encode(), view=no_page)
    page = _Page(html(report))
    assert "1 error" in page.text
    assert "There is no 3D view: the file has errors." in page.text
    assert "bse" in page.text
    assert not page.all("iframe")
    assert not report.accepted
    assert not report.unreadable


def test_files_that_cannot_be_compared_have_a_report() -> None:
    page = _page(EXAMPLES / "arm.urdf", WRONG.encode())
    assert "The files cannot be compared" in page.text
    assert "0 errors" in page.text


def test_a_world_says_why_no_urdf_can_be_made_of_it() -> None:
    page = _page(EXAMPLES / "warehouse.sdf")
    assert "cannot be converted to URDF as it is" in page.text
    assert "shelf" in page.text


def test_without_the_library_the_report_says_what_to_install() -> None:
    def missing(*_: object) -> StandaloneView:
        raise ViewerMissingError("viser")

    report = build_report(EXAMPLES / "rover.urdf", view=missing)
    assert "pip install 'twinform[view]'" in _Page(html(report)).text
    assert report.accepted


def test_hostile_names_are_text() -> None:
    page = _page(hostile().encode(), hostile(mass=2).encode())
    assert EVIL in page.text
    assert sum(tag == "script" for tag, _ in page.tags) == 1
    assert sum(tag == "style" for tag, _ in page.tags) == 1
    assert not [name for _, found in page.tags for name in found if name.startswith("on")]


@pytest.mark.parametrize("name", ["\u202eabc", "a\u0085b", "x" * 1000, "\U000e0041"])
def test_what_a_browser_would_obey_or_not_show_has_an_escape(name: str) -> None:
    text = html(build_report(hostile(name).encode(), view=stand_in))
    assert all(each.isprintable() or each in "\n\t" for each in text)
    assert name.encode("unicode_escape").decode() in text


def test_nothing_is_asked_of_any_server() -> None:
    page = _page(EXAMPLES / "rover.urdf", EXAMPLES / "arm.urdf")
    for tag, found in page.tags:
        for name in ("src", "href", "action", "data", "poster"):
            assert (found.get(name) or "#").startswith(("#", "data:")), (tag, found)
    assert "@import" not in html(build_report(EXAMPLES / "rover.urdf", view=None))


def test_the_policy_allows_the_scripts_of_the_report_and_no_others() -> None:
    (policy,) = (
        found["content"] or "" for found in _page(EXAMPLES / "rover.urdf").all("meta") if "http-equiv" in found
    )
    rules = dict(rule.strip().split(" ", 1) for rule in policy.split(";"))
    assert rules["default-src"] == "'none'"
    assert "'unsafe-inline'" not in rules["script-src"]
    assert not re.search(r"https?:|\*", policy)
    (bare,) = re.findall(
        r'Content-Security-Policy" content="([^"]*)"', html(build_report(EXAMPLES / "arm.urdf", view=None))
    )
    assert "unsafe" not in bare


def test_the_frame_has_no_rights_but_scripts() -> None:
    (frame,) = _page(EXAMPLES / "rover.urdf").all("iframe")
    assert (frame["sandbox"], frame["loading"]) == ("allow-scripts", "lazy")
    assert (frame["title"] or "").startswith("3D view of ")


def test_documents_in_memory_have_a_report() -> None:
    document = twinform.load(EXAMPLES / "gripper.urdf")
    assert "gripper" in _Page(html(build_report(document, view=stand_in))).text


def test_the_view_looks_for_meshes_in_the_folders_of_the_call(tmp_path: Path) -> None:
    seen: list[object] = []

    def look(_: Document, __: Document | None, ___: Comparison | None, search: SearchPath) -> StandaloneView:
        seen.append(search)
        return StandaloneView("<html></html>")

    options = LoadOptions(search=SearchPath.of([tmp_path]))
    build_report(EXAMPLES / "gripper.urdf", None, options, view=look)
    assert seen == [options.search]


def test_the_same_file_gives_the_same_page() -> None:
    assert html(build_report(EXAMPLES / "arm.urdf", view=stand_in)) == html(
        build_report(EXAMPLES / "arm.urdf", view=stand_in)
    )


def test_a_long_chain_is_no_deep_page() -> None:
    text = html(build_report(chain(1200).encode(), view=None))
    assert text.count("<ul>") < 60
    assert "l1199" in text


def test_numbers_are_those_of_stats() -> None:
    done = CliRunner().invoke(main, ["stats", str(EXAMPLES / "rover.urdf"), "--format", "json"])
    (model,) = json.loads(done.stdout)["files"][0]["models"]
    text = _page(EXAMPLES / "rover.urdf").text
    assert f"{model['mass']:.6g} kg" in text
    assert f"Degrees of freedom{model['dof']}" in text


def test_the_view_gets_what_differs():
    seen: list[object] = []

    def page(first: Document, second: Document | None, comparison: Comparison | None, _: SearchPath) -> StandaloneView:
        seen.extend((first.models[0].name, second and second.models[0].name, comparison and comparison.same))
        return stand_in()

    text = html(build_report(EXAMPLES / "gripper.urdf", EXAMPLES / "arm.urdf", view=page))
    assert seen == ["gripper", "arm", False]
    assert "what differs is red" in text


def test_a_badge_in_the_tree_is_as_bad_as_the_worst_finding_and_leads_to_it() -> None:
    page = _page(Path(__file__).parents[2] / "cases/check/all_at_once.urdf")
    (badge,) = [found for found in page.all("a") if "badge" in (found.get("class") or "")]
    assert badge["class"] == "badge error"
    assert badge["href"] == "#error-a0"
    assert page.all("li")[-1] != badge
    assert [found["id"] for found in page.all("li") if "id" in found] == [
        "error-a0", "error-a1", "error-a2", "note-a0",
    ]  # fmt: skip


def test_findings_of_two_files_have_anchors_of_their_own() -> None:
    page = _page(WRONG.encode(), WRONG.encode())
    anchors = [found["id"] for _, found in page.tags if "id" in found]
    assert {"error-a0", "error-b0"} <= set(anchors)
    assert len(anchors) == len(set(anchors))


def test_shapes_that_are_not_drawn_are_listed_with_the_reason() -> None:
    missing = NotDrawn("hand", "visual", "palm", "there is no 'gone.stl'")

    def view(*_: object) -> StandaloneView:
        return StandaloneView(PAGE, (missing,))

    page = _Page(html(build_report(EXAMPLES / "arm.urdf", view=view)))
    assert "Wire boxes stand for 1 shape that could not be drawn:" in page.text
    assert "visual palm" in page.text
    assert "there is no 'gone.stl'" in page.text
    assert "Wire boxes" not in _page(EXAMPLES / "arm.urdf").text
    two = _Page(html(build_report(EXAMPLES / "arm.urdf", EXAMPLES / "rover.urdf", view=view)))
    assert "hand in arm.urdf" in two.text


def test_a_second_file_that_is_not_drawn_is_named() -> None:
    assert "<bytes> has errors and is not drawn." in _page(EXAMPLES / "arm.urdf", WRONG.encode()).text


@pytest.mark.parametrize("name", ["robot.urdf", "robot.urdf.xacro"])
def test_meshes_are_found_from_the_file_or_what_xacro_makes_of_it(name: str, tmp_path: Path) -> None:
    pytest.importorskip("viser")
    mesh = '<visual name="{0}"><geometry><mesh filename="{0}.stl"/></geometry></visual>'
    facet = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet"
    (tmp_path / "here.stl").write_text(f"solid a\n{facet}\nendsolid a\n")
    (tmp_path / name).write_text(
        f'<robot name="r"><link name="l">{mesh.format("here")}{mesh.format("gone")}</link></robot>'
    )
    report = build_report(tmp_path / name, (tmp_path / name).read_bytes())
    assert [(each.name, each.robot) for each in report.not_drawn] == [("gone", 0), ("here", 1), ("gone", 1)]
