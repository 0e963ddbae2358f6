"""What all tests share."""

from pathlib import Path

import pytest

from tests.corpus.files import CORPUS, MISSING


@pytest.fixture(scope="session")
def corpus() -> Path:
    """The folder of real models; tests that need it are skipped where it is missing."""
    if not CORPUS.is_dir():
        pytest.skip(MISSING)
    return CORPUS
