"""The work on one model of a batch, without the process around it."""

import json
from pathlib import Path
from typing import ClassVar

import pytest

from twinform.compiler import ConversionRequest, LoadOptions
from twinform.compiler.batch.entries import ModelEntry
from twinform.compiler.batch.jobs import Convert
from twinform.compiler.batch.record import Outcome
from twinform.compiler.batch.task import Done, Task, work
from twinform.compiler.input.size_limits import LARGEST, Limits
from twinform.diagnostics import DiagnosticSink, Policy
from twinform.ir import Document
from twinform.passes import Pass, Pipeline

pytestmark = pytest.mark.slow

GOOD = '<robot name="r"><link name="a"/></robot>'
WARNED = '<robot name="r">\n<link name="a"><color/></link></robot>'
WRONG = '<robot name="r">\n<link name="a"/><link name="a"/></robot>'


class Broken(Pass):
    """Raises."""

    name: ClassVar[str] = "broken"

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        raise ZeroDivisionError("no parts")


def _done(folder: Path, text: str, policy: Policy = Policy(), *passes: Pass) -> Done:  # noqa: B008 - it is frozen
    path = folder / "r.urdf"
    path.write_text(text)
    job = Convert(to=ConversionRequest(to="sdf", passes=Pipeline(passes)), policy=policy, ledgers=True)
    entry, faults = ModelEntry("r.urdf", "r.urdf"), folder / "faults"
    return work(Task(entry=entry, job=job, root=str(folder), load_options=LoadOptions(), output="r.sdf", faults=faults))


def test_a_model_is_converted_with_its_ledger(tmp_path: Path) -> None:
    done = _done(tmp_path, GOOD)
    assert (done.outcome, done.message, done.diagnostics) == (Outcome.CONVERTED, "", [])
    assert '<link name="a">' in str(done.texts["r.sdf"])
    assert done.ledger == {"expressed": 4, "carried": 0, "approximated": 1, "dropped": 0}
    assert json.loads(done.texts["r.sdf.ledger.json"])["expressed"] == 4


def test_a_lifted_limit_reads_the_whole_file(tmp_path: Path) -> None:
    path = tmp_path / "r.urdf"
    padding = f"<!--{' ' * 2**20}-->"
    path.write_text(f'<robot name="r">{padding * (LARGEST // 2**20)}<link name="a"/></robot>')
    job = Convert(to=ConversionRequest(to="sdf", passes=Pipeline(())), policy=Policy(), ledgers=False)
    outcomes = [
        work(
            Task(
                entry=ModelEntry("r.urdf", "r.urdf"), job=job, root=str(tmp_path), load_options=options, output="r.sdf"
            )
        )
        for options in (LoadOptions(), LoadOptions(limits=Limits(size=2 * LARGEST)))
    ]
    assert [done.outcome for done in outcomes] == [Outcome.UNREADABLE, Outcome.CONVERTED]
    assert "give a larger --max-size" in str(outcomes[0].diagnostics)


def test_warnings_are_kept(tmp_path: Path) -> None:
    (found,) = _done(tmp_path, WARNED).diagnostics
    assert found["rule"] == "unknown-element"


def test_what_is_denied_is_refused(tmp_path: Path) -> None:
    done = _done(tmp_path, WARNED, Policy(deny=frozenset({"unknown-element"})))
    assert (done.outcome, done.texts) == (Outcome.REFUSED, {})
    assert [each["rule"] for each in done.diagnostics] == ["unknown-element"]
    assert done.message.endswith("r.urdf:2: <color> is not an element of <link>")


@pytest.mark.parametrize(("text", "outcome"), [(WRONG, Outcome.REFUSED), ("<robot", Outcome.UNREADABLE)])
def test_a_model_with_errors_reports_which(text: str, outcome: Outcome, tmp_path: Path) -> None:
    done = _done(tmp_path, text)
    assert (done.outcome, done.texts) == (outcome, {})
    assert [each["rule"] for each in done.diagnostics] in (["duplicate-name"], ["not-well-formed"])


def test_a_pass_that_fails_leaves_what_makes_it_fail_again(tmp_path: Path) -> None:
    done = _done(tmp_path, GOOD, Policy(), Broken())
    assert done.outcome is Outcome.FAILED
    words, _, path = done.message.partition("; to see it again: twinform reproduce ")
    assert "broken" in words
    assert Path(path).is_relative_to(tmp_path / "faults")


def test_a_fault_of_our_own_is_reported(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(*_: object, **__: object) -> None:
        raise KeyError("lost")

    monkeypatch.setattr("twinform.compiler.batch.jobs.run_conversion", fail)
    done = _done(tmp_path, GOOD)
    assert (done.outcome, done.message) == (Outcome.FAILED, "a fault of twinform: KeyError: 'lost'")
