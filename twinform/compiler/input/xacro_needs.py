"""What a xacro file needs from outside and does not get: arguments without a value, and packages that are nowhere."""

import os
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path

from twinform.compiler.input.include_graph import IncludeGraph
from twinform.compiler.input.launch_files import Passed, values_in_launch_files
from twinform.compiler.input.load_options import LoadOptions
from twinform.compiler.resolve_uris import UriError
from twinform.diagnostics import DiagnosticSink, Location, rules

Absent = tuple[str, str, int, str]
"""The name of a package, the file and line that ask for it, and where it was looked for."""


def shown_name(file: str, main: str) -> str:
    """Return the name of a file as the main one is named: relative if that is, though `$(find)` made it absolute."""
    if f"{os.sep}..{os.sep}" in file:
        short = os.path.normpath(file)
        file = short if os.path.realpath(short) == os.path.realpath(file) else file
    return file.removeprefix(_folder_left_out(main))


def shown_message(message: str, main: str) -> str:
    """Return a message with names of files as the main one is named."""
    folder = _folder_left_out(main)
    return message.replace(f"'{folder}", "'") if folder else message


def _folder_left_out(main: str) -> str:
    if os.path.isabs(main):  # noqa: PTH117 - for each element
        return ""
    try:
        return os.path.join(os.getcwd(), "")  # noqa: PTH109, PTH118 - with a separator
    except OSError:
        return ""  # it was deleted


def report_missing_arguments(
    path: Path, first: str, where: Location, load_options: LoadOptions, sink: DiagnosticSink
) -> None:
    """Report all arguments that have no value where the `first` one was asked for, and how to give them one."""
    names = list(dict.fromkeys([first, *_missing_arguments(path, load_options)]))
    shown = ", ".join(map(repr, names))
    message = f"argument {shown} has no value" if len(names) == 1 else f"the arguments {shown} have no values"
    known = values_in_launch_files(path, names, load_options.search.readable(path))
    sink.report(rules.MISSING_ARGUMENT, message, where, found=f"$(arg {first})", help=_advice(path, names, known))


def _advice(path: Path, names: list[str], known: Mapping[str, Passed]) -> str:
    typed = " ".join(f"{name}:={known[name].value if name in known else 'VALUE'}" for name in names)
    launch = ", ".join(dict.fromkeys(each.file.name for each in known.values()))
    table = ", ".join(f'{name} = "{known[name].value if name in known else "..."}"' for name in names)
    lines = (
        f"pass {typed}{f' (values from {launch})' if launch else ''}",
        f'or give a default in the file, <xacro:arg name="{names[0]}" default="..."/>',
        f'or write in twinform.toml: [[files]] match = ["{path.name}"], arguments = {{ {table} }}',
    )
    return "\n".join(lines)


def _missing_arguments(path: Path, load_options: LoadOptions) -> Iterator[str]:
    """Yield the arguments that a file or one that it includes asks for, and that none gives a value."""
    outlines = [each for _, each in IncludeGraph(load_options.search).closure(os.path.realpath(path))]
    given = {name for each in outlines for name, default in each.arguments.items() if default is not None}
    given.update(load_options.arguments)
    yield from dict.fromkeys(asked.text for each in outlines for asked in each.asked if asked.text not in given)


def absent_packages(path: Path, load_options: LoadOptions) -> Iterator[Absent]:
    """Yield the packages that a file or one that it includes asks for, and that are nowhere."""
    search = load_options.search
    for file, outline in IncludeGraph(search).closure(os.path.realpath(path)):
        for name, line in outline.packages:
            try:
                search.package(name, Path(file))
            except UriError as error:
                yield name, file, line, error.help or ""


def report_missing_packages(absent: Iterable[Absent], sink: DiagnosticSink) -> None:
    """Report each package that is nowhere once, where it is asked for first."""
    first = {each[0]: each for each in reversed(list(absent))}
    for name, file, line, looked in first.values():
        where = Location(shown_name(file, sink.file), line)
        help = f"source the workspace that has it; {looked}"
        sink.report(rules.MISSING_PACKAGE, f"package {name!r} is not found", where, found=name, help=help)
