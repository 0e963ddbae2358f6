"""Corpus files with mistakes before us and before the parsers of record: where we disagree, somebody knows why."""

from pathlib import Path

import pytest

from reports.harness.needs import libsdformat, urdfdom, urdfdom_6
from reports.mistakes_found import urdf_versions
from reports.mistakes_found.verdicts import judged, unexplained
from testbed.corpus.files import Kind
from testbed.mutated.mjcf_mutated import mutated_mjcf
from testbed.mutated.mutated import mutated
from testbed.mutated.verdicts import OF_MJCF, QUESTIONS, verdicts
from tests.profile import DEEP

CHUNKS = 4
EACH = 500 if DEEP else 25


@pytest.fixture
def judges(corpus: Path) -> None:
    assert corpus.is_dir()
    if why := libsdformat() or urdfdom():
        pytest.skip(why)


@pytest.mark.usefixtures("judges")
@pytest.mark.parametrize("kind", [Kind.SDF, Kind.URDF])
@pytest.mark.parametrize("chunk", range(CHUNKS))
def test_every_disagreement_with_a_parser_of_record_has_a_reason(chunk: int, kind: Kind) -> None:
    found = judged(kind, range(chunk * EACH, (chunk + 1) * EACH))
    assert list(map(str, unexplained(found))) == []


@pytest.mark.usefixtures("judges")
@pytest.mark.parametrize("kind", [Kind.SDF, Kind.URDF])
def test_the_documents_are_of_both_kinds_for_all(kind: Kind) -> None:
    for question in (question for question in QUESTIONS if question.kind is kind):
        found = [verdict for verdict in judged(kind, range(25)) if verdict.question == question]
        assert {verdict.accepted for verdict in found} == {True, False}
        assert {verdict.opinion.accepts for verdict in found} == {True, False}


@pytest.mark.skipif(bool(urdfdom_6()), reason=urdfdom_6())
@pytest.mark.parametrize("chunk", range(CHUNKS))
def test_every_version_of_urdf_is_judged_as_urdfdom_6_does(chunk: int) -> None:
    found = urdf_versions.judged(range(chunk * EACH, (chunk + 1) * EACH))
    assert list(map(str, unexplained(found))) == []
    assert {(verdict.accepted, verdict.opinion.accepts) for verdict in found} >= {(True, True), (False, False)}


@pytest.mark.usefixtures("judges")
def test_a_number_makes_the_same_document_again() -> None:
    assert mutated(Kind.SDF, 5) == mutated(Kind.SDF, 5)
    assert mutated(Kind.SDF, 5) != mutated(Kind.SDF, 6)


@pytest.mark.parametrize("chunk", range(CHUNKS))
def test_every_disagreement_with_mujoco_has_a_reason(chunk: int) -> None:
    pytest.importorskip("mujoco")
    seeds = range(chunk * EACH, (chunk + 1) * EACH)
    found = [*verdicts([OF_MJCF], (mutated_mjcf(seed, fetched=DEEP) for seed in seeds))]
    assert list(map(str, unexplained(found))) == []
    assert {(verdict.accepted, verdict.opinion.accepts) for verdict in found} >= {(True, True), (False, False)}
    unplaced = [one for verdict in found for one in verdict.findings if one.is_error and not one.location.line]
    assert unplaced == []
