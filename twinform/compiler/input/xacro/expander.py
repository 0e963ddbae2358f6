"""xacro, with every function replaced by which it reads files, evaluates expressions, or leaves its own process.

In a text, `${...}` is an expression, and `$(command words)` an argument, package, variable or `eval`.
"""

import os
import re
import sys
from collections.abc import Callable, Generator, Mapping
from contextlib import contextmanager
from functools import partial
from importlib import import_module
from posixpath import normpath
from types import ModuleType, SimpleNamespace
from typing import TYPE_CHECKING, Any
from xml.dom import minidom

from twinform.compiler.input.xacro.budget import Budget, require_length
from twinform.compiler.input.xacro.channel import AbsentError, Compiler, MissingFileError, NotFoundError, TooMuchError
from twinform.compiler.input.xacro.expression_values import DotDict, ExpressionRefusedError, NameLookup, Value, text_of
from twinform.compiler.input.xacro.interpreter import Interpreter
from twinform.compiler.input.xacro.places import Definitions, FileLine, parse, place_of
from twinform.compiler.input.xacro.vocabulary import eval_vocabulary, vocabulary
from twinform.lazy import lazy_pattern

if TYPE_CHECKING:
    from twinform.compiler.input.xacro.data_files import DataFiles


# Functions of xacro whose first argument is the element that they work on: from them errors get
# their place.
_WATCHED = ("eval_all", "check_attrs", "grab_property", "grab_macro", "process_include", "handle_macro_call")
# Taken away from xacro's modules, so that a use of them that is not replaced fails instead of
# running.
_BARRED = ("compile", "eval", "exec", "open")
_PACKAGE = "package://"
_LEFT_OUT = ("xacro.cli", "yaml")
"""What xacro imports and is not used here: its command line, and what takes as long as all else that is imported."""


