"""One conversion, as the command line asks for it."""

from dataclasses import dataclass, replace
from pathlib import Path

import click

from twinform.cli.failure import FINDINGS, UNUSABLE, Unusable
from twinform.cli.findings import show
from twinform.cli.targets import Job
from twinform.compiler import CompileError, Conversion, Order, Reading, fulfil, read, write_all_atomically
from twinform.compiler.audit import audit
from twinform.diagnostics import Fate, Ledger
from twinform.diagnostics.reporters import Findings
from twinform.ir import Document
from twinform.passes import BrokenPassError


@dataclass(frozen=True, slots=True, kw_only=True)
class Options:
    """What is the same for every input; the order is for SDF unless an input's target says otherwise."""

    order: Order
    reading: Reading
    ledger: Path | None
    dumps: tuple[str, ...]
    notes: bool
    audit: bool = False

    def order_for(self, job: Job) -> Order:
        """What one input is to become."""
        return replace(self.order, to=job.target, sdf_version=self.order.sdf_version if job.target == "sdf" else None)


def run_conversion(job: Job, options: Options, label: str) -> int:
    """Run one conversion; gives its exit code."""
    seen: list[str] = []

    def watch(name: str, document: Document) -> None:
        seen.append(name)
        if name in options.dumps:
            click.echo(f"// {job.source.name} after {name}\n{_json(document)}", err=True)

    try:
        source = job.source
        conversion = fulfil(options.order_for(job), source.content, options.reading, name=source.name, watch=watch)
    except CompileError as error:
        show(Findings(job.source.name, error.diagnostics), notes=options.notes, on_stderr=True)
        return UNUSABLE if error.unreadable else FINDINGS
    except BrokenPassError as error:
        click.echo(f"{job.source.name}: {error}", err=True)
        return FINDINGS
    show(Findings(job.source.name, conversion.diagnostics), notes=options.notes, on_stderr=True)
    _require_ran(options.dumps, seen)
    _write(conversion, job.path, options.ledger)
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


def _json(document: Document) -> str:
    return document.model_dump_json(indent=2, exclude_defaults=True)


def _require_ran(dumps: tuple[str, ...], seen: list[str]) -> None:
    for name in dumps:
        if name not in seen:
            raise click.UsageError(f"--dump-ir-after {name}: no such pass ran; there were {', '.join(seen) or 'none'}")


def _write(conversion: Conversion, path: Path | None, ledger: Path | None) -> None:
    texts = {} if path is None else {path: conversion.text}
    if ledger is not None:
        texts[ledger] = conversion.ledger.to_json()
    try:
        if path is not None:
            path.parent.mkdir(parents=True, exist_ok=True)
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
        show(Findings(checked.path, checked.diagnostics), notes=options.notes, on_stderr=True)
        return UNUSABLE if checked.unreadable else FINDINGS
    click.echo(f"{label}{': ' if label else ''}{options.order_for(job).plan(checked.document)}")
    return 0
