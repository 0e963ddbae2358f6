"""Texts of xacro: what is between `${` and `}` is an expression, and what is between `$(` and `)` a substitution."""

import os
import re
from collections.abc import Callable

from twinform.compiler.input.xacro.worker.expressions.budget import Budget, require_length
from twinform.compiler.input.xacro.worker.expressions.expression_values import NameLookup, Value, text_of

# The four tokens of xacro's own lexer (`QuickLexer` in xacro/__init__.py), in its order.
_PART = re.compile(
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

    def value(self, text: str, names: NameLookup) -> Value:
        """The value of a text: of whatever type it is if the text is a single expression, and else a text."""
        if "$" not in text:
            return text
        parts = list(self._parts(text, names))
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
