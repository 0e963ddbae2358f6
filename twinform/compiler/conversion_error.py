"""The exceptions of the compiler's public API."""

import errno
import os

from twinform.diagnostics import Diagnostic


class CompileError(Exception):
    """A document could not be read or compiled.

    `diagnostics` have the reasons; `unreadable` is true where it is no robot model at all.
    """

    def __init__(self, diagnostics: tuple[Diagnostic, ...], *, unreadable: bool = False) -> None:
        self.diagnostics = diagnostics
        self.unreadable = unreadable
        errors = [diagnostic for diagnostic in diagnostics if diagnostic.is_error]
        first = errors[0] if errors else None
        more = f" (and {len(errors) - 1} more)" if len(errors) > 1 else ""
        where = f"{first.location.file}:{first.location.line}: " if first else ""
        super().__init__(f"{where}{first.message if first else 'not compiled'}{more}")


class MissingFileError(CompileError, FileNotFoundError):
    """There is no such file."""

    def __init__(self, diagnostics: tuple[Diagnostic, ...], *, unreadable: bool = True) -> None:
        super().__init__(diagnostics, unreadable=unreadable)
        names = (each.location.file for each in diagnostics if each.is_error)
        self.errno, self.strerror, self.filename = errno.ENOENT, os.strerror(errno.ENOENT), next(names, None)


class ReadOnlyPassError(Exception):
    """A pass that should be read-only changes the document or makes a file."""
