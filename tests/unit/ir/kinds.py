"""All classes of parts of a document."""

import importlib
import pkgutil
from collections.abc import Iterator

import twinform.ir
from twinform.ir.record import Sourced

for _each in pkgutil.iter_modules(twinform.ir.__path__, "twinform.ir."):
    importlib.import_module(_each.name)


def kinds(kind: type[Sourced] = Sourced) -> Iterator[type[Sourced]]:
    """A class and those that are derived from it, without those of tests and those that `record` leaves behind."""
    yield kind
    for each in kind.__subclasses__():
        if each.__module__.startswith("twinform.ir.") and "__signature__" in vars(each):
            yield from kinds(each)
