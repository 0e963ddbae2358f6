import re
from enum import StrEnum
from typing import Annotated, ClassVar, Literal

from pydantic import Field

from generators.passes_page import passes_page
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Document
from twinform.passes import Pass, parse_pipeline, registered_passes
from twinform.passes.framework.pass_page import options


class Side(StrEnum):
    LEFT = "left"
    RIGHT = "right"


class Sample(Pass):
    """Has an option of every kind."""

    name: ClassVar[str] = "sample"

    must: int
    real: float | None = 0.5
    long_name: tuple[str, ...] = ("a", "b c")
    flag: bool = False
    side: Side = Side.LEFT
    kind: Literal["one", "two"] | None = None
    place: tuple[Annotated[float, Field(ge=0)], float] | None = None

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        del sink
        return document


def test_options_are_described_in_the_terms_of_the_grammar() -> None:
    assert [each[:3] for each in options(Sample)] == [
        ("must", "whole number", "has to be given"),
        ("real", "number", "0.5"),
        ("long-name", "list of text", '[a,"b c"]'),
        ("flag", "true or false", "false"),
        ("side", "left or right", "left"),
        ("kind", "one or two", "not set"),
        ("place", "list of number", "not set"),
    ]


def test_every_option_has_a_description_and_every_example_parses() -> None:
    for each in registered_passes().values():
        kind = each.load()
        assert all(option.text for option in options(kind))
        assert any(isinstance(part, kind) for part in parse_pipeline(kind.example))


def test_the_page_has_our_passes_in_order() -> None:
    ours = [name for name, each in registered_passes().items() if each.owner == "twinform"]
    assert re.findall(r"^## (.*)$", passes_page(), re.MULTILINE) == ours
