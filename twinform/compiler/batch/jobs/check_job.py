"""Checks each model of a batch."""

from dataclasses import dataclass, field

from twinform.compiler.batch.jobs.finding_rows import rows
from twinform.compiler.batch.record import Outcome
from twinform.compiler.batch.task import Done, Task
from twinform.compiler.conversion_error import CompileError
from twinform.compiler.includes.expanding import expand
from twinform.compiler.input.finding_spans import with_columns
from twinform.compiler.input.loading import read
from twinform.compiler.input.source_files import SourceFiles
from twinform.compiler.inspection import inspect
from twinform.diagnostics import Policy
from twinform.passes import Pipeline


@dataclass(frozen=True, slots=True, kw_only=True)
class Check:
    """Find everything that is wrong with a model, as `twinform check` does."""

    policy: Policy = field(default_factory=Policy)
    passes: Pipeline = field(default_factory=Pipeline)
    expand_includes: bool = False

    @property
    def request(self) -> list[object]:
        """The options that the outcome depends on."""
        policy = [sorted(self.policy.allow), sorted(self.policy.deny)]
        return ["check", str(self.passes), self.expand_includes, *policy]

    def work(self, task: Task, content: bytes) -> Done:
        """Check it."""
        del content  # it is read by its path
        name = str(task.path)
        loaded = read(task.path, task.load_options, name=name)
        loaded = expand(loaded, task.load_options) if self.expand_includes else loaded
        seen = self.policy.apply(inspect(loaded, task.load_options, self.passes).diagnostics)
        seen = with_columns(seen, SourceFiles.of(loaded)) if seen else seen
        if not loaded.unreadable and not any(each.is_error for each in seen):
            return Done(outcome=Outcome.ACCEPTED, diagnostics=rows(seen, name))
        outcome = Outcome.UNREADABLE if loaded.unreadable else Outcome.REFUSED
        return Done(outcome=outcome, message=str(CompileError(seen)), diagnostics=rows(seen, name))
