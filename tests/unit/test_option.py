"""Options are declared once: Python's keywords, the command line and the configuration have the same ones."""

from collections.abc import Callable
from dataclasses import fields
from functools import partial
from typing import Any

import pytest

import twinform
from twinform.cli.batch_commands import commands
from twinform.cli.config_settings import ProjectSettings
from twinform.cli.convert import command
from twinform.compiler import plan
from twinform.compiler.input.load_options import FileOptions, ReadingOptions
from twinform.compiler.request import ConversionRequest
from twinform.ir import Format
from twinform.option import declared_options
from twinform.request_options import Requested, RequestOptions

_ROBOT = b'<robot name="a"><link name="a"/></robot>'
_DECLARED = {**declared_options(ReadingOptions), **declared_options(RequestOptions)}


_CALLS: list[Callable[..., object]] = [
    partial(twinform.check, _ROBOT),
    partial(twinform.convert, _ROBOT, to="sdf"),
    partial(twinform.diff, _ROBOT, _ROBOT),
    partial(twinform.loads, _ROBOT),
    partial(twinform.load, "a.urdf"),
    partial(plan, twinform.loads(_ROBOT), to="sdf"),
]


@pytest.mark.parametrize("call", _CALLS)
def test_a_keyword_that_is_no_option_is_refused(call: Callable[..., object]) -> None:
    with pytest.raises(TypeError, match="there is no option 'sdf_verson'"):
        call(sdf_verson="1.9")


def test_a_misspelt_option_is_told_what_was_meant() -> None:
    options: Any = {"sdf_verson": "1.9"}
    with pytest.raises(TypeError, match=r"'sdf_verson'; did you mean 'sdf_version'\?"):
        twinform.convert(_ROBOT, to="sdf", **options)


_VALUES: list[tuple[Callable[..., object], dict[str, Any], str]] = [
    (partial(twinform.convert, _ROBOT), {"to": "usd"}, "to is 'usd'; expected 'sdf', 'urdf', 'mjcf' or 'json'"),
    (partial(plan, twinform.loads(_ROBOT)), {"to": "usd"}, "to is 'usd'; expected 'sdf', 'urdf', 'mjcf' or 'json'"),
    (partial(twinform.dumps, twinform.loads(_ROBOT)), {"to": "usd"}, "expected 'urdf', 'sdf', 'mjcf' or 'json'"),
    (partial(twinform.convert, _ROBOT, to="sdf"), {"urdf_version": "3"}, "urdf_version is '3'; expected '1.0'"),
    (partial(twinform.convert, _ROBOT, to="sdf"), {"sdf_version": "3"}, "SDF has no version '3'; it has 1.2"),
    (partial(twinform.check, _ROBOT), {"engine": "expat"}, "engine is 'expat'; expected 'libxml2' or 'xmlschema'"),
]


@pytest.mark.parametrize(("call", "options", "why"), _VALUES)
def test_a_value_that_an_option_does_not_have_is_refused_with_those_it_has(
    call: Callable[..., object], options: dict[str, Any], why: str
) -> None:
    with pytest.raises(ValueError, match=why):
        call(**options)


def test_an_option_that_is_none_is_not_given() -> None:
    usual = twinform.convert(_ROBOT, to="sdf").text
    names: Any = dict.fromkeys((*FileOptions.__annotations__, *RequestOptions.__annotations__))
    assert twinform.convert(_ROBOT, to="sdf", **names).text == usual


@pytest.mark.parametrize("name", _DECLARED)
def test_the_command_line_and_the_configuration_have_what_is_declared(name: str) -> None:
    _, option = _DECLARED[name]
    flags = {each.name: each for each in command.params}
    assert flags[name].opts == [option.flag or f"--{name.replace('_', '-')}"]
    assert name in ProjectSettings.model_fields or not option.setting


@pytest.mark.parametrize("name", sorted(declared_options(RequestOptions).keys() - {"keep_paths"}))
def test_a_batch_has_the_options_of_a_conversion(name: str) -> None:
    """All but one: its results are a copy of their folder, so paths stay as they are anyway."""
    assert name in {each.name for each in commands.commands["convert"].params}


def test_what_is_asked_for_reaches_legalisation() -> None:
    """The folder of meshes is chosen by packages and is no option."""
    usual = {each.name: each.default for each in fields(Requested) if each.name != "mesh_folder"}
    texts = {"sdf_version": "1.9", "urdf_version": "1.1", "model": "a"}
    asked: Any = {name: texts.get(name, not value) for name, value in usual.items()}
    assert set(asked) == set(RequestOptions.__annotations__) - {"passes"}
    request = ConversionRequest.of("sdf", asked)
    assert {name: getattr(request, name) for name in asked} == asked
    assert request.target(twinform.loads(_ROBOT), Format.SDF).requested == request.requested == Requested(**asked)
