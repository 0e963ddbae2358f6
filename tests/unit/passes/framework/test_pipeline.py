import math
from enum import StrEnum
from typing import ClassVar, Literal

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pydantic import Field

from tests.distributions import Install
from twinform.diagnostics import DiagnosticSink, Rule, Severity
from twinform.ir import Document, Format
from twinform.passes import (
    BrokenPassError,
    CombinedInstrumentation,
    FailedPassError,
    Pass,
    PassError,
    PassInstrumentation,
    Pipeline,
    PipelineError,
    UnknownPipelineError,
    parse_pipeline,
)

INVALID = Rule(name="invalid", severity=Severity.ERROR, finds="-", matters="-", example="-", better="-")


class Shade(StrEnum):
    LIGHT = "light"
    DARK = "very dark"


class Sample(Pass):
    """Has an option of every kind, and gives the document a new version."""

    name: ClassVar[str] = "sample"

    word: str = "word"
    whole: int = 1
    real: float = 0.5
    flag: bool = False
    maybe: float | None = None
    ratio_or_none: float | None = 2.0
    words: tuple[str, ...] = ()
    numbers: tuple[float, ...] = ()
    kinds: frozenset[str] = frozenset()
    shade: Shade = Shade.LIGHT
    side: Literal["left", "right"] = "left"
    small: int = Field(default=0, ge=0, le=9)

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        del sink
        return document.copy(version=self.word)


class Needy(Pass):
    """Has to be given an option, and changes nothing."""

    name: ClassVar[str] = "needs-2-options"

    must: int

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        del sink
        return document


@pytest.fixture(scope="module", autouse=True)
def _installed(install: Install) -> None:
    install("stranger", {"sample": f"{__name__}:Sample", "needs-2-options": f"{__name__}:Needy"})


REALS = st.floats(allow_nan=False)
WORDS = st.text(max_size=8) | st.sampled_from(
    ["true", "null", "1.5", "inf", "-inf", "1e400", "a::b", "*_joint", 'a"b', " "]
)
SAMPLES = st.builds(
    Sample,
    word=WORDS,
    whole=st.integers(),
    real=REALS,
    flag=st.booleans(),
    maybe=st.none() | REALS,
    ratio_or_none=st.none() | REALS,
    words=st.lists(WORDS, max_size=3).map(tuple),
    numbers=st.lists(REALS, max_size=3).map(tuple),
    kinds=st.frozensets(WORDS, max_size=3),
    shade=st.sampled_from(Shade),
    side=st.sampled_from(["left", "right"]),
    small=st.integers(0, 9),
)
PIPELINES = st.lists(SAMPLES | st.builds(Needy, must=st.integers()), max_size=4).map(
    lambda passes: Pipeline(tuple(passes))
)


@settings(deadline=None)  # how busy the machine is does not matter
@given(PIPELINES)
def test_parsing_a_printed_pipeline_gives_the_pipeline(pipeline: Pipeline) -> None:
    assert parse_pipeline(str(pipeline)) == pipeline


@settings(deadline=None)  # how busy the machine is does not matter
@given(PIPELINES)
def test_printing_is_canonical(pipeline: Pipeline) -> None:
    assert str(parse_pipeline(str(pipeline))) == str(pipeline)


@settings(deadline=None)  # how busy the machine is does not matter
@given(st.text(alphabet='@ab-1{}[],= "\\\t\n.e_', max_size=20))
def test_any_text_is_a_pipeline_or_a_readable_error(text: str) -> None:
    try:
        parse_pipeline(text)
    except PipelineError as error:
        position = error.position
    else:
        position = 0
    assert 0 <= position <= len(text)


@pytest.mark.parametrize(
    ("text", "canonical"),
    [
        ("", ""),
        ("  ", ""),
        ("sample", "sample"),
        ("sample{}", "sample"),
        (" sample , sample ", "sample,sample"),
        ("sample{ whole=3,real=2.50 }", "sample{whole=3 real=2.5}"),
        ("sample{whole=3 , real=100.0}", "sample{whole=3 real=100}"),
        ("sample{whole=3\n  flag=true}", "sample{whole=3 flag=true}"),
        ("sample{real=1e3}", "sample{real=1000}"),
        ("sample{real=-inf}", "sample{real=-inf}"),
        ("sample{real=.5}", "sample"),
        ("sample{flag=false}", "sample"),
        ("sample{ratio-or-none=null}", "sample{ratio-or-none=null}"),
        ('sample{word="tool0"}', "sample{word=tool0}"),
        ('sample{word="5"}', 'sample{word="5"}'),
        ('sample{word=""}', 'sample{word=""}'),
        (r'sample{word="a\"\u0062\n"}', r'sample{word="a\"b\n"}'),
        ("sample{words=tool0}", "sample{words=tool0}"),
        ("sample{words=[tool0]}", "sample{words=tool0}"),
        ("sample{words=[ a , b ] whole=2}", "sample{whole=2 words=[a,b]}"),
        ("sample{words=[]}", "sample"),
        ("sample{kinds=[b,a]}", "sample{kinds=[a,b]}"),
        ('sample{shade="very dark"}', 'sample{shade="very dark"}'),
        ("needs-2-options{must=4}", "needs-2-options{must=4}"),
    ],
)
def test_a_text_has_one_canonical_spelling(text: str, canonical: str) -> None:
    assert str(parse_pipeline(text)) == canonical


