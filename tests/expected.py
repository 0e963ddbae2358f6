"""Texts that lie beside the cases that they are expected of."""

from pathlib import Path

import pytest


def assert_expected(text: str | None, path: Path) -> None:
    """The text is that of the file; for None there is none. A file that is missing is written, and the test fails."""
    if text is not None and not path.exists():
        path.write_text(text, encoding="utf-8")
        pytest.fail(f"{path.name} was missing and is written now; read it before you keep it")
    assert text == (path.read_text(encoding="utf-8") if path.exists() else None)
