"""The kinds of packages, their names, and the functions that build them."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import replace
from typing import Literal, get_args

from twinform.compiler.packaging.collecting import Collection
from twinform.compiler.packaging.gazebo_models import build as build_gazebo_model
from twinform.compiler.packaging.mujoco_models import build as build_mujoco
from twinform.compiler.packaging.order import Built, Order
from twinform.compiler.packaging.package import Content, Package
from twinform.compiler.packaging.ros2_packages import build as build_ros2
from twinform.diagnostics import Diagnostic, DiagnosticSink
from twinform.diagnostics.rules import PLACEHOLDER

Builder = Callable[[Order, Collection], Built]
"""Builds a package from an order; the files of the model go into the collection, which several builders may share."""

KINDS: Mapping[str, Builder] = {"gazebo-model": build_gazebo_model, "ros2": build_ros2, "mujoco": build_mujoco}


def build(order: Order, kinds: tuple[str, ...]) -> Built:
    """Build one folder that is a package of each of these kinds; meshes and textures are in it once.

    Raises:
        CompileError: the model or a file of it has an error.
        ValueError: two kinds have different contents for one file.
    """
    said = replace(order, details=order.details.with_placeholders())
    built = list(_build_each(said, kinds))
    files: dict[str, Content] = {}
    for each in built:
        for path, content in each.package.files.items():
            if files.setdefault(path, content) != content:
                raise ValueError(f"two kinds of packages have different contents for {path}")
    found = dict.fromkeys(found for each in built for found in each.diagnostics)
    ledgers = {path: ledger for each in built for path, ledger in each.ledgers.items()}
    return Built(Package(order.name, files), (*found, *_report_missing_details(order, kinds)), ledgers)


def _build_each(order: Order, kinds: Iterable[str]) -> Iterator[Built]:
    """Yield a package of each kind; each builder knows the files of the packages before."""
    collection = order.collection()
    beside: tuple[str, ...] = ()
    for kind in kinds:
        made = KINDS[kind](replace(order, beside=beside), collection)
        beside = (*beside, *made.package.files)
        yield made


def _report_missing_details(order: Order, kinds: Iterable[str]) -> tuple[Diagnostic, ...]:
    """Warn about required details of the package that are missing."""
    missing = [name for name in order.details.missing if any(name in REQUIRED[kind] for kind in kinds)]
    if not missing:
        return ()
    sink = DiagnosticSink(order.source_name)
    message = f"the package says TODO for {', '.join(missing)}"
    sink.report(PLACEHOLDER, message, help=f"give {' '.join(f'--{name} ...' for name in missing)}")
    return tuple(sink.diagnostics)


KindName = Literal["gazebo-model", "ros2", "mujoco"]
KIND_NAMES = (*get_args(KindName), "both")
"""The kinds of packages that can be requested."""
_BOTH: tuple[KindName, ...] = ("gazebo-model", "ros2")
"""The kinds that can be one folder."""

REQUIRED: Mapping[str, tuple[str, ...]] = {
    "gazebo-model": ("description", "maintainer", "email"),
    "ros2": ("description", "maintainer", "email", "license"),
    "mujoco": (),
}
"""The details that a package of each kind needs."""


def kinds_of(asked: str) -> tuple[str, ...]:
    """Return the kinds of packages that a request means."""
    return _BOTH if asked == "both" else (asked,)
