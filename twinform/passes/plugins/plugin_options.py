"""Plugin parameters as pass options and back, and passes whose options depend on the value of one of them.

An option has the name of its parameter in kebab-case, after the names of the elements around it: `left_joint` is
`left-joint`, `<left_track><link>` is `left-track-link`, `linkName` is `link-name`.
"""

from abc import abstractmethod
from collections.abc import Iterator, Mapping
from functools import cache
from itertools import product
from typing import Annotated, Any, ClassVar, Literal, Self, cast

from lxml import etree
from pydantic import AfterValidator, BeforeValidator, Field, ValidationError
from pydantic.fields import FieldInfo
from pydantic_core import InitErrorDetails, PydanticCustomError

from twinform.ir import Element
from twinform.lazy import lazy_pattern
from twinform.passes.carriers.carriers import from_xml
from twinform.passes.framework.pass_base import Pass, option_name
from twinform.passes.plugins.catalog import UnknownNameError, suggestion
from twinform.passes.plugins.catalog_types import ParameterType, PluginKind, PluginParameter
from twinform.passes.plugins.parameters import problem_of
from twinform.schemas import format_value

_HUMP = lazy_pattern(r"(?<=[a-z0-9])(?=[A-Z])")
_CHOICE = lazy_pattern(r"\[([^\[\]]++)\]")
_TYPES: dict[ParameterType, Any] = {
    "number": float,
    "integer": int,
    "bool": bool,
    "vector": tuple[float, float, float],
    "numbers": tuple[float, ...],
    "pose": tuple[float, ...],
    "color": tuple[float, ...],
}
"""The Python types of options; all others are text."""
_LISTS = frozenset({"vector", "numbers", "pose", "color"})
"""Types of several numbers; a list of such values is a list of texts."""
Path = tuple[str, ...]
Fields = Mapping[str, tuple[Any, Any]]
"""Types and fields of options, by their names in kebab-case."""
P = Any
"""A class of passes; a type variable cannot express that a subclass is made of it."""


@cache
def options_of(kind: PluginKind) -> dict[str, tuple[Path, PluginParameter]]:
    """The options of a system, each with the path of its parameter.

    A parameter that may be an attribute or an element has one option, which writes the form that the table lists first.
    """
    found: dict[str, tuple[Path, PluginParameter]] = {}
    for path, row in _value_parameters((), kind.parameters):
        found.setdefault(_option_name(path), (path, row))
    return found


def _value_parameters(above: Path, rows: tuple[PluginParameter, ...]) -> Iterator[tuple[Path, PluginParameter]]:
    """The parameters that have values of their own; families of names are expanded."""
    for row in rows:
        for name in _expand_name(row.name):
            if row.type != "element" or row.free:
                yield (*above, name), row
            yield from _value_parameters((*above, name), row.children)


def _expand_name(name: str) -> Iterator[str]:
    """The names that a pattern such as `x[UV]` stands for."""
    parts = _CHOICE.split(name)
    choices = [part if index % 2 else (part,) for index, part in enumerate(parts)]
    return map("".join, product(*choices))


def _option_name(path: Path) -> str:
    return "-".join(_kebab_case(name) for name in path)


def _kebab_case(name: str) -> str:
    plain = name.lstrip("@").replace("_", "-")
    # The derivatives of hydrodynamics (`xUabsU`) and of airfoils (`CLa`) are names without capitals between words.
    return plain.lower() if plain[:1].isupper() or plain[1:2].isupper() else _HUMP.sub("-", plain).lower()


def field_of(path: Path, row: PluginParameter, kind: PluginKind) -> tuple[Any, FieldInfo]:
    """The type and the field of an option, for a Pydantic model."""
    many = _may_repeat(path, kind)
    one = str if many and row.type in _LISTS else _value_type(row)
    checked: Any = Annotated[one, AfterValidator(_value_checker(row))]
    kind_of: Any = Annotated[tuple[checked, ...], BeforeValidator(_as_list)] if many else checked
    unit = f", in {' or '.join(row.unit.split('|'))}" if row.unit else ""
    text = f"<{'><'.join(path)}>{unit}" + (f"; by default {row.default}" if row.default is not None else "")
    if row.is_required and len(path) == 1:
        return kind_of, Field(description=text)
    optional: Any = Field(default=None, description=text)  # typed as its default
    return _or_none(kind_of), optional


def _or_none(kind_of: Any) -> Any:
    return kind_of | None


def _may_repeat(path: Path, kind: PluginKind) -> bool:
    """Whether a parameter, or an element around it, may stand several times."""
    rows = [kind.parameter(*path[: end + 1]) for end in range(len(path))]
    return any(row is not None and row.is_many for row in rows)


def _value_type(row: PluginParameter) -> Any:
    if row.choices and row.type == "text":
        return Literal[row.choices]
    return _TYPES.get(row.type, str)


def _as_list(value: object) -> object:
    return [value] if isinstance(value, str | int | float) else value


def _value_checker(row: PluginParameter) -> Any:
    def check(value: object) -> object:
        problem = _xml_problem(str(value)) if row.type == "element" else problem_of(row, format_value(value))
        if problem:
            raise ValueError(f"has to be {problem}")
        return value

    return check


def _xml_problem(text: str) -> str | None:
    try:
        _parse_content(text)
    except (etree.XMLSyntaxError, ValueError):
        return "the XML that goes inside"
    return None


def _parse_content(text: str) -> tuple[Element, ...]:
    """The elements in an XML text; nothing outside of the text is read."""
    if "<!" in text:
        raise ValueError(text)
    parser = etree.XMLParser(resolve_entities=False, no_network=True, remove_comments=True, remove_pis=True)
    return from_xml(etree.fromstring(f"<content>{text}</content>", parser)).children


