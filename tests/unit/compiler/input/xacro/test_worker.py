"""The expander of xacro by itself: what it asks the compiler, and what it answers."""

import sys
from collections.abc import Callable, Iterator
from importlib import import_module
from pathlib import Path
from typing import Any

import pytest

from twinform.compiler.input.xacro import places
from twinform.compiler.input.xacro.channel import MissingFileError, NotFoundError
from twinform.compiler.input.xacro.process import run

_HEAD = '<robot xmlns:xacro="http://www.ros.org/wiki/xacro" name="r">'
_VARIABLES = {"SIDE": "left"}


class Compiler:
    """The compiler as the worker sees it: one task, all files of a folder, and answers for the URIs that it knows."""

    def __init__(self, file: Path, arguments: dict[str, str], known: dict[str, Path]) -> None:
        self.file = file
        self.task = {"file": str(file), "arguments": arguments}
        self.known = known

    def receive(self) -> dict[str, Any]:
        return self.task

    def find(self, uri: str, beside: str) -> str:
        assert Path(beside).is_relative_to(self.file.parent)
        if uri not in self.known:
            raise NotFoundError(f"there is no {uri}", "install it")
        return str(self.known[uri])

    def read(self, path: str) -> tuple[str, bytes]:
        if not Path(path).exists():
            raise MissingFileError(f"cannot read {path!r}: No such file or directory")
        return path, Path(path).read_bytes()

    def match(self, pattern: str) -> list[str]:
        return sorted(map(str, Path(pattern).parent.glob(Path(pattern).name)))

    def environment(self, name: str) -> str | None:
        return _VARIABLES.get(name)


Expand = Callable[..., dict[str, Any]]


def _loaded() -> list[str]:
    """The modules of xacro that were imported."""
    return [name for name in sys.modules if name.split(".")[0] == "xacro"]


@pytest.fixture
def expand(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Expand]:
    """Expand a body in a fresh xacro, in this process, which is confined to nothing."""
    for name in _loaded():
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setattr(sys, "stdout", sys.stdout)
    monkeypatch.setattr(sys, "stderr", sys.stderr)

    def expand(body: str, known: dict[str, Path] | None = None, **arguments: str) -> dict[str, Any]:
        path = tmp_path / "r.xacro"
        path.write_text(f"{_HEAD}\n{body}\n</robot>", encoding="utf-8")
        return run(Compiler(path, arguments, known or {}), confine=list)

    yield expand
    for name in _loaded():  # it is not the xacro that other tests look at
        del sys.modules[name]


def _places(outcome: dict[str, Any]) -> list[tuple[str, int, int, int]]:
    return [(Path(file).name, *rest) for file, *rest in outcome["places"]]


def test_every_element_knows_where_it_was_written(expand: Expand, tmp_path: Path) -> None:
    part = tmp_path / "part.xacro"
    part.write_text(f'{_HEAD}\n\n<xacro:macro name="m" params="n"><link\nname="${{n}}"/></xacro:macro></robot>')
    body = '<xacro:include filename="$(find parts)/part.xacro"/>\n<xacro:m n="a"/>\n<link name="b"/>'
    outcome = expand(body, {"package://parts": tmp_path})
    assert _places(outcome) == [("r.xacro", 1, 0, 0), ("part.xacro", 3, 2, 1), ("r.xacro", 4, 3, 0)]
    assert [(Path(file).name, *rest) for file, *rest in outcome["calls"]] == [("r.xacro", 2, 0)]
    assert '<link name="a"/>' in outcome["text"]
    assert (outcome["remarks"], outcome["unused"]) == ([], [])


def test_what_stands_in_a_call_is_made_outside_of_the_macro(expand: Expand) -> None:
    body = (
        '<xacro:macro name="inner" params="*block"><xacro:insert_block name="block"/></xacro:macro>\n'
        '<xacro:macro name="outer" params="n"><xacro:inner><link name="${n}"/></xacro:inner></xacro:macro>\n'
        '<xacro:outer n="a"/><xacro:outer n="b"/>'
    )
    outcome = expand(body)
    # calls are numbered as they begin: outer, inner, outer, inner; a block belongs to the call that it stands in
    assert [rest for _, *rest in outcome["calls"]] == [[6, 0], [4, 1], [7, 0], [4, 3]]
    assert [(number, call) for _, _, number, call in _places(outcome)] == [(0, 0), (5, 2), (5, 4)]


def test_a_package_by_its_uri_is_asked_for_beside_the_file_that_names_it(expand: Expand, tmp_path: Path) -> None:
    (tmp_path / "part.xacro").write_text(f'{_HEAD}<link name="p"/></robot>')
    known = {"package://parts/part.xacro": tmp_path / "part.xacro"}
    assert '<link name="p"/>' in expand('<xacro:include filename="package://parts/part.xacro"/>', known)["text"]


