"""The page of the options: `python -m twinform.compiler.options_page FILE [--check]` writes or checks it."""

import sys
from collections.abc import Iterable

from twinform.compiler.driver import ConversionOptions
from twinform.compiler.input.load_options import AnyCheckOptions, FileOptions, ReadingOptions
from twinform.diagnostics.generated_files import main
from twinform.option import Option, declared_options
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


if __name__ == "__main__":
    sys.exit(main(options_page(), sys.argv[1:]))
