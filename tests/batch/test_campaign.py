"""The short form of `make report NAME=batch_losses`: nothing is lost, and nothing is out of date."""

import random
from pathlib import Path

import pytest

from testbed.batches.campaign import Campaign, play


def test_whatever_fails_no_result_is_lost_and_none_is_out_of_date(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    campaign = Campaign(count=23, chance=random.Random(31), share=0.2)
    campaign.prepare()
    play(campaign, [lambda: campaign.kill_runs(2), lambda: campaign.lose(campaign.out, "the results are gone")])
    tally = campaign.tally
    assert (tally.lost, tally.stale) == ([], [])
    assert tally.events.total() == 2
    assert tally.earlier > 40
