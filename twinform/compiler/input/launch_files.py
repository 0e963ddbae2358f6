"""Values that launch files pass to a xacro file. They are read as text and never run: what they say is an offer."""

import re
from collections.abc import Iterable, Iterator
from itertools import islice
from pathlib import Path
from typing import NamedTuple

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
    for file, text in _texts(path, readable):
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


def _texts(path: Path, readable: Readable) -> Iterator[tuple[Path, str]]:
    """Yield the launch files beside a file, in its folder and those called `launch`, that have its name in them."""
    package = package_around(path)
    above = [path.parent, path.parent / "launch", path.parent.parent / "launch"]
    folders = dict.fromkeys((*above, package / "launch") if package else above)
    for file in islice((file for folder in folders for file in _launch_files(folder)), _MOST_FILES):
        try:
            text = readable.read(file, _LARGEST)[:_LARGEST].decode(errors="replace")
        except (OSError, ValueError):
            continue
        if path.name in text:
            yield file, text


def _launch_files(folder: Path) -> list[Path]:
    try:
        entries = islice(folder.iterdir(), _MOST_ENTRIES)
        return sorted(each for each in entries if each.name.endswith(_ENDINGS))
    except OSError:
        return []
