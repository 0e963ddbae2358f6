"""Robots of other people with `<ros2_control>`: each joint that takes commands has one controller that it knows."""

from pathlib import Path

import yaml

import twinform
from testbed.corpus.files import Kind, corpus_files
from testbed.ros2.judges import yaml_problems
from twinform.compiler.input.loading import LoadOptions
from twinform.compiler.packaging.controllers import Controller, controllers_of
from twinform.compiler.packaging.gazebo_control import systems_of
from twinform.compiler.packaging.kinds import build
from twinform.compiler.packaging.order import Order, PackageDetails
from twinform.compiler.request import ConversionRequest
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Document

_LISTS = ("joints", "left_wheel_names", "right_wheel_names")


def test_each_commanded_joint_has_one_controller(corpus: Path):
    assert corpus.is_dir()
    checked = 0
    for file in corpus_files():
        content = file.path.read_bytes() if file.kind is Kind.URDF else b""
        if b"<ros2_control" in content and _check(content, file.name):
            checked += 1
    assert checked > 5


def _check(content: bytes, name: str) -> bool:
    """Whether there is a package, which is then in order."""
    order = Order(
        source=content,
        source_name=name,
        name="robot",
        folder="robot",
        conversion=ConversionRequest(to="urdf"),
        load_options=LoadOptions(),
        details=PackageDetails(description="A robot", maintainer="Ann", email="ann@example.org", license="MIT"),
        allow_missing=True,
    )
    try:
        files = build(order, ("ros2",)).package.files
    except twinform.CompileError:
        return False  # what is refused, and why, is the corpus report's business
    text = files["config/controllers.yaml"]
    assert isinstance(text, bytes)
    assert yaml_problems(text.decode()) == []
    read = yaml.safe_load(text)
    document = twinform.loads(content)
    sink = DiagnosticSink()
    controllers = controllers_of(document, sink)
    assert list(read["controller_manager"]["ros__parameters"])[1:] == [each.name for each in controllers]
    reported = {each.found for each in sink.diagnostics}
    led = [joint for each in controllers for joint in _led(each)]
    assert len(led) == len(set(led)), name
    assert set(led) | reported >= _commanded(document), name
    return True


def _led(controller: Controller) -> list[str]:
    found: list[str] = []
    for key in _LISTS:
        names = controller.parameters.get(key, ())
        assert isinstance(names, list | tuple)
        found += [str(each) for each in names]
    return found


def _commanded(document: Document) -> set[str]:
    systems = systems_of(document.models[0], document.format)
    return {joint.name for system in systems for joint in system.joints if joint.commands}
