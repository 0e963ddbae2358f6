import tomllib

import pytest
from hypothesis import given, settings

from tests.distributions import Install
from twinform.passes import Pipeline, UnknownPipelineError, parse_pipeline
from twinform.passes.framework.pipeline_text import TableError, parse_tables, print_tables, tables

from .test_pipeline import PIPELINES
from .test_pipeline import __name__ as samples


@pytest.fixture(scope="module", autouse=True)
def _installed(install: Install) -> None:
    install("stranger", {"sample": f"{samples}:Sample", "needs-2-options": f"{samples}:Needy"})


@settings(deadline=None)  # how busy the machine is does not matter
@given(PIPELINES)
def test_text_and_table_are_the_same_pipeline(pipeline: Pipeline) -> None:
    text = print_tables(parse_pipeline(str(pipeline)), "a-1_B")
    found = tomllib.loads(text)["pipelines"]["a-1_B"]
    assert parse_tables(found) == pipeline
    assert str(parse_tables(found)) == str(pipeline)
    assert tables(parse_tables(found)) == tables(pipeline)


def test_a_table_is_what_a_person_would_write() -> None:
    text = print_tables(
        parse_pipeline('sample{word="a b" words=[x,y] ratio-or-none=null},needs-2-options{must=1}'), "p"
    )
    assert text.splitlines() == [
        "[[pipelines.p]]",
        'pass = "sample"',
        'word = "a b"',
        "ratio-or-none = {}",
        'words = ["x", "y"]',
        "",
        "[[pipelines.p]]",
        'pass = "needs-2-options"',
        "must = 1",
    ]
    assert print_tables(Pipeline(), "p") == "[pipelines]\np = []\n"


def test_a_table_may_name_another_pipeline() -> None:
    def names(name: str) -> Pipeline:
        if name != "two":
            raise UnknownPipelineError(f"no pipeline is called {name}")
        return parse_pipeline("sample,sample{whole=2}")

    made = parse_tables([{"pass": "@two"}, {"pass": "sample"}], names=names)
    assert str(made) == "sample,sample{whole=2},sample"
    with pytest.raises(TableError, match=r"\[0\]\.pass: no pipeline is called three"):
        parse_tables([{"pass": "@three"}], names=names)


@pytest.mark.parametrize(
    ("rows", "problem"),
    [
        ("1", "expected text, or a list of tables with the key pass"),
        ("{pass = 'sample'}", "expected text, or a list of tables with the key pass"),
        ("['sample']", "[0]: expected a table with the key pass"),
        ("[{}]", "[0]: the table needs the key pass, which is text"),
        ("[{pass = 1}]", "[0]: the table needs the key pass, which is text"),
        ("[{pass = 'simple'}]", "[0].pass: no pass is called simple; did you mean sample?"),
        ("[{pass = 'Sample'}]", "[0].pass: no pass is called Sample"),
        (
            "[{pass = 'sample'}, {pass = 'sample', hole = 1}]",
            "[1].hole: sample has no option hole; did you mean whole?",
        ),
        ("[{pass = 'sample', whole = 1.5}]", "[0].whole: option whole of sample: should be a valid integer"),
        ("[{pass = 'sample', whole = 2026-01-01}]", "[0].whole: expected text, a number"),
        ("[{pass = 'sample', words = [['a']]}]", "[0].words[0]: expected text, a number"),
        ("[{pass = 'sample', word = {a = 1}}]", "[0].word: expected text, a number"),
        ("[{pass = 'needs-2-options'}]", "[0].pass: needs-2-options needs the option must"),
        ("[{pass = '@two', whole = 1}]", "[0].whole: @two is a pipeline and takes no options"),
        ("[{pass = '@two'}]", "[0].pass: no pipeline is called two: no configuration names any"),
    ],
)
def test_an_error_names_the_key(rows: str, problem: str) -> None:
    with pytest.raises(TableError) as caught:
        parse_tables(tomllib.loads(f"rows = {rows}")["rows"])
    assert str(caught.value).removeprefix(": ").startswith(problem)


@pytest.mark.parametrize("name", ["", "a b", "a.b", "é", "@a"])
def test_a_name_is_a_bare_key(name: str) -> None:
    with pytest.raises(ValueError, match="is not a valid name of a pipeline"):
        print_tables(Pipeline(), name)
