"""The options that results depend on: a change of any of them has the work done again."""

import json
from collections.abc import Iterator
from dataclasses import fields, is_dataclass, replace
from pathlib import Path
from typing import Any

import pytest

from twinform.compiler import ConversionRequest
from twinform.compiler.batch import Check, Convert, Diff, Stats
from twinform.compiler.dependencies import describe_options
from twinform.diagnostics import Policy

_JOBS = (Convert(to=ConversionRequest.of("sdf", {"passes": "check-inertia"})), Check(), Diff(other=Path("a")), Stats())


def _changed(value: Any) -> Iterator[Any]:
    """The value with each flag in it, and in the options that it holds, turned over."""
    if isinstance(value, bool):
        yield not value
    elif is_dataclass(value) and not isinstance(value, type):
        for each in fields(value):
            yield from (replace(value, **{each.name: other}) for other in _changed(getattr(value, each.name)))


@pytest.mark.parametrize("job", _JOBS, ids=lambda job: type(job).__name__)
def test_every_flag_counts(job: Any) -> None:
    others = list(_changed(job))
    assert others
    assert len({json.dumps(describe_options(each)) for each in (job, *others)}) == len(others) + 1


def test_passes_versions_and_rules_count_and_the_order_of_rules_does_not() -> None:
    requests = [
        ConversionRequest.of("sdf", {}),
        *(ConversionRequest.of("sdf", {"sdf_version": v}) for v in ("1.9", "1.11")),
    ]
    requests.append(ConversionRequest.of("sdf", {"passes": "check-inertia,check-limits"}))
    denied = [Convert(to=requests[0], policy=Policy(deny=frozenset(names))) for names in ("ab", "a")]
    jobs = [*(Convert(to=each) for each in requests), *denied, *_JOBS]
    assert len({json.dumps(describe_options(each)) for each in jobs}) == len(jobs)
    one, other = (Check(policy=Policy(allow=frozenset(names))) for names in (["x", "y", "z"], ["z", "y", "x"]))
    assert describe_options(one) == describe_options(other)
