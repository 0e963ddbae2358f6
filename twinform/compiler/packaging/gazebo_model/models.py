"""Builds the folder of one model: its SDF in each version that is asked for, its files and its model.config."""

from collections.abc import Iterator
from dataclasses import replace

from twinform.compiler.driver import Conversion
from twinform.compiler.packaging.collecting import Collection
from twinform.compiler.packaging.gazebo_model.model_config import FILE, model_config
from twinform.compiler.packaging.order import Built, Order
from twinform.compiler.packaging.package import Content, Package
from twinform.diagnostics import Diagnostic
from twinform.ir import Include, Model
from twinform.passes import Pipeline
from twinform.passes.legalise.to_urdf.select_model import SelectModel

NEWEST = "model.sdf"


def build(order: Order, collection: Collection) -> Built:
    """The folder of a model.

    Raises:
        CompileError: the model or a file of it has an error, or there are several models.
    """
    order = _of_one_model(order)
    collection.reserve(FILE)
    versions = order.sdf_versions or (None,)
    made = [order.convert(collection, "sdf", version) for version in versions]
    texts = dict(zip(_names(made), made, strict=True))
    files: dict[str, Content] = {name: conversion.text.encode() for name, conversion in texts.items()}
    of_versions = {_version(conversion): name for name, conversion in texts.items()}
    includes = [include.uri for model in made[0].document.models for include in _includes(model) if include.uri]
    files[FILE] = model_config(order.name, order.details, of_versions, includes)
    ledgers = {name: conversion.ledger for name, conversion in texts.items()}
    return Built(Package(order.folder, {**collection.files, **files}), _found(made), ledgers)


def _of_one_model(order: Order) -> Order:
    """The same order, which refuses files of several models where none is named."""
    if order.conversion.model is not None:
        return order
    passes = Pipeline((*order.conversion.passes, SelectModel.unchecked(model=None)))
    return replace(order, conversion=replace(order.conversion, passes=passes))


def _names(made: list[Conversion]) -> Iterator[str]:
    """The files: `model.sdf` for the newest version, `model-1_9.sdf` for an older one."""
    yield NEWEST
    for conversion in made[1:]:
        yield f"model-{_version(conversion).replace('.', '_')}.sdf"


def _version(conversion: Conversion) -> str:
    return conversion.document.version or ""


def _includes(model: Model) -> Iterator[Include]:
    yield from model.includes
    for nested in model.models:
        yield from _includes(nested)


def _found(made: list[Conversion]) -> tuple[Diagnostic, ...]:
    """What was found, once, whatever the versions."""
    return tuple(dict.fromkeys(each for conversion in made for each in conversion.diagnostics))
