"""Texts of xacro: `${...}` is an expression, `$(command words)` an argument, package, variable or `eval`."""

import os
import re
from collections.abc import Callable, Mapping
from functools import partial
from types import ModuleType
from typing import Any

from twinform.compiler.input.xacro.budget import Budget, require_length
from twinform.compiler.input.xacro.channel import NotFoundError, TooMuchError
from twinform.compiler.input.xacro.expression_values import NameLookup, Value, text_of
from twinform.compiler.input.xacro.interpreter import Interpreter
from twinform.compiler.input.xacro.vocabulary import eval_vocabulary
from twinform.lazy import lazy_pattern

# The four tokens of xacro's own lexer (`QuickLexer` in xacro/__init__.py), in its order.
_PART = lazy_pattern(
    r"\$(?P<escaped>\$+[{(])|\$\{(?P<expression>[^}]*)\}|\$\((?P<substitution>[^)]*)\)|(?P<plain>[^$]+|\$[^{($]+|\$$)"
)


class TextEvaluator:
    """Evaluates texts; `failure` makes the exception of xacro that names the expression at fault."""

    def __init__(
        self,
        evaluate: Callable[[str, NameLookup], Value],
        substitute: Callable[[str], str],
        failure: Callable[..., Exception],
        budget: Budget,
    ) -> None:
        self.evaluate = evaluate
        self.substitute = substitute
        self.failure = failure
        self.budget = budget

    def value(self, text: str, symbols: NameLookup) -> Value:
        """The value of a text: of whatever type it is if the text is a single expression, and else a text."""
        if "$" not in text:
            return text
        parts = list(self._parts(text, symbols))
        if len(parts) == 1:
            return parts[0]
        words = [text_of(part, self.budget) for part in parts]
        require_length(sum(map(len, words)))
        return self.budget.write("".join(words))

    def _parts(self, text: str, names: NameLookup) -> list[Value]:
        found: list[Value] = []
        position = 0
        while position < len(text):
            match = _PART.match(text, position)
            if match is None:
                raise self.failure(f"invalid expression: {text[position:]}")
            found.append(self._part(match, names))
            position = match.end()
        return found

    def _part(self, match: re.Match[str], names: NameLookup) -> Value:
        self.budget.spend()
        match match.lastgroup:
            case "expression":
                return self._expression(match[match.lastgroup], names)
            case "substitution":
                return self.budget.write(self.substitute(f"$({self._text(match[match.lastgroup], names)})"))
            case _:
                return match["escaped"] or match["plain"]

    def _expression(self, text: str, names: NameLookup) -> Value:
        try:
            value = self.evaluate(self._text(text, names), names)
            return self.budget.write(value) if isinstance(value, str) else value
        except Exception as error:
            raise self.failure(exc=error, suffix=f"{os.linesep}when evaluating expression '{text}'") from error

    def _text(self, text: str, names: NameLookup) -> str:
        return text_of(self.value(text, names), self.budget)


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
