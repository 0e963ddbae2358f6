"""Writes options where they are read: on a page, and into the docstrings of the functions that take them as keywords.

There they stand under `Keyword Args:`, where `help`, notebooks and editors show them. An editor reads the docstring in
the source and runs nothing, so it has to stand there.
"""

import textwrap
from collections.abc import Callable, Iterable, Mapping

from twinform.compiler.compare.compare_files import diff
from twinform.compiler.descriptions import load_description
from twinform.compiler.driver import ConversionOptions, convert
from twinform.compiler.input.load_options import AnyCheckOptions, FileOptions, ReadingOptions
from twinform.compiler.input.loading import load, loads
from twinform.compiler.inspection import check
from twinform.option import Option, declared_options
from twinform.package_files import package_files
from twinform.request_options import RequestOptions

_INTRODUCTION = """\
# Options

What the functions of Python take as keywords, and the command line as flags: `load`, `loads`, `check`, `diff` and
`convert` those of files, `convert` and `plan` those of conversions. A setting may stand in `twinform.toml`, with `-`
for `_`.

| keyword | of | flag | setting | what it does |
| --- | --- | --- | --- | --- |
"""
_OTHERS = {
    "arguments": Option(help="The arguments of xacro files, by their names.", flag="NAME:=VALUE"),
    "allow": Option(help="The rules whose findings are left out.", setting=True),
    "profiles": Option(help="The consumers of the model, or their names with commas between.", flag="--for"),
    "robot": Option(help="The robot that SRDF, and parameters which name joints and links, are for."),
    "model": Option(help="The model that is meant, where a file has several."),
    "side_files": Option(
        help="Whether meshes may be made that have to lie beside the result, such as that of an ellipsoid.", flag="-o"
    ),
    "keep_physics": Option(help="Refuse passes for consumers that change masses, inertias, joints or limits."),
}
"""Options that commands declare themselves, each in its own way."""
_OF = {"files": FileOptions, "checks": AnyCheckOptions, "conversions": RequestOptions}
_HEADING = "    Keyword Args:\n"
_WIDTH = 120
OPTIONS: Mapping[Callable[..., object], type] = {
    load: FileOptions,
    loads: FileOptions,
    load_description: FileOptions,
    check: AnyCheckOptions,
    convert: ConversionOptions,
    diff: FileOptions,
}
"""The functions, each with the options that it takes."""


def options_page() -> str:
    """All options in Markdown."""
    names = {**AnyCheckOptions.__annotations__, **ConversionOptions.__annotations__}
    return _INTRODUCTION + "".join(_row(name, option) for name, option in options_of(names).items())


def options_of(names: Iterable[str]) -> dict[str, Option]:
    """Return options by their names, also those that are not declared for the command line."""
    declared = {**declared_options(ReadingOptions), **declared_options(RequestOptions)}
    known = {name: option for name, (_, option) in declared.items()} | _OTHERS
    return {name: known[name] for name in names}


def _row(name: str, option: Option) -> str:
    of = next(word for word, options in _OF.items() if name in options.__annotations__)
    flag = option.flag or f"--{name.replace('_', '-')}"
    return f"| `{name}` | {of} | `{flag}` | {'yes' if option.setting else ''} | {option.help} |\n"


def with_options(text: str, function: str, options: type) -> str:
    """Return the text of a module in which the docstring of a function has all its options."""
    start = text.index(_HEADING, text.index(f"\ndef {function}(")) + len(_HEADING)
    end = text.index("\n\n", start - 1) + 1
    lines = (f"{name}: {option.help}" for name, option in options_of(options.__annotations__).items())
    wrapped = (textwrap.fill(line, _WIDTH, initial_indent=" " * 8, subsequent_indent=" " * 12) for line in lines)
    return text[:start] + "".join(f"{line}\n" for line in wrapped) + text[end:]


def docstrings() -> dict[str, str]:
    """Return the modules of all functions as they should be, by their paths in the package."""
    texts: dict[str, str] = {}
    for function, options in OPTIONS.items():
        path = function.__module__.partition(".")[2].replace(".", "/") + ".py"
        before = texts.get(path) or package_files("twinform").joinpath(path).read_text("utf-8")
        texts[path] = with_options(before, function.__name__, options)
    return texts
