"""Options in docstrings: `python -m twinform.compiler.option_docstrings [--check]` writes or checks them.

Functions that take options as keywords say each of them under `Keyword Args:`, where `help`, notebooks and editors show
it. An editor reads the docstring in the source and runs nothing, so it has to stand there.
"""

import inspect
import sys
import textwrap
from collections.abc import Callable, Mapping
from pathlib import Path

from twinform.compiler.compare.compare_files import diff
from twinform.compiler.descriptions import load_description
from twinform.compiler.driver import ConversionOptions, convert
from twinform.compiler.input.load_options import AnyCheckOptions, FileOptions
from twinform.compiler.input.loading import load, loads
from twinform.compiler.inspection import check
from twinform.compiler.options_page import options_of
from twinform.diagnostics.generated_files import main

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


def with_options(text: str, function: str, options: type) -> str:
    """Return the text of a module in which the docstring of a function has all its options."""
    start = text.index(_HEADING, text.index(f"\ndef {function}(")) + len(_HEADING)
    end = text.index("\n\n", start - 1) + 1
    lines = (f"{name}: {option.help}" for name, option in options_of(options.__annotations__).items())
    wrapped = (textwrap.fill(line, _WIDTH, initial_indent=" " * 8, subsequent_indent=" " * 12) for line in lines)
    return text[:start] + "".join(f"{line}\n" for line in wrapped) + text[end:]


def _texts() -> dict[Path, str]:
    """Return the modules of all functions as they should be."""
    texts: dict[Path, str] = {}
    for function, options in OPTIONS.items():
        path = Path(inspect.getfile(function))
        texts[path] = with_options(texts.get(path) or path.read_text("utf-8"), function.__name__, options)
    return texts


if __name__ == "__main__":
    sys.exit(max(main(text, [str(path), *sys.argv[1:]]) for path, text in _texts().items()))
