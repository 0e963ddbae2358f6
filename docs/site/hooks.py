"""Hooks of the site's build: lists of pages, the rules, what the search puts first, and links that lead out of docs/.

A page of docs/ links to files of the repository, such as cases and examples, as a code host wants it. Here such a file
goes into the site as it is, below `source/`; a link to a folder becomes its text.
"""

import posixpath
import re
from pathlib import Path
from typing import Any

from mkdocs.structure.files import File, Files
from mkdocs.structure.pages import Page

from twinform.diagnostics import catalog
from twinform.diagnostics.rule_page import rule_page

_ROOT = Path(__file__).parents[2]
_LINK = re.compile(r"\[(?P<text>(?:[^\[\]]|\[[^\]]*\])*)\]\((?P<path>(?:\.\./)+[^)#\s]*)(?P<anchor>#[^)\s]*)?\)")
_TITLE = re.compile(r"^# (.+)$", re.MULTILINE)
_LISTED = {"Evidence": "evidence"}
_LATER = {"evidence": 0.2, "explanation": 0.4}
"""What the search makes of matches in pages of a folder: who looks for a word wants to use it first."""
_WIDE = frozenset({"reference/who_reads_what/README.md"})
"""Pages with tables that need all of the width."""
_RULES = "twinform/diagnostics/rules/"
"""Where the rules are written; the site has their pages below `reference/rules/`."""
_copied: dict[str, File] = {}


def on_config(config: Any) -> Any:
    """Fill in the parts of the navigation that are all pages of a folder."""
    for part in config["nav"]:
        for title, folder in _LISTED.items():
            if title in part:
                part[title] = [*_pages(folder)]
    return config


def _pages(folder: str) -> list[Any]:
    found = sorted((_ROOT / "docs" / folder).glob("*.md"), key=lambda page: (page.name != "README.md", page.name))
    return [f"{folder}/{page.name}" for page in found]


def on_files(files: Files, config: Any) -> Files:
    """Put the rules into the site, and every file that a page links to."""
    _copied.clear()
    for rule in catalog().values():
        page = File.generated(config, f"reference/rules/{rule.name}.md", content=rule_page(rule))
        files.append(page)
        _copied[f"{_RULES}{rule.name}.md"] = page
    for page in files.documentation_pages():
        for match in _LINK.finditer(page.content_string):
            target = _outside(page.src_uri, match["path"])
            if target is not None and (_ROOT / target).is_file() and target not in _copied:
                text = (_ROOT / target).read_bytes()
                _copied[target] = File.generated(config, f"source/{target}.txt", content=text)
                files.append(_copied[target])
    return files


def on_page_markdown(markdown: str, *, page: Page, config: Any, files: Files) -> str:
    """Let links out of docs/ lead to the copies, and say how much the search makes of the page."""
    del config, files
    page.meta["search"] = {"boost": _LATER.get(posixpath.dirname(page.file.src_uri), 1.0)}
    if page.file.src_uri in _WIDE:
        page.meta["hide"] = ["navigation", "toc"]

    def changed(match: re.Match[str]) -> str:
        target = _outside(page.file.src_uri, match["path"])
        if target is None:
            return match[0]
        if target not in _copied:
            return match["text"]
        copy = posixpath.relpath(_copied[target].src_uri, posixpath.dirname(page.file.src_uri) or ".")
        return f"[{match['text']}]({copy})"

    return _LINK.sub(changed, markdown)


def _outside(page: str, path: str) -> str | None:
    """The path in the repository of what a link leads to; None where that is a page of the site."""
    target = posixpath.normpath(posixpath.join("docs", posixpath.dirname(page), path))
    return None if target.startswith(("docs/", "..")) else target
