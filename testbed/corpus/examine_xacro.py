"""All that is claimed about one real xacro file, tried on it."""

import time
from dataclasses import dataclass, replace
from pathlib import Path

import twinform
from testbed.corpus.examine import fault, rules_of, without_line
from twinform.compiler.companions.check_companion import may_be_companion
from twinform.ir import Document, Format


@dataclass(frozen=True, slots=True)
class Expanded:
    """What the compiler makes of a xacro file, with no arguments and no packages but those around it."""

    name: str
    expanded: bool = False
    accepted: bool = False
    converted: bool = False
    refused_by: tuple[str, ...] = ()
    not_converted_by: tuple[str, ...] = ()
    faults: tuple[str, ...] = ()
    seconds: float = 0.0


def examine_xacro(path: Path, name: str) -> Expanded:
    """Check a file and convert it to the other format; no exception comes out of it."""
    start = time.perf_counter()
    found = Expanded(name)
    try:
        checked = twinform.check(path)
        found = replace(
            found, expanded=bool(checked.origins), accepted=checked.document is not None and checked.accepted
        )
        if may_be_companion(path) and not any(each.is_error for each in checked.diagnostics):
            pass  # it is about a robot, and none itself
        elif checked.document is None or not checked.accepted:
            found = replace(found, refused_by=rules_of(checked.diagnostics), faults=without_line(checked.diagnostics))
        else:
            found = _converted(path, checked.document, found)
    except Exception as error:  # noqa: BLE001 - every exception is a fault to report
        found = replace(found, faults=(fault(error),))
    return replace(found, seconds=time.perf_counter() - start)


def _converted(path: Path, document: Document, found: Expanded) -> Expanded:
    try:
        twinform.convert(path, to="sdf" if document.format is Format.URDF else "urdf")
    except twinform.CompileError as error:
        faults = (*found.faults, *without_line(error.diagnostics))
        return replace(found, not_converted_by=rules_of(error.diagnostics), faults=faults)
    return replace(found, converted=True)
