"""Flags of commands, made of the options that the compiler declares, and gathered into one parameter."""

from collections.abc import Callable, Iterable, Mapping
from functools import wraps
from typing import Any, Literal, get_args, get_origin

import click
from click.shell_completion import CompletionItem

from twinform.cli.command import Decorated, Decorator, combine_options
from twinform.cli.config_defaults import hold_limit
from twinform.option import Option, declared_options


def group(parameter: str, make: Callable[..., object], *options: Decorator) -> Callable[[Decorated], Decorated]:
    """Give a command options, whose values `make` turns into one `parameter`."""

    def give(command: Decorated) -> Decorated:
        @wraps(command)
        def gathered(*arguments: Any, **typed: Any) -> object:
            typed[parameter] = make(**{name: typed.pop(name) for name in names})
            return command(*arguments, **typed)

        before = len(getattr(command, "__click_params__", ()))
        combine_options(*options)(gathered)
        parameters: list[click.Parameter] = getattr(gathered, "__click_params__", [])
        names = [each.name for each in parameters[before:] if each.expose_value]
        return gathered  # pyright: ignore[reportReturnType] - it takes what the command takes

    return give


def flags_of(options: type, *, without: Iterable[str] = (), **more: Mapping[str, Any]) -> tuple[Decorator, ...]:
    """Make the flags of a typed dictionary of options; a flag that is not given has the value None.

    `more` has additional settings for some of them that only the command line knows: types, callbacks, completion.
    """
    declared = declared_options(options).items()
    return tuple(
        flag(name, kind, option, **more.get(name, {})) for name, (kind, option) in declared if name not in without
    )


def flag(name: str, kind: Any, option: Option, **more: Any) -> Decorator:
    """Make the flag of one option of a type."""
    word = option.flag or f"--{name.replace('_', '-')}"
    kind = get_args(kind)[0] if type(None) in get_args(kind) else kind
    settings: dict[str, Any] = {"help": option.help, "metavar": option.metavar, "default": None}
    if kind is bool:
        settings |= {"is_flag": True}
        word = word if option.switch else f"{word}/--no-{word.removeprefix('--')}"
    elif get_origin(kind) is Literal:
        settings |= {"type": click.Choice(get_args(kind))}
    elif kind is int and option.parse is None:
        settings |= {"type": click.IntRange(min=1)}
    elif get_origin(kind) is Iterable:
        settings |= {"multiple": True}
    if option.parse or option.most:
        settings |= {"callback": _parser(option)}
    if option.known:
        settings |= {"shell_complete": _completion(option.known)}
    return click.option(word, name, **settings | more)


def _parser(option: Option) -> Callable[[click.Context, click.Parameter, Any], object]:
    def parse(ctx: click.Context, parameter: click.Parameter, value: Any) -> object:
        if value is None:
            return None
        try:
            value = option.parse(value) if option.parse else value
        except ValueError as error:
            raise click.BadParameter(str(error)) from error
        return value if option.most is None else hold_limit(ctx, parameter, value, option.most)

    return parse


def _completion(values: Callable[[], Iterable[str]]) -> Callable[..., list[CompletionItem]]:
    def complete(_ctx: click.Context, _parameter: click.Parameter, incomplete: str) -> list[CompletionItem]:
        return [CompletionItem(each) for each in values() if each.startswith(incomplete)]

    return complete
