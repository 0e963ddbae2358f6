"""What a xacro file needs from outside and does not get: packages, and arguments, which launch files may have.

Launch files are read as text and never run: what they say is an offer.
"""

import os
import re
from collections.abc import Iterable, Iterator, Mapping
from itertools import islice
from pathlib import Path
from typing import NamedTuple

from twinform.compiler.input.include_graph import IncludeGraph
from twinform.compiler.input.load_options import LoadOptions
from twinform.compiler.resolve_uris import UriError, exists
from twinform.diagnostics import DiagnosticSink, Location, did_you_mean, rules
from twinform.file_access import Readable, package_around

_ENDINGS = (".launch", ".launch.xml", ".launch.py", ".launch.yaml")
_LARGEST = 2**18
_MOST_FILES = 100
_MOST_ENTRIES = 1000
# `name:=value` in a command, or a default of the launch file's own argument of that name. Values with anything that is
# to be evaluated are no values. Each form begins with a fixed text, and its parts cannot retry each other.
_VALUE = r"""["']?(?P<value>[\w./+-]{1,100})["']?"""
_FORMS = (
    r"\b{name}:={value}(?![\w$(])",
    r"""(?:DeclareLaunchArgument|LaunchConfiguration)\(\s*["']{name}["']\s*,[^()]{{0,200}}?\bdefault(?:_value)?\s*=\s*{value}""",
    r"""<arg\s+name=["']{name}["']\s+default={value}\s*/?>""",
)


class Passed(NamedTuple):
    """A value of an argument, and the launch file that passes it."""

    value: str
    file: Path


def values_in_launch_files(path: Path, names: Iterable[str], readable: Readable) -> dict[str, Passed]:
    """Return the values of arguments in launch files beside a xacro file that mention it."""
    found: dict[str, Passed] = {}
    wanted = list(names)
    for file, text in launch_files_of(path, readable):
        if path.name not in text:
            continue
        for name in wanted:
            value = None if name in found else _value(name, text)
            if value:
                found[name] = Passed(value, file)
    return found


def _value(name: str, text: str) -> str | None:
    for form in _FORMS:
        found = re.search(form.format(name=re.escape(name), value=_VALUE), text)
        if found:
            return found["value"]
    return None


def launch_files_of(path: Path, readable: Readable) -> Iterator[tuple[Path, str]]:
    """Yield the launch files beside a file, in its folder and those called `launch`, with their texts."""
    package = package_around(path)
    above = [path.parent, path.parent / "launch", path.parent.parent / "launch"]
    folders = dict.fromkeys((*above, package / "launch") if package else above)
    for file in islice((file for folder in folders for file in _launch_files(folder)), _MOST_FILES):
        try:
            text = readable.read(file, _LARGEST)[:_LARGEST].decode(errors="replace")
        except (OSError, ValueError):
            continue
        yield file, text


def _launch_files(folder: Path) -> list[Path]:
    try:
        entries = islice(folder.iterdir(), _MOST_ENTRIES)
        return sorted(each for each in entries if each.name.endswith(_ENDINGS))
    except OSError:
        return []


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
    defaults, asked = _arguments_of(path, load_options)
    given = defaults.keys() | load_options.arguments.keys()
    names = list(dict.fromkeys([first, *(name for name in asked if name not in given)]))
    shown = ", ".join(map(repr, names))
    message = f"argument {shown} has no value" if len(names) == 1 else f"the arguments {shown} have no values"
    if first in defaults:
        message += f"; the default of {first!r} stands behind this place"
    known = values_in_launch_files(path, names, load_options.search.readable(path))
    meant = did_you_mean(first, _defined_arguments(path, load_options)) if len(names) == 1 and not known else None
    help = "\n".join(filter(None, (meant, _advice(path, names, known))))
    sink.report(rules.MISSING_ARGUMENT, message, where, found=f"$(arg {first})", help=help)


def _defined_arguments(path: Path, load_options: LoadOptions) -> set[str]:
    """Return the arguments that a file or one that it includes defines."""
    closure = IncludeGraph(load_options.search).closure(os.path.realpath(path))
    return {name for _, each in closure for name in each.arguments}


def suggest_file(error: str, path: Path, load_options: LoadOptions) -> str | None:
    """Return the sentence that suggests a file for one that cannot be read, in its folder and with its suffix."""
    missing, search = Path(_path_read(error)), load_options.search
    # a file from elsewhere must learn of no names but those around it
    if not missing.suffix or exists(missing) or not search.readable(path).allows(missing.parent):
        return None
    names = search.index.listing(missing.parent).by_suffix.get(missing.suffix.lower(), ())
    return did_you_mean(missing.name, names)


def _path_read(error: str) -> str:
    """Return the path in a message about a file that cannot be read; empty for other messages."""
    return error.removeprefix("cannot read '").partition("'")[0] if error.startswith("cannot read '") else ""


def report_empty_arguments(
    error: str, path: Path, where: Location, load_options: LoadOptions, sink: DiagnosticSink
) -> bool:
    """Report the arguments that are empty unless somebody passes them, where a path has an empty part.

    Returns whether there are any.
    """
    defaults, _ = _arguments_of(path, load_options)
    names = [name for name, default in defaults.items() if not default and name not in load_options.arguments]
    path_read = _path_read(error)
    if not names or not ("//" in path_read or path_read.endswith("/")):
        return False
    shown, verb = ", ".join(map(repr, names)), "is" if len(names) == 1 else "are"
    message = f"{shown} {verb} empty unless passed, and a path lacks a part: {error}"
    known = values_in_launch_files(path, names, load_options.search.readable(path))
    sink.report(rules.MISSING_ARGUMENT, message, where, found=names[0], help=_advice(path, names, known))
    return True


def _arguments_of(path: Path, load_options: LoadOptions) -> tuple[dict[str, str], list[str]]:
    """Return the defaults of the arguments of a file with all that it includes, and the arguments that it asks for."""
    outlines = [each for _, each in IncludeGraph(load_options.search).closure(os.path.realpath(path))]
    defaults = {name: text for each in outlines for name, text in each.arguments.items() if text is not None}
    return defaults, [each.text for outline in outlines for each in outline.asked]


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
