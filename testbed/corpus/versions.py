"""One real file in other versions of SDF, and back."""

from dataclasses import dataclass

import twinform
from testbed.corpus.examine import rules_of
from testbed.corpus.files import CorpusFile
from twinform.diagnostics import Fate, Ledger
from twinform.ir import Document
from twinform.ir.changes import changes
from twinform.passes.framework.hooks import line_of
from twinform.passes.sdf_versions.put_back import comparable

NEWEST = "1.12"


@dataclass(frozen=True, slots=True)
class Trip:
    """A file in the newest version, in an older one and in the newest again.

    `refused_by` are the rules of the errors met; `difference` is the first one between the two newest, and
    `accounted` is whether a ledger mentions anything that does not come back. `stale` means that carriers were not
    trusted although nobody touched the file; `unclean` that the older file has parts that its version does not have.
    """

    name: str
    version: str
    refused_by: tuple[str, ...] = ()
    difference: str = ""
    accounted: bool = False
    stale: bool = False
    unclean: str = ""

    @property
    def arrived(self) -> bool:
        """Whether it came to its end."""
        return not self.refused_by


def there_and_back(file: CorpusFile, version: str) -> Trip | None:
    """Write a file in the newest version, then in `version`, then in the newest again; None where it is refused."""
    if not twinform.check(file.path).accepted:
        return None
    name, around = file.name, (file.path.parent, *file.paths)
    try:
        newest = twinform.convert(file.path, to="sdf", sdf_version=NEWEST)
        older = twinform.convert(newest.text.encode(), to="sdf", sdf_version=version, name=name, paths=around)
        again = twinform.convert(older.text.encode(), to="sdf", sdf_version=NEWEST, name=name)
    except twinform.CompileError as error:
        return Trip(name, version, refused_by=rules_of(error.diagnostics))
    return Trip(
        name,
        version,
        difference=first_difference(_read(newest.text), _read(again.text)) or "",
        accounted=any(map(_is_lossy, (newest.ledger, older.ledger, again.ledger))),
        stale=any(found.rule.name == "stale-carrier" for found in again.diagnostics),
        unclean=_outside(older.text),
    )


def first_difference(one: Document, other: Document) -> str | None:
    """The first difference of two documents but for their namespaces; None where there is none."""
    found = next(changes(one.copy(namespaces=()), other.copy(namespaces=())), None)
    return line_of(found).strip() if found else None


def _read(text: str) -> Document:
    return comparable(twinform.loads(text))


def _is_lossy(ledger: Ledger) -> bool:
    return any(entry.fate is not Fate.CARRIED for entry in ledger.entries)


def _outside(text: str) -> str:
    found = twinform.check(text.encode()).diagnostics
    return next((each.message for each in found if each.rule.name == "outside-version"), "")
