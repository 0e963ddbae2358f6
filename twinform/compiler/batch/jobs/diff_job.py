"""Compares each model of a batch with the one of the same name in another folder."""

import json
from dataclasses import astuple, dataclass
from pathlib import Path

from twinform.compiler.batch.jobs.finding_rows import refused
from twinform.compiler.batch.record import Outcome
from twinform.compiler.batch.task import Done, Task
from twinform.compiler.compare import USUAL, ComparisonOptions, compare_files
from twinform.compiler.compare.comparison_reporters import REPORTERS, summary
from twinform.compiler.conversion_error import CompileError
from twinform.diagnostics import Policy


@dataclass(frozen=True, slots=True, kw_only=True)
class Diff:
    """Say whether two models are the same robot, as `twinform diff` does; the second one is in the folder `other`."""

    other: Path
    options: ComparisonOptions = USUAL

    @property
    def request(self) -> list[object]:
        """The options that the outcome depends on."""
        return ["diff", str(self.other), *astuple(self.options)]

    def work(self, task: Task, content: bytes) -> Done:
        """Compare it."""
        del content  # it is read by its path
        a, b = task.path, self.other / task.entry.other
        try:
            found = compare_files(a, b, task.load_options, self.options, names=(str(a), str(b)))
        except CompileError as error:
            return refused(error, Policy(), str(a))
        outcome = Outcome.SAME if found.same else Outcome.DIFFERENT
        message = "" if found.same else summary(found)
        return Done(outcome=outcome, message=message, details={"comparison": json.loads(REPORTERS["json"](found))})
