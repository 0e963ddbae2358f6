"""The page of the pipeline has every pass of legalisation, in the order in which they run."""

import re
from pathlib import Path

import pytest

import twinform
from generators.pipeline_page import pipeline_page
from twinform.compiler import plan
from twinform.ir import Format
from twinform.passes.framework.pipeline_text import parse_pipeline
from twinform.passes.legalise import Target, legalisation, legalisation_kinds

PAGE = Path(__file__).parents[3] / "docs/explanation/pipeline.md"
_ITEM = re.compile(r"^\d+\. \[`(.*?)`\]\((.*?)\): (.+)$", re.MULTILINE)


def test_every_pass_of_legalisation_is_there_with_a_link_that_leads_to_it() -> None:
    items = _ITEM.findall(pipeline_page())
    assert {text.partition("{")[0] for text, _, _ in items} == set(legalisation_kinds())
    for text, link, _ in items:
        name = text.partition("{")[0]
        assert f'"{name}"' in (PAGE.parent / link).read_text()


@pytest.mark.parametrize("target", [Target(Format.SDF, "1.4"), Target(Format.SDF, "1.12"), Target(Format.URDF)])
def test_passes_made_without_validation_have_valid_options(target: Target) -> None:
    source = Format.URDF if target.format is Format.SDF else Format.SDF
    for step in legalisation(source, "1.6", target):
        assert type(step).model_validate(step.model_dump()) == step


def test_every_pass_of_legalisation_can_be_written_as_text() -> None:
    for text, _, _ in _ITEM.findall(pipeline_page()):
        assert str(parse_pipeline(text, kinds=legalisation_kinds())) == text


@pytest.mark.parametrize(
    ("title", "source", "to"),
    [
        ("From URDF to SDF 1.11", '<robot name="r"><link name="a"/></robot>', "sdf"),
        ("From SDF to URDF", '<sdf version="1.12"><model name="m"><link name="a"/></model></sdf>', "urdf"),
    ],
)
def test_a_chapter_is_what_a_conversion_runs(title: str, source: str, to: str) -> None:
    chapter = pipeline_page().partition(f"### {title}\n")[2].partition("\n### ")[0]
    document = twinform.loads(source)
    planned = plan(document, to="sdf" if to == "sdf" else "urdf")
    assert ",".join(text for text, _, _ in _ITEM.findall(chapter)) == str(planned)
