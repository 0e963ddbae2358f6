"""Builds the package of a model: its SDF in each version that is asked for, its files and its model.config."""

from dataclasses import replace

from twinform.compiler.packaging.collecting import Collection
from twinform.compiler.packaging.gazebo_model.folder import folder_files, reserve_names, sdf_names
from twinform.compiler.packaging.gazebo_model.package_world import build as build_world
from twinform.compiler.packaging.gazebo_model.package_world import is_world
from twinform.compiler.packaging.order import Built, Order
from twinform.compiler.packaging.package import Package
from twinform.diagnostics import DiagnosticSink
from twinform.passes import Pipeline
from twinform.passes.legalise.to_urdf.select_model import SelectModel


def build(order: Order, collection: Collection) -> Built:
    """The folder of a model, or those of the models of a world.

    Raises:
        CompileError: the model or a file of it has an error, or there are several models.
    """
    if is_world(order):
        return build_world(order)
    order = _of_one_model(order)
    reserve_names(collection)
    made = [order.convert(collection, "sdf", version) for version in order.sdf_versions or (None,)]
    by_version = {conversion.document.version or "": conversion for conversion in made}
    texts = {version: conversion.text for version, conversion in by_version.items()}
    sink = DiagnosticSink(order.source_name)
    files = folder_files(order.name, order, texts, made[0].document, collection, sink)
    found = dict.fromkeys(each for conversion in made for each in conversion.diagnostics)
    ledgers = {file: by_version[version].ledger for version, file in sdf_names(iter(texts)).items()}
    return Built(Package(order.folder, files), (*found, *sink.diagnostics), ledgers)


def _of_one_model(order: Order) -> Order:
    """Return the order with a pass that refuses a file of several models if none is named."""
    if order.conversion.model is not None:
        return order
    passes = Pipeline((*order.conversion.passes, SelectModel.unchecked(model=None)))
    return replace(order, conversion=replace(order.conversion, passes=passes))
