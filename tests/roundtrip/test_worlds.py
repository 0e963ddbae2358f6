"""Worlds taken apart and put together again, tried on worlds that Hypothesis makes up."""

from collections.abc import Generator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Literal

import pytest
from hypothesis import given

from testbed.worlds import Loaded, Together, judge
from tests.profile import examples
from twinform.compiler.output.emitting import emit
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Box, Cylinder, Document, Sphere
from twinform.testing import strategies

VERSION = "1.9"
"""The newest version that libsdformat 12 reads."""
_WORLDS = strategies.worlds(version=VERSION, nested=True, anchored=True)
_PLAIN = strategies.worlds(version=VERSION, anchored=True, shapes=(Box, Cylinder, Sphere))


@contextmanager
def _written(world: Document) -> Generator[tuple[Path, Path]]:
    """The world as a file, and a folder to take it apart in."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "arena.world"
        path.write_text(emit(world, DiagnosticSink()))
        yield path, Path(folder) / "out"


@pytest.mark.parametrize("to", ["urdf", "sdf"])
@examples(0.2)
@given(world=_WORLDS | _PLAIN)
def test_a_world_taken_apart_and_put_together_is_the_same(to: Literal["urdf", "sdf"], world: Document):
    with _written(world) as (path, out):
        found = judge("arena", path, (), out, to)
    assert found is None or found.together is Together.SAME, found
    assert found is None or found.loaded in {Loaded.SAME, Loaded.NEITHER, Loaded.UNASKED}, found
