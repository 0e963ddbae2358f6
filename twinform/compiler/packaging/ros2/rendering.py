"""Templates of launch files and CMake: names in `{{...}}`, and lines that are left out where they do not apply."""

import re
from collections.abc import Mapping
from importlib import resources

# Templates read as what they become. A template engine would be a dependency of everybody for forty
# marked lines.
_NAME = re.compile(r"\{\{(\w+)\}\}")
_PLAIN = re.compile(r"[A-Za-z0-9_./-]+")
_CONDITION = re.compile(r"  #\? (\w+)$")


def render(template: str, values: Mapping[str, str], facts: Mapping[str, bool]) -> str:
    """A template of this room with its values; a line that ends in `#? FACT` is there only where that is true.

    What is put in is not looked at again, so values may be any text.
    """
    text = (resources.files("twinform.compiler.packaging.ros2") / "templates" / template).read_text(encoding="utf-8")
    kept: list[str] = []
    for line in text.splitlines():
        condition = _CONDITION.search(line)
        if condition is None or facts[condition[1]]:
            kept.append(_NAME.sub(lambda found: values[found[1]], _CONDITION.sub("", line)))
    return "\n".join(kept) + "\n"


def python_text(text: str) -> str:
    """Text as Python has it, in single quotes, as ROS 2 writes them, wherever that needs no more escapes."""
    # Single quotes and 99 columns, as ament's linters want generated Python.
    return ascii(text)


def cmake_text(text: str) -> str:
    """Text as CMake has it, in quotes where it needs them."""
    return text if _PLAIN.fullmatch(text) else '"' + re.sub(r'([\\"$@])', r"\\\1", text) + '"'
