"""What has fuzzing tried, and what did it find? The logs of `make fuzz`."""

import re
from pathlib import Path
from typing import NamedTuple

from fuzz.run import LOG, OUT, PROCESSOR, ROOT
from fuzz.table import SECONDS, TARGETS
from reports.harness.sample import Sample
from reports.harness.section import Findings, Section
from testbed.markdown import table

_HEAD = ("target", "processor time", "runs", "runs a second", "coverage at first", "at the end", "inputs kept", "found")
_PROGRESS = re.compile(r"^#(\d+)\t(\w+) +cov: (\d+) ft: \d+ corp: (\d+)", re.MULTILINE)
"""A line of libFuzzer: runs so far, what has happened, coverage, and inputs in the corpus."""
_ABOUT = f"""\
Each target of `fuzz/targets.py` says what must hold for any input at all, and [atheris](https://github.com/google/atheris),
which is libFuzzer for Python, searches for one with which it does not hold: an exception, another text once written and
read again, a file written elsewhere, or more than {SECONDS} seconds of the processor. Coverage counts branches and
comparisons of the package: at first of the seeds, at the end of all inputs that were kept. What was found is fixed,
lies in `tests/fuzz/found/` and is tried by every `make test`."""


class FuzzLog(NamedTuple):
    """What the log of a target says; it may be that of several runs."""

    seconds: int
    runs: int
    first: int
    last: int
    kept: int
    failures: int

    @classmethod
    def parse(cls, text: str) -> "FuzzLog":
        """From its lines; of a run that has not ended the last line of its progress counts."""
        progress = _PROGRESS.findall(text)
        begun = next((int(cover) for _, word, cover, _ in progress if word == "INITED"), 0)
        runs = [max((int(each[0]) for each in _PROGRESS.findall(run)), default=0) for run in text.split(PROCESSOR)]
        return cls(
            sum(map(int, re.findall(rf"^{PROCESSOR}(\d+)$", text, re.MULTILINE))),
            sum(runs),
            begun,
            max((int(cover) for _, _, cover, _ in progress), default=0),
            int(progress[-1][3]) if progress else 0,
            text.count("Uncaught Python exception") + text.count("ERROR: libFuzzer"),
        )


def measure(_: Sample) -> Findings:
    """Read the logs."""
    logs = {name: OUT / name / LOG for name in TARGETS}
    found = {name: FuzzLog.parse(_text(path)) for name, path in logs.items() if path.is_file()}
    faults = [f"{name}: {log.failures} inputs failed: see {logs[name]}" for name, log in found.items() if log.failures]
    faults += [f"{name} was not run" for name in TARGETS if name not in found]
    rows = table(_HEAD, [_row(name, log) for name, log in found.items() if log.seconds])  # others are not done
    return Findings([rows], rows, faults)


def _text(path: Path) -> str:
    return path.read_text(errors="replace")


def _row(name: str, log: FuzzLog) -> tuple[object, ...]:
    fixed = len([*(ROOT / "tests" / "fuzz" / "found" / name).glob("*")])
    minutes = f"{log.seconds / 60:.0f} min"
    return name, minutes, f"{log.runs:,}", f"{log.runs / max(1, log.seconds):.0f}", log.first, log.last, log.kept, fixed


def _logs() -> str:
    return "" if any(OUT.glob(f"*/{LOG}")) else "there is no log: run make fuzz"


SECTION = Section("fuzzing", _ABOUT, measure, needs=(_logs,))
