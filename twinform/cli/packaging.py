"""One package, as the command line asks for it."""

import json
from dataclasses import dataclass
from pathlib import Path

import click

from twinform.cli.failure import FINDINGS, UNUSABLE, Unusable
from twinform.cli.instrumentation import show_fault
from twinform.cli.outputs import Output, Outputs
from twinform.cli.print_findings import show
from twinform.cli.printing import print_line, print_text
from twinform.cli.run_conversion import summary
from twinform.cli.source import InputSource
from twinform.compiler import CompileError
from twinform.compiler.input.source_files import SourceFiles
from twinform.compiler.packaging.kinds import build
from twinform.compiler.packaging.order import Built, Order
from twinform.compiler.packaging.package import Package
from twinform.compiler.packaging.writing import OccupiedError, write_package
from twinform.diagnostics import Diagnostic, Policy
from twinform.diagnostics.reporters import FileFindings
from twinform.passes import PassError


@dataclass(frozen=True, slots=True)
class Packaging:
    """What is put into a package, where that goes, and what is printed."""

    source: InputSource
    order: Order
    kinds: tuple[str, ...]
    folder: Path
    policy: Policy
    force: bool
    dry_run: bool
    ledger: Path | None
    notes: bool
    every: bool

    def show(self, diagnostics: tuple[Diagnostic, ...]) -> bool:
        """Print the findings as the project wants to see them; whether none of them is an error."""
        seen = self.policy.apply(diagnostics)
        content = self.source.content
        files = SourceFiles({self.source.name: content}) if isinstance(content, bytes) else SourceFiles()
        show(FileFindings(self.source.name, seen), notes=self.notes, on_stderr=True, every=self.every, files=files)
        return not any(each.is_error for each in seen)


def run_packaging(packaging: Packaging) -> int:
    """Make a package and write it; gives the exit code."""
    try:
        built = build(packaging.order, packaging.kinds)
    except CompileError as error:
        packaging.show(error.diagnostics)
        return UNUSABLE if error.unreadable else FINDINGS
    except PassError as error:
        show_fault(error, packaging.source.name)
        return FINDINGS
    if not packaging.show(built.diagnostics):
        return FINDINGS
    if packaging.dry_run:
        for path in built.package.files:
            print_line(path)
        return 0
    _write(built, packaging)
    return 0


def _write(built: Built, packaging: Packaging) -> None:
    """Write the package, and the ledger beside it.

    Raises:
        click.UsageError: a file that was read would be written over, or one that somebody else has put there.
        Unusable: something cannot be written.
    """
    outputs = Outputs([packaging.source.path])
    places = [Output("-o", packaging.folder / path) for path in built.package.files]
    ledger = [Output("--ledger", packaging.ledger)] if packaging.ledger else []
    outputs.require_apart([*places, *ledger], packaging.order.load_options.search.seen)
    ledgers = {name: json.loads(each.to_json()) for name, each in built.ledgers.items()}
    beside = {each.path: json.dumps(ledgers, indent=2) + "\n" for each in ledger}
    try:
        write_package(built.package, packaging.folder, force=packaging.force, beside=beside)
    except OccupiedError as error:
        raise click.UsageError(f"{error.strerror}; --force does that") from error
    except OSError as error:
        raise Unusable(f"cannot write {error.filename or packaging.folder}: {error.strerror}") from error
    for name, each in built.ledgers.items():
        print_text(f"{name}: {summary(each)}", err=True)
    print_text(f"{packaging.folder}: {_size(built.package)}", err=True)


def _size(package: Package) -> str:
    """How much is in a package."""
    sizes = [len(each) if isinstance(each, bytes) else each.stat().st_size for each in package.files.values()]
    return f"{len(sizes)} files, {sum(sizes) / 1e6:.1f} MB"