def test_arguments_that_nobody_asked_for_are_named(expand: Expand) -> None:
    outcome = expand('<xacro:arg name="side" default="left"/>\n<link name="$(arg side)"/>', side="right", size="2")
    assert '<link name="right"/>' in outcome["text"]
    assert outcome["unused"] == ["size"]


def test_what_is_printed_is_a_remark_with_its_place(expand: Expand) -> None:
    (text, file, line), *rest = expand('<link name="a"/>\n<link name="${xacro.warning(\'mind the gap\')}"/>')["remarks"]
    assert ("mind the gap" in text, Path(file).name, line, rest) == (True, "r.xacro", 3, [])


FAILURES = {
    "an unknown macro": ("\n<xacro:wheel/>", "there is no macro 'wheel'", 3),
    "an unknown name": ('<link name="${radius}"/>', "property 'radius' is not defined, in ${radius}", 2),
    "a macro in a macro": (
        '<xacro:macro name="m" params=""><link name="${x}"/></xacro:macro>\n<xacro:m/>',
        "property 'x' is not defined (in macro 'm', called at r.xacro:3), in ${x}",
        2,
    ),
    "a macro that calls itself": (
        '<xacro:macro name="m" params=""><xacro:m/></xacro:macro>\n<xacro:m/>',
        "macro 'm' calls itself without an end",
        2,
    ),
    "a hidden name": ('<link name="${().__class__}"/>', "an expression must not use '__class__'", 2),
    "a hidden name in eval": ('<link name="$(eval [].mro)"/>', "an expression must not use 'mro'", 2),
    "a number too large": ('\n<link name="${9**9**9}"/>', "beyond the largest floating point number", 3),
    "half a character": ("<link name=\"${'\\ud800'}\"/>", "surrogates not allowed", 2),
    "a variable that is not set": ('<link name="$(env NONE)"/>', "environment variable 'NONE' is not set", 2),
    "too many remarks": (
        '<link name="${[xacro.message(i) for i in range(2000)]}"/>',
        "the file prints more than 1,000 things",
        2,
    ),
    "a file that is not there": ('<xacro:include filename="none.xacro"/>', "No such file or directory", 2),
    "a package that is not there": (
        '<xacro:include filename="$(find none)/a.xacro"/>',
        "there is no package://none",
        2,
    ),
    "a document type": ('<xacro:include filename="typed.xacro"/>', "the document has a DOCTYPE; none is allowed", 1),
    "a broken file": ('<xacro:include filename="broken.xacro"/>', "not well-formed XML: ", 3),
}


@pytest.mark.parametrize("name", FAILURES)
def test_a_failure_has_a_message_and_a_place(name: str, expand: Expand, tmp_path: Path) -> None:
    (tmp_path / "typed.xacro").write_text("<!DOCTYPE robot><robot/>")
    (tmp_path / "broken.xacro").write_text("<robot>\n<link>\n</robot>")
    body, words, line = FAILURES[name]
    outcome = expand(body)
    assert words in outcome["error"]
    assert outcome["place"][1] == line
    assert outcome.get("help") == ("install it" if "package" in name else None)


