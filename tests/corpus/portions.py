"""The models of the corpus in portions, for tests to share among processes."""

from collections.abc import Iterable
from itertools import groupby

from testbed.corpus.files import CorpusFile, Kind, models
from tests.profile import DEEP

_PORTION = 40


def chunks(*kinds: Kind) -> dict[str, tuple[CorpusFile, ...]]:
    """The models of some kinds, or all, in portions of one repository, so that test processes can share them evenly."""
    return portions([file for file in models() if not kinds or file.kind in kinds])


def portions(wanted: Iterable[CorpusFile]) -> dict[str, tuple[CorpusFile, ...]]:
    """Some files in portions of one repository: every twelfth of each, and all of them in the deep profile."""
    found: dict[str, tuple[CorpusFile, ...]] = {}
    for repository, group in groupby(wanted, key=lambda file: file.repository):
        files = tuple(group)[:: 1 if DEEP else 12]
        found |= {f"{repository}-{i}": files[i : i + _PORTION] for i in range(0, len(files), _PORTION)}
    # without a corpus one empty portion stays, for the test to skip with its reason
    return found or {"none": ()}