@pytest.mark.parametrize(
    ("text", "position", "problem"),
    [
        ("Sample", 0, "expected the name of a pass, not 'S'"),
        ("sample,", 7, "expected the name of a pass, not the end"),
        ("sample,,sample", 7, "expected the name of a pass, not ','"),
        ("sample sample", 7, "expected ',' or the end, not 's'"),
        ("sample{}}", 8, "expected ',' or the end, not '}'"),
        ("sample_two", 6, "expected ',' or the end, not '_'"),
        ("sample,simple", 7, "no pass is called simple; did you mean sample?"),
        ("sample{", 7, "expected the name of an option, not the end"),
        ("sample{whole", 12, "expected '=', not the end"),
        ("sample{whole=}", 13, "expected a value, not '}'"),
        ("sample{whole=1", 14, "expected ',', a blank or '}', not the end"),
        ("sample{whole=1,}", 15, "expected the name of an option, not '}'"),
        ("sample{whole=1 whole=2}", 15, "the option whole is given twice"),
        ("sample{words=[a b]}", 16, "expected ',' or ']', not 'b'"),
        ("sample{words=[a,]}", 16, "expected a value, not ']'"),
        ("sample{words=[[a]]}", 14, "expected a value, not '['"),
        ('sample{word="a}', 12, 'the string has no closing "'),
        (r'sample{word="a\q"}', 14, "no such escape"),
        ("sample{real=1e400}", 12, "the number is too large"),
        (f"sample{{whole={'9' * 5000}}}", 13, "the number is too large"),
        ("sample{flag=true hole=1}", 17, "sample has no option hole; did you mean whole?"),
        ("sample{flag=true xyz=1}", 17, "sample has no option xyz; it has flag, kinds, maybe, numbers, "),
        ("sample,@", 8, "expected the name of a pipeline, not the end"),
        ("sample,@{a=1}", 8, "expected the name of a pipeline, not '{'"),
        ("sample,@robot", 7, "no pipeline is called robot: no configuration names any"),
        ("sample{whole=1.5}", 13, "option whole of sample: should be a valid integer"),
        ("sample{small=12}", 13, "option small of sample: should be less than or equal to 9"),
        ("sample{word=5}", 12, "option word of sample: should be a valid string; quote it to make it text"),
        ("sample{words=[a,5]}", 13, "option words of sample: should be a valid string; quote it to make it text"),
        ("sample{side=up}", 12, "option side of sample: should be 'left' or 'right'"),
        ("sample,needs-2-options", 7, "needs-2-options needs the option must"),
        ("sample,fill-limits{lower=2 upper=1}", 7, "fill-limits: lower is above upper"),
    ],
)
def test_an_error_points_at_the_character(text: str, position: int, problem: str) -> None:
    with pytest.raises(PipelineError) as caught:
        parse_pipeline(text)
    assert caught.value.problem.startswith(problem)
    assert (caught.value.text, caught.value.position) == (text, position)


def test_an_error_shows_the_line_and_a_caret() -> None:
    with pytest.raises(PipelineError) as caught:
        parse_pipeline("sample{\n  whole=1\n  hole=2\n}")
    assert str(caught.value).splitlines()[1:] == ["    hole=2", "    ^"]


def test_an_option_that_the_text_cannot_express_is_an_error() -> None:
    with pytest.raises(TypeError, match="a pipeline cannot express"):
        str(Pipeline((Sample(word="a").model_copy(update={"word": b"bytes"}),)))


def test_a_negative_zero_keeps_its_sign() -> None:
    (parsed,) = parse_pipeline("sample{real=-0.0}")
    assert isinstance(parsed, Sample)
    assert math.copysign(1, parsed.real) == -1


DOCUMENT = Document(format=Format.SDF)


