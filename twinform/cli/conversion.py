"""One conversion, as the command line asks for it."""

from dataclasses import dataclass, replace
from pathlib import Path

import click

from twinform.cli.companions import Companions
from twinform.cli.failure import FINDINGS, UNUSABLE, Unusable
from twinform.cli.findings import show
from twinform.cli.targets import Job
from twinform.cli.watching import Watching
from twinform.compiler import CompileError, Conversion, Order, Reading, fulfil, read, write_all_atomically
from twinform.compiler.audit import audit
from twinform.diagnostics import Diagnostic, Fate, Ledger, Policy
from twinform.diagnostics.reporters import Findings
from twinform.passes import PassError


@dataclass(frozen=True, slots=True, kw_only=True)
class Options:
    """What is the same for every input; the order is for SDF unless an input's target says otherwise."""

    order: Order
    reading: Reading
    ledger: Path | None
    notes: bool
    policy: Policy
    watching: Watching
    companions: Companions
    audit: bool = False

    def order_for(self, job: Job) -> Order:
        """What one input is to become."""
        return replace(self.order, to=job.target, sdf_version=self.order.sdf_version if job.target == "sdf" else None)

    def show(self, name: str, diagnostics: tuple[Diagnostic, ...]) -> bool:
        """Print the findings as the project wants to see them; whether none of them is an error."""
        seen = self.policy.apply(diagnostics)
        show(Findings(name, seen), notes=self.notes, on_stderr=True)
        return not any(each.is_error for each in seen)


def run_conversion(job: Job, options: Options, label: str) -> int:
    """Run one conversion; gives its exit code."""
    source, watched = job.source, options.watching.begin(job.source.name)
    try:
        order = options.order_for(job)
        conversion = fulfil(order, source.content, options.reading, name=source.name, watch=watched.watch)
    except CompileError as error:
        watched.report()
        options.show(job.source.name, error.diagnostics)
        return UNUSABLE if error.unreadable else FINDINGS
    except PassError as error:
        watched.fault(error)
        return FINDINGS
    watched.end()
    if not options.show(job.source.name, conversion.diagnostics):
        return FINDINGS
    _write(conversion, job.path, options.ledger)
    if not options.companions.write(conversion, job.source.name, notes=options.notes):
        return FINDINGS
    click.echo(f"{label}{': ' if label else ''}{summary(conversion.ledger)}", err=True)
    return _audit(conversion, job.source.name) if options.audit else 0


def _audit(conversion: Conversion, name: str) -> int:
    """Count what became of every part, by an instrument that knows nothing of the conversion; 1 if any is missing."""
    if conversion.source is None or not conversion.text.startswith("<"):
        raise click.UsageError("--audit counts elements of XML, and this is JSON")
    found = audit(conversion.source, conversion.text, conversion.ledger)
    for part in found.unaccounted:
        click.echo(
            f"{name}:{part.location.line}: nothing accounts for {part.says}\n    at {part.location.path}", err=True
        )
    click.echo(f"audit: {found.total} parts, {len(found.unaccounted)} unaccounted", err=True)
    return FINDINGS if found.unaccounted else 0


def _write(conversion: Conversion, path: Path | None, ledger: Path | None) -> None:
    texts = {} if path is None else {path: conversion.text}
    if ledger is not None:
        texts[ledger] = conversion.ledger.to_json()
    try:
        write_all_atomically(texts)
        if path is None:
            click.echo(conversion.text.encode(), nl=False)  # the XML declaration says UTF-8, whatever the terminal's is
    except BrokenPipeError:
        raise  # click ends quietly
    except OSError as error:
        raise Unusable(f"cannot write {error.filename or path}: {error.strerror}") from error


def summary(ledger: Ledger) -> str:
    """How much was expressed, and how much met each other fate."""
    return ", ".join([f"expressed {ledger.expressed}", *(f"{fate} {ledger.count(fate)}" for fate in Fate)])


def print_plan(job: Job, options: Options, label: str) -> int:
    """Print the passes of one conversion; gives its exit code."""
    checked = read(job.source.content, options.reading, name=job.source.name)
    if checked.document is None or not checked.accepted:
        options.show(checked.path, checked.diagnostics)
        return UNUSABLE if checked.unreadable else FINDINGS
    click.echo(f"{label}{': ' if label else ''}{options.order_for(job).plan(checked.document)}")
    return 0
