"""Substitutions, `$(command words)`: arguments, packages, environment variables, and expressions behind `eval`."""

from collections.abc import Callable, Mapping
from functools import partial
from types import ModuleType
from typing import Any

from twinform.compiler.input.xacro.worker.channel import NotFoundError, TooMuchError
from twinform.compiler.input.xacro.worker.expressions.expression_values import Value, text_of
from twinform.compiler.input.xacro.worker.expressions.interpreter import Interpreter
from twinform.compiler.input.xacro.worker.vocabulary import eval_vocabulary


class Substitutions:
    """xacro's substitutions with what they ask for answered here: the functions are named as xacro has them."""

    def __init__(
        self,
        module: ModuleType,
        interpreter: Interpreter,
        package: Callable[[str], str],
        environment: Callable[[str], str | None],
        warn: Callable[[str], None],
    ) -> None:
        self.module: Any = module
        self.interpreter = interpreter
        self.package = package
        self.environment = environment
        self.warn = warn

    def replacements(self) -> dict[str, Callable[..., str]]:
        """What takes the place of the module's own functions."""
        return {
            "_eval": self._eval,
            "_eval_env": self._environment,
            "_eval_find": self.package,
            "_eval_optenv": self._environment_or,
        }

    def _environment(self, name: str) -> str:
        value = self.environment(name)
        if value is None:
            raise self.module.SubstitutionException(f"environment variable {name!r} is not set")
        return value

    def _environment_or(self, name: str, default: str = "") -> str:
        try:
            value = self.environment(name)
        except TooMuchError:
            raise
        except NotFoundError as error:
            self.warn(f"{error}: {default!r} is taken; {error.advice}")
            return default
        return default if value is None else value

    def _eval(self, expression: str, context: Mapping[str, Any]) -> str:
        arguments: Mapping[str, str] = context["arg"]
        own: dict[str, Callable[..., Value]] = {
            "arg": partial(self._converted, arguments),
            "env": self._environment,
            "find": self.package,
            "optenv": self._environment_or,
        }
        budget = self.interpreter.budget
        theirs: Mapping[str, Any] = getattr(self.module, "_eval_dict", {})
        names = _SubstitutionNames(eval_vocabulary(theirs, own, budget), arguments, self._converted)
        return text_of(self.interpreter.evaluate(expression, names), budget)

    def _converted(self, arguments: Mapping[str, str], name: str) -> Value:
        """An argument as a number or a truth value where its text is one."""
        return self.module.convert_value(arguments[name], "auto")


class _SubstitutionNames:
    """The names in `$(eval ...)`: what is offered, then the arguments of the file."""

    def __init__(
        self,
        offered: Mapping[str, Value],
        arguments: Mapping[str, str],
        convert: Callable[[Mapping[str, str], str], Value],
    ) -> None:
        self.offered = offered
        self.arguments = arguments
        self.convert = convert

    def __getitem__(self, name: str) -> Value:
        return self.offered[name] if name in self.offered else self.convert(self.arguments, name)
