"""Models as xacro files that expand to them, and how such files are fixed."""

import os
from collections.abc import Iterator, Mapping
from copy import deepcopy
from pathlib import Path

from lxml import etree

from twinform.compiler import LoadOptions, LoadResult, inspect, read
from twinform.compiler.fixing import FixResult, Texts, apply_fixes_by
from twinform.passes import Pipeline
from twinform.schemas import XmlElement
from twinform.text.serializing import value_of

MAIN, PARTS = "main.xacro", "parts.xacro"
XACRO = "http://www.ros.org/wiki/xacro"


def root_of(data: bytes) -> XmlElement:
    """Return the root of a model without its comments, which may have what xacro evaluates."""
    return etree.fromstring(data, etree.XMLParser(remove_comments=True))


def as_it_is(root: XmlElement) -> dict[str, str]:
    """Return a xacro file with the text of a model."""
    return {MAIN: _text(root)}


def in_properties(root: XmlElement) -> dict[str, str]:
    """Return a xacro file in which each value of a model, but for names, is that of a property."""
    made, properties = deepcopy(root), list[str]()

    def defined(value: str) -> str:
        properties.append(f'<xacro:property name="value_{len(properties)}" value="{value_of(value)}"/>')
        return f"${{value_{len(properties) - 1}}}"

    for element in made.iterdescendants("*"):
        for name, value in element.items():
            if name != "name" and value.strip() and "{" not in f"{name}{value}":
                element.set(name, defined(str(value)))
        if not len(element) and (element.text or "").strip() and element.tag != "plugin":
            element.text = defined((element.text or "").strip())
    return {MAIN: _text(made).replace(">", f">{''.join(properties)}", 1)}


def in_a_macro(root: XmlElement) -> dict[str, str]:
    """Return a xacro file that calls a macro of another file, with the text of a model in a branch."""
    made, called = deepcopy(root), deepcopy(root)
    for child in called:
        called.remove(child)
    for name in made.attrib:
        del made.attrib[name]
    inside = _text(made).partition(">")[2].rpartition("</")[0]
    macro = f'<xacro:macro name="all" params="taken">{_if(inside)}</xacro:macro>'
    parts = f'<robot xmlns:xacro="{XACRO}">{macro}</robot>'
    call = f'<xacro:include filename="{PARTS}"/><xacro:all taken="true"/>'
    called.text = None
    main = _text(called)
    return {MAIN: main.replace("/>", f">{call}</{root.tag}>", 1), PARTS: parts}


def _if(inside: str) -> str:
    return f'<xacro:if value="${{taken}}">{inside}</xacro:if>'


def _text(root: XmlElement) -> str:
    name = str(root.tag)
    return etree.tostring(root, encoding="unicode").replace(f"<{name}", f'<{name} xmlns:xacro="{XACRO}"', 1)


def fixed_xacro(folder: Path, texts: Mapping[str, str], *, unsafe: bool, passes: Pipeline | None = None) -> FixResult:
    """Write xacro files into a folder, and fix the main one; the files themselves stay as they are."""
    for name, text in texts.items():
        (folder / name).write_text(text)
    path = folder / MAIN

    def look(changed: Texts) -> LoadResult:
        options = LoadOptions().with_unsaved({os.path.realpath(name or path): data for name, data in changed.items()})
        return inspect(read(path, options), options, passes)

    return apply_fixes_by(look, path.read_bytes(), unsafe=unsafe)


def outline(data: bytes) -> object:
    """Return what is equal for two texts of one model; comments, layout and the spelling of values do not count."""
    return _outline(root_of(data))


def _outline(element: XmlElement) -> object:
    texts = tuple(_value(text) for text in _texts(element) if text.strip())
    return (
        str(element.tag),
        {str(key): _value(str(value)) for key, value in element.items()},
        texts,
        [*map(_outline, element)],
    )


def _texts(element: XmlElement) -> Iterator[str]:
    yield element.text or ""
    yield from (child.tail or "" for child in element)


def _value(text: str) -> tuple[object, ...]:
    return tuple(map(_word, text.split()))


def _word(word: str) -> object:
    try:
        return float(word)
    except ValueError:
        return word.lower() if word.lower() in {"false", "true"} else word