class Diary(PassInstrumentation):
    """Writes down every call."""

    def __init__(self, seen: list[str] | None = None, name: str = "") -> None:
        self.seen: list[str] = [] if seen is None else seen
        self.name = name

    def before(self, step: Pass, document: Document, sink: DiagnosticSink) -> None:
        self.seen.append(f"{self.name}before {step.name}: {document.version}")

    def after(self, step: Pass, old: Document, new: Document, sink: DiagnosticSink) -> None:
        self.seen.append(f"{self.name}after {step.name}: {old.version}, {new.version}")

    def failed(self, step: Pass, error: PassError, sink: DiagnosticSink) -> None:
        self.seen.append(f"{self.name}failed {step.name}: {type(error).__name__}")


def refuse(document: Document, sink: DiagnosticSink) -> None:
    sink.report(INVALID, f"version {document.version}")


def test_passes_run_in_order_and_are_watched() -> None:
    pipeline = parse_pipeline("sample{word=one},needs-2-options{must=1},sample{word=two}")
    diary = Diary()
    result = pipeline.run(DOCUMENT, DiagnosticSink(), instrumentation=diary)
    assert [words for words in diary.seen if words.startswith("after")] == [
        "after sample: None, one",
        "after needs-2-options: one, one",
        "after sample: one, two",
    ]
    assert result == DOCUMENT.copy(version="two")


def test_a_pass_that_makes_an_invalid_document_is_named() -> None:
    with pytest.raises(BrokenPassError, match=r"the pass sample made an invalid document: version new \[invalid\]"):
        parse_pipeline("sample{word=new}").run(DOCUMENT, DiagnosticSink(), verify=refuse)


def test_a_document_that_did_not_change_is_not_verified_again() -> None:
    assert parse_pipeline("needs-2-options{must=1}").run(DOCUMENT, DiagnosticSink(), verify=refuse) is DOCUMENT


def test_an_exception_has_in_which_pass_it_was_raised(monkeypatch: pytest.MonkeyPatch) -> None:
    def stop(_pass: Pass, _document: Document, _notes: DiagnosticSink) -> Document:
        raise ZeroDivisionError("no parts")

    monkeypatch.setattr(Sample, "run", stop)
    diary = Diary()
    with pytest.raises(FailedPassError, match="the pass sample failed: ZeroDivisionError: no parts") as caught:
        parse_pipeline("sample").run(DOCUMENT, DiagnosticSink(), instrumentation=diary)
    assert isinstance(caught.value.__cause__, ZeroDivisionError)
    assert (caught.value.name, caught.value.document) == ("sample", DOCUMENT)
    assert diary.seen == ["before sample: None", "failed sample: FailedPassError"]


def test_a_watch_sees_what_a_broken_pass_made() -> None:
    diary = Diary()
    with pytest.raises(BrokenPassError):
        parse_pipeline("sample{word=new}").run(DOCUMENT, DiagnosticSink(), instrumentation=diary, verify=refuse)
    assert diary.seen == ["before sample: None", "after sample: None, new", "failed sample: BrokenPassError"]


def test_watches_nest_like_brackets() -> None:
    seen: list[str] = []
    watches = CombinedInstrumentation([Diary(seen, "one "), Diary(seen, "two ")])
    parse_pipeline("needs-2-options{must=1}").run(DOCUMENT, DiagnosticSink(), instrumentation=watches)
    assert [words.partition(" needs")[0] for words in seen] == ["one before", "two before", "two after", "one after"]


def test_every_instrument_is_called_alike() -> None:
    calls: list[tuple[object, ...]] = []

    class Teller(PassInstrumentation):
        def before(self, step: Pass, document: Document, sink: DiagnosticSink) -> None:
            calls.append((step, document, sink))

        def after(self, step: Pass, old: Document, new: Document, sink: DiagnosticSink) -> None:
            calls.append((step, old, new, sink))

        def failed(self, step: Pass, error: PassError, sink: DiagnosticSink) -> None:
            calls.append((step, error, sink))

    sink, [step] = DiagnosticSink(), parse_pipeline("sample{word=new}")
    with pytest.raises(BrokenPassError) as caught:
        Pipeline((step,)).run(
            DOCUMENT, sink, instrumentation=CombinedInstrumentation([Teller(), Teller()]), verify=refuse
        )
    made = DOCUMENT.copy(version="new")
    each = [(step, DOCUMENT, sink), (step, DOCUMENT, made, sink), (step, caught.value, sink)]
    assert calls == [one for one in each for _ in range(2)]


def test_a_name_stands_for_its_pipeline() -> None:
    def names(name: str) -> Pipeline:
        if name != "Two_1":
            raise UnknownPipelineError(name)
        return parse_pipeline("sample{word=a},sample{word=b}")

    assert str(parse_pipeline(" @Two_1 , sample", names=names)) == "sample{word=a},sample{word=b},sample"
    with pytest.raises(PipelineError) as caught:
        parse_pipeline("sample,@three", names=names)
    assert (caught.value.problem, caught.value.position) == ("three", 7)
