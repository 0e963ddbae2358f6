"""Run by `PYTHONPATH=. python fuzz/load.py CORPUS [-max_total_time=SECONDS]`: a target of tests/fuzz under atheris."""

import sys

import atheris

with atheris.instrument_imports(include=["twinform"]):
    from tests.fuzz.targets import load as target

if __name__ == "__main__":
    atheris.Setup(sys.argv, target)
    atheris.Fuzz()
