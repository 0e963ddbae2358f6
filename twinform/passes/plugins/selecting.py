"""Passes whose options depend on the value of another option."""

from abc import abstractmethod
from collections.abc import Mapping
from functools import cache
from typing import Any, ClassVar, Self, cast

from pydantic import ValidationError, create_model
from pydantic_core import InitErrorDetails, PydanticCustomError

from twinform.passes.framework.pass_base import Pass
from twinform.passes.plugins.catalog import UnknownNameError, nearest

Fields = Mapping[str, tuple[Any, Any]]
"""Types and fields of options, by their names in kebab-case."""


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


P = Any
"""A class of passes; a type variable cannot express that a subclass is made of it."""


def _selected_class(cls: P, options: Mapping[str, object]) -> P:
    word = options.get(cls.selector)
    if cls.selected or not isinstance(word, str):
        return cls
    try:
        made = _make_class(cls, word)
    except UnknownNameError as error:
        raise _option_error(cls.name, cls.selector, str(error), word) from error
    known = {field.alias or key for key, field in made.model_fields.items()}
    for option, value in options.items():
        if option.replace("_", "-") not in known:
            near = nearest(option, sorted(known))
            hint = f"did you mean {near}?" if near else f"it has {', '.join(sorted(known))}"
            raise _option_error(cls.name, option, f"{word} has no such option; {hint}", value)
    return made


@cache
def _make_class(cls: P, word: str) -> P:
    """Make the class of a pass whose options include those that a word selects."""
    fields: dict[str, Any] = {option.replace("-", "_"): field for option, field in cls.fields_for(word).items()}
    made: P = create_model(cls.__name__, __base__=cls, __doc__=cls.__doc__, **fields)
    made.selected, made.origin = True, cls
    return made


def _option_error(title: str, option: str, message: str, value: object) -> ValidationError:
    complaint = PydanticCustomError("selected_option", "{message}", {"message": message})
    details = InitErrorDetails(type=complaint, loc=(option,), input=value)
    return ValidationError.from_exception_data(title, [details])
