"""`PYTHONPATH=. python fuzz/pipeline.py CORPUS [-max_total_time=SECONDS]`: a target of tests/fuzz under atheris."""

import sys

import atheris

with atheris.instrument_imports(include=["twinform"]):
    from tests.fuzz.targets import pipeline as target

if __name__ == "__main__":
    atheris.Setup(sys.argv, target)
    atheris.Fuzz()
