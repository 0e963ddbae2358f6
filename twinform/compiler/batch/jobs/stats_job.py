"""Counts what each model of a batch is made of."""

import json
from dataclasses import dataclass

from twinform.compiler.batch.jobs.finding_rows import refused
from twinform.compiler.batch.record import Outcome
from twinform.compiler.batch.task import Done, Task
from twinform.compiler.conversion_error import CompileError
from twinform.compiler.includes.expanding import expand
from twinform.compiler.input.loading import read
from twinform.compiler.statistics import REPORTERS, measure
from twinform.diagnostics import Policy


@dataclass(frozen=True, slots=True, kw_only=True)
class Stats:
    """Say in numbers what a model is made of, as `twinform stats` does; with `meshes` also what its meshes cost."""

    meshes: bool = True
    expand_includes: bool = False

    @property
    def request(self) -> list[object]:
        """The options that the outcome depends on."""
        return ["stats", self.meshes, self.expand_includes]

    def work(self, task: Task, content: bytes) -> Done:
        """Measure it."""
        del content  # it is read by its path
        name = str(task.path)
        loaded = read(task.path, task.load_options, name=name)
        loaded = expand(loaded, task.load_options) if self.expand_includes else loaded
        if loaded.document is None or not loaded.accepted:
            return refused(CompileError(loaded.diagnostics, unreadable=loaded.unreadable), Policy(), name)
        found = measure(loaded, loaded.document, task.load_options.search, meshes=self.meshes)
        (details,) = json.loads(REPORTERS["json"]([found]))["files"]
        return Done(outcome=Outcome.MEASURED, details={"statistics": details})
