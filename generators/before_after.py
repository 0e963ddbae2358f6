"""The first picture of the README: a URDF, the SDF that becomes of it, and what the commands say, light and dark."""

import contextlib
import shlex
import tempfile
from collections.abc import Iterator
from html import escape
from pathlib import Path

from click.testing import CliRunner
from pygments import highlight
from pygments.formatters import HtmlFormatter
from pygments.lexers import get_lexer_by_name  # pyright: ignore[reportUnknownVariableType]

from twinform.cli import main as twinform

_SOURCE = Path(__file__).with_name("pendulum.urdf")
_COMMANDS = (
    "twinform convert pendulum.urdf -o pendulum.sdf",
    "twinform convert pendulum.sdf -o back.urdf",
    "twinform diff pendulum.urdf back.urdf",
)
_STYLE = """
body {{ margin: 0; padding: 20px; width: 1160px; background: {page}; color: {text} }}
main {{ display: grid; grid-template-columns: 1fr 44px 1fr; gap: 0 8px; align-items: center }}
main > div {{ height: 100%; display: flex; flex-direction: column; gap: 14px }}
section {{ background: {panel}; border: 1px solid {line}; border-radius: 8px; flex: auto }}
section:last-child:not(:first-child) {{ flex: none }}
h2 {{ margin: 0; padding: 8px 16px; font: bold 15px "DejaVu Sans"; border-bottom: 1px solid {line} }}
pre {{ margin: 0; padding: 12px 16px; font: 14px/1.42 "DejaVu Sans Mono" }}
p {{ margin: 0; text-align: center; font: 40px "DejaVu Sans"; color: {mark} }}
b {{ color: {mark}; font-weight: normal }}
"""
_THEMES = {
    "light": (
        "default",
        {"page": "#ffffff", "panel": "#fbfbfb", "text": "#1f2328", "line": "#d5d9de", "mark": "#b4531a"},
    ),
    "dark": (
        "github-dark",
        {"page": "#0d1117", "panel": "#151b23", "text": "#e6edf3", "line": "#3d444d", "mark": "#f0a35e"},
    ),
}


def before_after_pages() -> Iterator[tuple[str, str]]:
    """Yield the name and the HTML of each picture."""
    said, made = _run()
    for name, (style, colors) in _THEMES.items():
        formatter = HtmlFormatter[str](nowrap=True, style=style, noclasses=True)
        source, result = (
            f"<section><h2>{title}</h2><pre>{highlight(text, get_lexer_by_name('xml'), formatter)}</pre></section>"
            for title, text in (("pendulum.urdf", _SOURCE.read_text(encoding="utf-8")), ("pendulum.sdf", made))
        )
        style_sheet = f"<style>{_STYLE.format(**colors)}</style>"
        terminal = f"<section><pre>{said}</pre></section>"
        body = f"<main><div>{source}{terminal}</div><p>&#8644;</p><div>{result}</div></main>"
        yield name, f'<!doctype html><meta charset="utf-8">{style_sheet}{body}'


def _run() -> tuple[str, str]:
    """Return the commands with what they print, as HTML, and the SDF."""
    said: list[str] = []
    with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
        Path(_SOURCE.name).write_bytes(_SOURCE.read_bytes())
        for command in _COMMANDS:
            done = CliRunner().invoke(twinform, shlex.split(command)[1:], catch_exceptions=False)
            said += [f"$ {command}", f"<b>{escape(done.output.strip())}</b>"]
        return "\n".join(said), Path("pendulum.sdf").read_text(encoding="utf-8")