class MissingError(Exception):
    """A parameter is needed because of another one; the message names it."""


def content_of(kind: PluginKind, values: Mapping[str, object]) -> tuple[Element, ...]:
    """The content of a plugin for values of options.

    An element that may repeat stands as often as the longest list among its options; an option with one value has this
    value in all of them.

    Raises:
        MissingError: an element that is there lacks one that it needs.
    """
    options = options_of(kind)
    chosen = {options[name][0]: value for name, value in values.items() if value is not None}
    return tuple(_build_elements((), kind.parameters, chosen, None))


def _build_elements(
    above: Path, rows: tuple[PluginParameter, ...], chosen: Mapping[Path, object], turn: int | None
) -> Iterator[Element]:
    for row in rows:
        if row.is_attribute:
            continue
        for name in _expand_name(row.name):
            path = (*above, name)
            inside = {each: value for each, value in chosen.items() if each[: len(path)] == path}
            turns = _repetitions(inside, turn) if inside and row.is_many else [turn]
            for each in turns if inside else ():
                yield _build_element(path, row, inside, each)


def _repetitions(inside: Mapping[Path, object], turn: int | None) -> list[int | None]:
    """The indices into lists of values, one for each repetition of an element."""
    if turn is not None:
        return [turn]
    return list(range(max(map(_value_count, inside.values()))))


def _value_count(value: object) -> int:
    return len(cast("tuple[object, ...]", value)) if isinstance(value, tuple) else 1


def _build_element(path: Path, row: PluginParameter, chosen: Mapping[Path, object], turn: int | None) -> Element:
    attributes: list[tuple[str, str]] = []
    for each in row.children:
        value = _value_text(chosen.get((*path, each.name)), turn)
        if each.is_attribute and value is not None:
            attributes.append((each.name[1:], value))
        elif each.is_required and not any(key[: len(path) + 1] == (*path, each.name) for key in chosen):
            raise MissingError(_option_name((*path, each.name)))
    own = _value_text(chosen.get(path), turn)
    if row.type == "element" and row.free:
        return Element(name=path[-1], attributes=tuple(attributes), children=_parse_content(own or ""))
    children = tuple(_build_elements(path, row.children, chosen, turn))
    return Element(name=path[-1], attributes=tuple(attributes), text=own, children=children)


def _value_text(value: object, turn: int | None) -> str | None:
    """The text of a value; of a list with one value for each repetition, the one of this repetition."""
    if turn is not None and isinstance(value, tuple):
        values = cast("tuple[object, ...]", value)
        value = values[turn if turn < len(values) else -1]
    return None if value is None else format_value(value)


class SelectingPass(Pass):
    """A pass with one option, the `selector`, that decides which other options there are.

    Every instance is of a class that is made with the options of its selection, so that these are typed, validated and
    printed like the options of other passes.
    """

    selector: ClassVar[str]
    selected: ClassVar[bool] = False
    origin: ClassVar[Any] = None
    """The class that a class with the options of a selection was made from."""

    @classmethod
    @abstractmethod
    def fields_for(cls, word: str) -> Fields:
        """The additional options for a value of the selector.

        Raises:
            UnknownNameError: there is nothing of this name.
        """

    def __new__(cls, **options: object) -> Self:
        """An instance of the class with the options of the selection."""
        return super().__new__(_selected_class(cls, options))

    @classmethod
    def model_validate(cls, obj: Any, **how: Any) -> Self:
        """The pass with the options of the selection.

        Raises:
            ValidationError: there is no such thing, or it has no such option or value.
        """
        if not cls.selected and isinstance(obj, Mapping):
            made = _selected_class(cls, cast("Mapping[str, object]", obj))
            if made is not cls:
                return made.model_validate(obj, **how)
        return super().model_validate(obj, **how)

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle by the original class: a class that was made cannot be found by name."""
        return self.origin.model_validate, (self.model_dump(by_alias=True, exclude_defaults=True),)


def _selected_class(cls: P, options: Mapping[str, object]) -> P:
    word = options.get(cls.selector)
    if cls.selected or not isinstance(word, str):
        return cls
    try:
        made = _make_class(cls, word)
    except UnknownNameError as error:
        raise _option_error(cls.name, cls.selector, str(error), word) from error
    known = {option_name(key, field) for key, field in made.model_fields.items()}
    for option, value in options.items():
        if option.replace("_", "-") not in known:
            hint = suggestion(option, sorted(known), f"it has {', '.join(sorted(known))}")
            raise _option_error(cls.name, option, f"{word} has no such option; {hint}", value)
    return made


@cache
def _make_class(cls: P, word: str) -> P:
    """Make the class of a pass whose options include those that a word selects."""
    fields: dict[str, Any] = {option.replace("-", "_"): field for option, field in cls.fields_for(word).items()}
    annotations = {name: annotation for name, (annotation, _) in fields.items()}
    values = {name: value for name, (_, value) in fields.items()}
    about = {"__module__": cls.__module__, "__doc__": cls.__doc__, "selected": True, "origin": cls}
    return type(cls)(cls.__name__, (cls,), about | values | {"__annotations__": annotations})


def _option_error(title: str, option: str, message: str, value: object) -> ValidationError:
    complaint = PydanticCustomError("selected_option", "{message}", {"message": message})
    details = InitErrorDetails(type=complaint, loc=(option,), input=value)
    return ValidationError.from_exception_data(title, [details])
