"""Run by `fuzz/run.py`: one target of tests/fuzz under atheris, with the options of libFuzzer."""

import sys
from functools import partial

import atheris

_SECONDS = 20
"""Of processor time: what is instrumented takes several times as long, and to import it seconds."""
_NOT_UNDERSTOOD = ["twinform.profiles.lumped_masses"]
"""Modules of which atheris 3.0 cannot disassemble the bytecode."""

if __name__ == "__main__":
    _, name, *options = sys.argv
    # all of it inside, since much of the package is imported when it is used
    with atheris.instrument_imports(include=["twinform"], exclude=_NOT_UNDERSTOOD):
        from fuzz.table import TARGETS

        atheris.Setup([name, *options], partial(TARGETS[name], seconds=_SECONDS))
        atheris.Fuzz()
