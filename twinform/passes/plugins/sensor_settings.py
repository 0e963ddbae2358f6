"""Sensor settings: the options of `add-sensor`, and the elements that they set."""

import tomllib
from collections.abc import Iterator, Mapping
from functools import cache
from importlib import resources
from typing import Annotated, Any, Literal, get_args

from lxml import etree
from pydantic import Field

from twinform.dataclass import dataclass
from twinform.ir import Element
from twinform.passes.carriers.carriers import from_xml
from twinform.passes.plugins.catalog import sensor, sensors
from twinform.schemas import XmlElement, format_value, table

Noise = Literal["none", "typical"]

_TYPES: dict[str, Any] = {
    "integer": Annotated[int, Field(ge=1)],
    "number": Annotated[float, Field(allow_inf_nan=False)],
    "bool": bool,
    "text": str,
}
_STDDEV = Annotated[float | None, Field(ge=0, allow_inf_nan=False)]


@dataclass(frozen=True, slots=True)
class Setting:
    """A value below the element of a sensor; an empty value is not written."""

    path: str
    type: str
    default: object
    text: str


@dataclass(frozen=True, slots=True)
class NoiseSetting:
    """The standard deviation of Gaussian noise on some quantities, with its typical value."""

    paths: tuple[str, ...]
    typical: float
    text: str


@dataclass(frozen=True, slots=True)
class SensorSettings:
    """What `add-sensor` knows about a kind of sensor: its usual name and rate in Hz, and its options."""

    name: str
    rate: float
    values: Mapping[str, Setting]
    noises: Mapping[str, NoiseSetting]


@cache
def settings_of(type_: str) -> SensorSettings:
    """The settings of a kind of sensor, by any of its names; empty for a kind that cannot be added.

    Raises:
        UnknownNameError: gz-sim simulates none of this type.
    """
    kind = sensor(type_)
    row = _settings_table().get(kind.type, {})
    return SensorSettings(
        name=row.get("name", kind.type),
        rate=row.get("rate", 0),
        values={option: Setting(*each) for option, each in row.get("settings", {}).items()},
        noises={option: NoiseSetting(tuple(each[0]), *each[1:]) for option, each in row.get("noise", {}).items()},
    )


def addable() -> tuple[str, ...]:
    """The kinds of sensors that can be added."""
    return tuple(type_ for type_ in sensors() if type_ in _settings_table())


@cache
def _settings_table() -> dict[str, Any]:
    file = resources.files("twinform.passes.plugins").joinpath("data", "sensor_settings.toml")
    return tomllib.loads(file.read_text(encoding="utf-8"))


def setting_fields(type_: str) -> Iterator[tuple[str, tuple[Any, Any]]]:
    """The options of a kind of sensor with their types and fields, for a Pydantic model."""
    settings = settings_of(type_)
    for option, each in settings.values.items():
        yield option, (_TYPES[each.type], Field(default=each.default, description=each.text))
    if settings.noises:
        text = "`typical` is what such a device usually has; one that is given counts."
        yield "noise", (Noise, Field(default=get_args(Noise)[0], description=text))
    for option, noise in settings.noises.items():
        text = f"{noise.text} Typical is {noise.typical:g}."
        optional: Any = Field(default=None, description=text)  # typed as its default
        yield option, (_STDDEV, optional)


def settings_element(type_: str, values: Mapping[str, object]) -> Element | None:
    """The element with the parameters of a sensor; None if it would be empty."""
    kind, settings = sensor(type_), settings_of(type_)
    root = etree.Element(kind.element)
    for option, setting in settings.values.items():
        value = values.get(option, setting.default)
        if value != "":
            _find_or_make(root, setting.path).text = format_value(value)
    for option, noise in settings.noises.items():
        stddev = values.get(option)
        if stddev is None and values.get("noise") == "typical":
            stddev = noise.typical
        if stddev is not None:
            for path in noise.paths:
                _write_noise(root, path, stddev, as_element=_has_one_noise(kind.element))
    return from_xml(root) if len(root) else None


def _has_one_noise(element: str) -> bool:
    """Whether the element of a sensor has a single `<noise>` with a type element, and not one for each quantity."""
    facts = table("sdf")
    rows = [row for row in facts.definitions["sensor"].children if row.name == element]
    return any(
        inner.name == "noise" and inner.exists_in(facts.newest) for row in rows for inner in facts.resolve(row).rows
    )


def _write_noise(root: XmlElement, path: str, stddev: object, *, as_element: bool) -> None:
    """Write Gaussian noise without bias; `path` is that of the quantity, or of the noise itself."""
    noise = _find_or_make(root, path if as_element else f"{path}/noise")
    if as_element:
        etree.SubElement(noise, "type").text = "gaussian"
    else:
        noise.set("type", "gaussian")
    etree.SubElement(noise, "mean").text = "0"
    etree.SubElement(noise, "stddev").text = format_value(stddev)


def _find_or_make(element: XmlElement, path: str) -> XmlElement:
    for step in path.split("/"):
        found = element.find(step)
        element = found if found is not None else etree.SubElement(element, step)
    return element