class Expander:
    """Expands one file, and is what the functions of its expressions know of it.

    The YAML library takes longer to import than all else. Without `yaml`, a file that reads data makes
    `lacks_yaml` true, and its expansion fails. `absent` are the packages that are nowhere, with the
    place that asks for them and advice; `parsed` are the xacro files that were read.
    """

    def __init__(self, compiler: Compiler, file: str, *, yaml: bool = True) -> None:
        with _stand_ins(*_LEFT_OUT):
            self.xacro: Any = import_module("xacro")
            self.module: Any = import_module("xacro.substitution_args")
        self.compiler = compiler
        self.file = file
        self.parsed: set[str] = set()
        self.node: Any = None
        self.definitions = Definitions(lambda: self.xacro.filestack or ())
        self.budget = Budget()
        self.interpreter = Interpreter(self.budget, self.xacro.NameSpace)
        self.substitutions = Substitutions(
            self.module, self.interpreter, self._package, compiler.environment, self.xacro.warning
        )
        self.texts = TextEvaluator(self.interpreter.evaluate, self._substitute, self.xacro.XacroException, self.budget)
        theirs: Mapping[str, Any] = getattr(self.xacro, "_global_symbols", {})
        self.names = vocabulary(theirs, self._functions(), self.budget, self.xacro.warning)
        self.data_files = self._data_files() if yaml else None
        self.lacks_yaml = False
        self.absent: dict[str, tuple[str, int, str]] = {}
        self.beside: Callable[[str], str] = self.xacro.abs_filename_spec
        self.print_location: Callable[[], None] = self.xacro.print_location
        self._replace()

    def expand(self, arguments: dict[str, str]) -> minidom.Document:
        """The tree that the file expands to."""
        return self.xacro.process_file(self.file, mappings=arguments, verbosity=0)

    def place(self) -> FileLine:
        """Where the element was written that was looked at last."""
        return place_of(self.node) or (self.file, 1)

    def argument(self, name: str) -> str:
        """An argument of the file, as text."""
        arguments: Mapping[str, str] = self.xacro.substitution_args_context["arg"]
        if name not in arguments:
            raise self.module.ArgException(name)
        return arguments[name]

    def path(self, name: str) -> str:
        """What a file name means in the file that is being read."""
        if not name.startswith(_PACKAGE):
            return self.beside(name)
        try:
            return self._find(name)
        except AbsentError as error:
            package = name.removeprefix(_PACKAGE).partition("/")[0]
            self._package(package)
            if package in self.absent:
                raise
            raise NotFoundError(str(error), error.advice) from error

    def data(self, name: str) -> Value:
        """The content of a data file."""
        path = self.path(name)
        if self.data_files is None:
            self.lacks_yaml = True
            raise ExpressionRefusedError("this process cannot read data files")
        return self.data_files.load(self.compiler.read(path)[1], path)

    def _functions(self) -> dict[str, Callable[..., Value]]:
        """Every function that xacro documents; what they are given has been weighed."""
        return {
            "abs_filename": self.path,
            "arg": self.argument,
            "dotify": DotDict,
            "error": partial(self._say, "error: "),
            "fatal": self._fatal,
            "load_yaml": self.data,
            "message": partial(self._say, ""),
            "print_location": self._locate,
            "tokenize": _tokenize,
            "warning": partial(self._say, "warning: "),
        }

    def _say(self, start: str, /, *args: Value, alt_text: str | None = None, **_: Value) -> str:
        """Have something reported: what is printed is noted with its place."""
        print(f"{start if alt_text is None else alt_text}{self._joined(args)}", file=sys.stderr)  # noqa: T201 - see above
        return ""

    def _fatal(self, *args: Value) -> Value:
        raise self.xacro.XacroException(self._joined(args))

    def _joined(self, args: tuple[Value, ...]) -> str:
        return self.budget.write(" ".join(text_of(each, self.budget) for each in args))

    def _locate(self) -> str:
        """Have it reported which macros and files are being expanded."""
        self.print_location()
        return ""

    def _data_files(self) -> "DataFiles":
        from twinform.compiler.input.xacro.data_files import DataFiles  # noqa: PLC0415 - see above

        units = {unit.value.tag: unit.value.conversion_constant for unit in self.xacro.ConstructUnits}
        return DataFiles(units, lambda expression: self.interpreter.evaluate(expression, self.names))

    def _replace(self) -> None:
        _replace(
            self.xacro,
            {
                "_global_symbols": self.names,
                "abs_filename_spec": self.path,
                "eval_extension": self._substitute,
                "eval_text": self.texts.value,
                "glob": SimpleNamespace(glob=self.compiler.match),
                "load_yaml": self.data,
                "parse": self._parse,
                "print_location": lambda: None,  # every remark has its place already
                "root_dir": _working_folder(),
                # xacro hands expressions to Python's `eval` behind a list of forbidden names, which
                # `python.vars(python.type(f))['__get__']` left.
                "safe_eval": self.interpreter.evaluate,
                **{name: self._watched(name, getattr(self.xacro, name, None)) for name in _WATCHED},
            },
        )
        _replace(self.module, self.substitutions.replacements())
        for module in (self.xacro, self.module):
            for name in _BARRED:
                setattr(module, name, _refuse)

    def _watched(self, name: str, function: Any) -> Callable[..., Any]:
        def call(node: Any, *rest: Any) -> Any:
            self.node = node
            self.budget.spend()
            self.definitions.note(name, node)
            # An exception leaves the calls that it came through.
            is_call = name == "handle_macro_call" and self.definitions.begin_call(node)
            result = function(node, *rest)
            if is_call:
                self.definitions.calls.pop()
            return result

        return call

    def _substitute(self, text: str) -> str:
        if text == "$(cwd)":
            return self.xacro.root_dir
        try:
            return self.module.resolve_args(text, context=self.xacro.substitution_args_context)
        except self.module.ArgException as error:
            raise self.xacro.XacroException("Undefined substitution argument", exc=error) from error
        except Exception as error:
            raise self.xacro.XacroException(exc=error, suffix=f"when evaluating '{text}'") from error

    def _package(self, name: str) -> str:
        """Where a package is; its address where it is nowhere, which will do for all but the files in it."""
        try:
            return self._find(f"{_PACKAGE}{name}")
        except AbsentError as error:
            self.absent.setdefault(name, (*self.place(), error.advice))
            return f"{_PACKAGE}{name}"

    def _find(self, uri: str) -> str:
        return self.compiler.find(uri, (self.xacro.filestack or [None])[-1] or self.file)

    def _parse(self, _: object, filename: str) -> minidom.Document:
        """What xacro's own function does, with lines."""
        filename = self._known_name(filename)
        self.parsed.add(filename)
        try:
            name, content = self.compiler.read(filename)
        except MissingFileError as error:
            self.xacro.filestack.pop()
            raise self.xacro.XacroException(exc=error) from error
        self.xacro.filestack[-1] = name
        return parse(content, name)

    def _known_name(self, filename: str) -> str:
        """The name by which a file is open that is included again, so that names in a circle do not grow."""
        stack: list[str] = self.xacro.filestack
        here = normpath(filename)
        known = next((each for each in stack[:-1] if normpath(each) == here), filename)
        stack[-1:] = [known]
        return known


@contextmanager
def _stand_ins(*modules: str) -> Generator[None]:
    """Let modules be imported by their names alone, unless they are there; whatever is called of them is refused."""
    made = {name: _StandIn(name) for name in modules if name not in sys.modules}
    sys.modules.update(made)
    try:
        yield
    finally:
        for name in made:
            del sys.modules[name]


class _StandIn(ModuleType):
    def __getattr__(self, name: str) -> Callable[..., Any]:
        return _refuse


def _replace(module: ModuleType, replacements: Mapping[str, Any]) -> None:
    for name, value in replacements.items():
        # A newer xacro that renames a function would otherwise run its own version of it,
        # unconfined.
        if not hasattr(module, name):
            raise ImportError(f"this version of xacro is not known: {module.__name__} has no {name}")
        setattr(module, name, value)


def _refuse(*_: object, **__: object) -> Any:
    raise ExpressionRefusedError("xacro must not evaluate or open anything by itself")


def _working_folder() -> str:
    try:
        return os.getcwd()
    except OSError:  # it was deleted
        return "."


def _tokenize(text: str, sep: str = ",; ", skip_empty: bool = True) -> list[str]:
    if "]" in sep:
        raise ExpressionRefusedError("the separators of 'tokenize' must not have ']' among them")
    found = re.split(f"[{sep}]", text)
    return [each for each in found if each] if skip_empty else found


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
        if name not in arguments:
            raise self.module.ArgException(name)
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
