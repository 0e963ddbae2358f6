"""Reports on migrated plugins: findings, ledger entries, and what the author has to check."""

from collections.abc import Iterable, Iterator

from twinform.dataclass import dataclass
from twinform.diagnostics import DiagnosticSink, Fate, Location, rules
from twinform.ir import Element, Plugin
from twinform.passes.classic.moving import DroppedParameter, truth_of
from twinform.passes.classic.tables import Caveat, Migration
from twinform.passes.plugins.sites import PluginSite, plugin_element


def trial_sink(sink: DiagnosticSink) -> DiagnosticSink:
    """A sink for findings about something that may fail, to be accepted if it does not."""
    return DiagnosticSink(sink.file, sink.strict, origins=sink.origins)


def accept_trial(sink: DiagnosticSink, tried: DiagnosticSink) -> None:
    """Take over the findings and ledger entries of a trial."""
    sink.diagnostics.extend(tried.diagnostics)
    sink.entries.extend(tried.entries)
    sink.has_errors = sink.has_errors or tried.has_errors


@dataclass(frozen=True, slots=True)
class MigrationReport:
    """Reports at the location of a plugin."""

    sink: DiagnosticSink
    plugin: Plugin
    site: PluginSite

    @property
    def where(self) -> Location:
        """The location of the plugin; if a pass has made it, that of its holder."""
        if self.plugin.source:
            return self.plugin.location
        holder = self.site.sensor or self.site.model or self.site.world
        return holder.location if holder else self.plugin.location

    @property
    def what(self) -> str:
        """The plugin as a part of a sentence."""
        return f"plugin {self.plugin.name!r} of {self.plugin.filename}"

    def migrated(self, became: str, lost: Iterable[DroppedParameter]) -> None:
        """Report what the plugin became, and which parameters have no counterpart."""
        self._account(f"{self.what} became {became}", lost)

    def needless(self, reason: str, lost: Iterable[DroppedParameter]) -> None:
        """Report that gz-sim does not need the plugin."""
        self._account(f"{self.what} is not needed: {reason}", lost)

    def _account(self, message: str, lost: Iterable[DroppedParameter]) -> None:
        self.sink.report(rules.MIGRATED_PLUGIN, message, self.where, found=self.plugin.filename)
        # The ledger counts elements and attributes of the source: what each lost parameter weighs
        # is taken off, so that nothing is counted twice.
        weight = plugin_element(self.plugin).weight
        for each in lost:
            weight -= each.parameter.weight
            self._report_lost(each)
        self.sink.account(Fate.APPROXIMATED, rules.MIGRATED_PLUGIN, message, self.where, max(weight, 0))

    def without(self, reason: str, *, keeps: bool) -> None:
        """Report that the plugin has no counterpart, and why."""
        end = "it is kept" if keeps else "it is left out"
        message = f"{self.what} has no counterpart in gz-sim, so {end}: {reason}"
        self.sink.report(rules.PLUGIN_WITHOUT_COUNTERPART, message, self.where, found=self.plugin.filename)
        if not keeps:
            weight = plugin_element(self.plugin).weight
            self.sink.account(Fate.DROPPED, rules.PLUGIN_WITHOUT_COUNTERPART, message, self.where, weight)

    def renamed(self, modern: Plugin) -> None:
        """Report the current name of the plugin."""
        message = f"{self.what} is called {modern.filename} now"
        if modern.filename == self.plugin.filename:
            message = f"{self.what} uses the current names of its parameters"
        self.sink.report(rules.IGNITION_NAME, message, self.where, found=self.plugin.filename)
        weight = plugin_element(self.plugin).weight
        self.sink.account(Fate.APPROXIMATED, rules.IGNITION_NAME, message, self.where, weight)

    def missing(self, what: str) -> None:
        """Report what the author has to add."""
        message = f"{self.what} was migrated, but {what}"
        self.sink.report(rules.INCOMPLETE_MIGRATION, message, self.where, found=self.plugin.filename)

    def _report_lost(self, lost: DroppedParameter) -> None:
        parameter, where = lost.parameter, self._location_of(lost.parameter)
        message = f"<{parameter.name}> of {self.what} has no counterpart: {lost.reason}"
        if not lost.harmless:
            found = parameter.text
            self.sink.report(rules.PARAMETER_WITHOUT_COUNTERPART, message, where, found=found)
        self.sink.account(Fate.DROPPED, rules.PARAMETER_WITHOUT_COUNTERPART, message, where, parameter.weight)

    def _location_of(self, parameter: Element) -> Location:
        return parameter.location if parameter.source else self.where


def needed_checks(migration: Migration, plugin: Plugin, sensor: str | None = None) -> Iterator[str]:
    """What the author has to add or to know after a migration; `sensor` is the type that the plugin became."""
    if migration.geometry:
        yield migration.geometry
    for caveat in migration.caveats:
        if caveat.type in {None, sensor} and _caveat_applies(caveat, plugin):
            yield caveat.text


def _caveat_applies(caveat: Caveat, plugin: Plugin) -> bool:
    written = {child.name: child.text or "" for child in plugin.content}
    if any(name in written for name in caveat.unless):
        return False
    return not caveat.where or any(truth_of(written.get(name, "")) for name in caveat.where)