def test_a_file_with_too_many_tags_is_not_parsed(expand: Expand, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(places, "_MOST_TAGS", 9)
    assert "more than 9 tags" in expand("<link/>" * 20)["error"]


def test_xacro_that_is_not_installed_is_missing(expand: Expand, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "xacro", None)
    assert "xacro" in expand("")["missing"]


def test_a_xacro_whose_functions_are_not_known_is_missing(expand: Expand, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delattr(import_module("xacro"), "eval_text")
    assert expand("")["missing"] == "this version of xacro is not known: xacro has no eval_text"


@pytest.mark.parametrize("name", ["compile", "eval", "exec", "open"])
@pytest.mark.parametrize("module", ["xacro", "xacro.substitution_args"])
def test_no_part_of_xacro_can_evaluate_or_open(module: str, name: str, expand: Expand) -> None:
    expand("")
    with pytest.raises(Exception, match="xacro must not evaluate or open anything by itself"):
        vars(import_module(module))[name]("1")


def _called(expression: str) -> str:
    return f'<xacro:property name="p" value="{expression}"/><link name="$(eval ${{p}})"/>'


EXPANDED = {
    "an optional include": ('<xacro:include filename="none.xacro" optional="true"/>', ""),
    "a pattern": ('<xacro:include filename="part_*.xacro"/>', '<link name="p"/>'),
    "a variable": ('<link name="$(env SIDE)"/>', '<link name="left"/>'),
    "a variable or not": ('<link name="$(optenv NONE a b)"/>', '<link name="a b"/>'),
    "an argument in an expression": ("<link name=\"${xacro.arg('a')}\"/>", '<link name="1.5"/>'),
    "an argument in eval": ('<link name="$(eval a * 2)"/>', '<link name="3.0"/>'),
    # the first parenthesis ends a substitution, so that calls come out of properties
    "a function in eval": (_called("str(int(sqrt(16))) + env('SIDE') + optenv('N', 'o')"), '<link name="4lefto"/>'),
    "an argument asked for in eval": (_called("arg('a') + 1"), '<link name="2.5"/>'),
    "a package in eval": (_called("find('parts')"), '<link name="/parts"/>'),
    "a list that grows": (
        '<xacro:property name="l" value="${[]}"/>${l.append(1)}${l.append(2)}<link name="${l}"/>',
        '<link name="[1, 2]"/>',
    ),
    "data": (
        """<xacro:property name="d" value="${xacro.load_yaml('data.yaml')}"/>
        <link name="${d.arm.joints[1].limit} ${d['arm']['n']} ${d.angle}"/>""",
        '<link name="0.5 2 3.141592653589793"/>',
    ),
    "dots": ('<xacro:property name="d" value="${xacro.dotify(dict(a=1))}"/><link name="${d.a}"/>', '<link name="1"/>'),
    "words": ("<link name=\"${xacro.tokenize('a, b;c')}\"/>", "['a', 'b', 'c']"),
    "a path": ("<link name=\"${xacro.abs_filename('a.dae')}\"/>", "/a.dae"),
    "an element that is named": ('<xacro:element xacro:name="${1 and \'link\'}" name="n"/>', '<link name="n"/>'),
    "an attribute that is named": ('<link><xacro:attribute name="name" value="${str(7)}"/></link>', '<link name="7"/>'),
    "a macro that is named": (
        '<xacro:macro name="m"><link name="m"/></xacro:macro><xacro:call macro="${\'m\'}"/>',
        '<link name="m"/>',
    ),
    "names of an included file": (
        '<xacro:include filename="part_1.xacro" ns="p"/><link name="${p.width} ${p.half}"/>',
        '<link name="4 2.0"/>',
    ),
    "an old name": ("<link name=\"${load_yaml('data.yaml').arm.n}\"/>", '<link name="2"/>'),
    "dollars": ('<link name="$${a} $$(b) c$d"/>', '<link name="${a} $(b) c$d"/>'),
    "an expression in a substitution": ("<link name=\"$(arg ${'a'})\"/>", '<link name="1.5"/>'),
    "a substitution in an expression": ('<link name="${$(arg a) * 2}"/>', '<link name="3.0"/>'),
    "a comment": ("<!-- xacro:eval-comments --><!-- ${1 + 1} -->", "<!-- 2 -->"),
    "another alphabet": ("<link name=\"${'Räder'.upper()}\"/>", '<link name="RÄDER"/>'),
}


@pytest.mark.parametrize("name", EXPANDED)
def test_the_language_is_that_of_xacro(name: str, expand: Expand, tmp_path: Path) -> None:
    properties = '<xacro:property name="width" value="4"/><xacro:property name="half" value="${width / 2}"/>'
    (tmp_path / "part_1.xacro").write_text(f'{_HEAD}{properties}<link name="p"/></robot>')
    (tmp_path / "data.yaml").write_text("arm: {n: 2, joints: [{}, {limit: 0.5}]}\nangle: !degrees 2*90")
    body, written = EXPANDED[name]
    outcome = expand(f'<xacro:arg name="a" default="1.5"/>{body}', {"package://parts": Path("/parts")})
    assert written in outcome.get("text", outcome)


def test_a_name_that_is_deprecated_is_a_warning(expand: Expand) -> None:
    (text, _, line), *_ = expand('\n<link name="${sorted([2, 1])}"/>')["remarks"]
    assert (text, line) == ("warning: Using sorted() directly is deprecated. Use python.sorted() instead.", 3)


def test_where_the_expansion_is_can_be_asked(expand: Expand) -> None:
    body = '<xacro:macro name="m">${xacro.print_location()}</xacro:macro>\n<xacro:m/>'
    first, second = (text for text, *_ in expand(body)["remarks"])
    assert first.startswith("when instantiating macro: m (")
    assert second.startswith("in file: ")


def test_the_default_of_a_property_does_not_hide_a_function(expand: Expand) -> None:
    # `comb` is not offered, and still a name of xacro
    body = '<xacro:property name="comb" default="3"/><link name="${comb(3, 2)}"/>'
    assert "must not use 'comb'" in expand(body)["error"]
