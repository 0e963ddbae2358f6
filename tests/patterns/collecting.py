"""Every regular expression of the package, with the ways in which it is used: from its source, and from its data."""

import ast
import builtins
import json
import re
import tomllib
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping
from functools import cache
from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Any, NamedTuple, cast

from lxml import etree

import twinform
from twinform.compiler.input import syntax_places
from twinform.compiler.output.json import json_schema_text

PACKAGE = Path(twinform.__file__).parent
_WAYS = frozenset({"findall", "finditer", "fullmatch", "match", "search", "split", "sub", "subn"})
_AT_THE_BEGINNING = frozenset({"fullmatch", "match"})
_LAZY = "lazy_pattern"
"""What the package calls instead of `re.compile`."""


class Used(NamedTuple):
    """A regular expression, where it is written, and whether a text is searched for it at every place."""

    place: str
    pattern: re.Pattern[Any]
    searched: bool


class _Holes(dict[str, Any]):
    """What stands for a name that has a value only when the program runs."""

    def __init__(self, module: ModuleType) -> None:
        super().__init__()
        self.known = {*vars(module), *vars(builtins)}

    def __missing__(self, name: str) -> str:
        if name in self.known:
            raise KeyError(name)
        return _Hole("a")


class _Hole(str):
    """A word that is also a mapping of words."""

    __slots__ = ()

    def __getitem__(self, key: object) -> "_Hole":
        return self

    def __getattr__(self, name: str) -> "_Hole":
        return self


@cache
def patterns() -> tuple[Used, ...]:
    """All of them, in the order of files and lines."""
    trees = {path: ast.parse(path.read_text(encoding="utf-8")) for path in sorted(PACKAGE.rglob("*.py"))}
    everywhere = _ways(trees.values())
    found = [each for path, tree in trees.items() if _mentions_re(tree) for each in _of_module(path, tree, everywhere)]
    return (*found, *_of_data())


def _mentions_re(tree: ast.Module) -> bool:
    return any(isinstance(each, ast.Name) and each.id in {"re", _LAZY} for each in ast.walk(tree))


def _ways(trees: Iterable[ast.Module]) -> Mapping[str, set[str]]:
    """How the names of patterns are used: by their methods, and as `search` where they are handed on."""
    found: defaultdict[str, set[str]] = defaultdict(set)
    for tree in trees:
        methods: set[ast.AST] = set()
        for each in ast.walk(tree):
            match each:
                case ast.Attribute(value=ast.Name(id=name) as owner, attr=way):
                    methods.add(owner)
                    if way in _WAYS:
                        found[name].add(way)
                case ast.Name(id=name, ctx=ast.Load()) if each not in methods:
                    found[name].add("search")
                case _:
                    pass
    return found


def _of_module(path: Path, tree: ast.Module, everywhere: Mapping[str, set[str]]) -> Iterator[Used]:
    ways = {**everywhere, **{name: way for name, way in _ways([tree]).items() if name.startswith("_")}}
    names = {id(each.value): _name(each) for each in ast.walk(tree) if isinstance(each, (ast.Assign, ast.AnnAssign))}
    module = import_module(
        ".".join((PACKAGE.name, *path.relative_to(PACKAGE).with_suffix("").parts)).removesuffix(".__init__")
    )
    for call in ast.walk(tree):
        match call:
            case ast.Call(
                func=ast.Attribute(value=ast.Name(id="re"), attr=called) | ast.Name(id=called), args=[pattern, *_]
            ) if called in {*_WAYS, "compile", _LAZY} and (called == _LAZY or isinstance(call.func, ast.Attribute)):
                way = "compile" if called == _LAZY else called
                used = ways.get(names.get(id(call), ""), {"search"}) if way == "compile" else {way}
                made = _evaluated(call, pattern, way, module)
                if made is not None:
                    place = f"{path.relative_to(PACKAGE)}:{call.lineno}"
                    yield Used(place, made, searched=not used <= _AT_THE_BEGINNING)
            case _:
                pass


def _name(assignment: ast.Assign | ast.AnnAssign) -> str:
    target = assignment.targets[0] if isinstance(assignment, ast.Assign) else assignment.target
    return target.id if isinstance(target, ast.Name) else ""


def _evaluated(call: ast.Call, pattern: ast.expr, way: str, module: ModuleType) -> re.Pattern[Any] | None:
    """The pattern of a call, with a word for each value that is not known; None where all of it is such a value."""
    given = [each for each in call.keywords if each.arg == "flags"]
    flags = given[0].value if given else call.args[1] if way == "compile" and len(call.args) > 1 else ast.Constant(0)
    try:
        values = [
            eval(compile(ast.fix_missing_locations(ast.Expression(each)), "", "eval"), vars(module), _Holes(module))
            for each in (pattern, flags)
        ]
    except LookupError:  # one of a table, all of which are looked at elsewhere
        return None
    return None if isinstance(values[0], (_Hole, re.Pattern)) else re.compile(values[0], int(values[1]))


def _of_data() -> Iterator[Used]:
    """Those that are data: of the JSON schema and the XSDs, of profiles, and of tables in modules."""
    schema: object = json.loads(json_schema_text())
    for pattern in sorted(set(_json_patterns(schema))):
        yield Used("ir/element.py", re.compile(pattern), searched=True)
    values = {
        str(each.get("value"))
        for path in PACKAGE.rglob("*.xsd")
        for each in etree.parse(path).getroot().iter("{http://www.w3.org/2001/XMLSchema}pattern")
    }
    for value in sorted(values):
        yield Used("schemas/xsd", re.compile(value), searched=False)
    tables = [tomllib.loads(path.read_text(encoding="utf-8")) for path in PACKAGE.glob("profiles/data/*.toml")]
    for text in sorted({text for table in tables for text in _profile_patterns(table)}):
        yield Used("profiles/data", re.compile(text), searched=True)
    module: Mapping[str, Any] = vars(syntax_places)
    for name, text in {**module["_WORDS"], **module["_BEFORE"]}.items():
        yield Used(f"compiler/input/syntax_places.py:{name}", re.compile(text.replace("{word}", "a")), searched=True)


def _profile_patterns(table: object) -> Iterator[str]:
    """The values of `message` and `place`, at any depth."""
    if isinstance(table, dict):
        for key, each in cast("dict[str, object]", table).items():
            if key in {"message", "place"} and isinstance(each, str):
                yield each
            yield from _profile_patterns(each)
    elif isinstance(table, list):
        for each in cast("list[object]", table):
            yield from _profile_patterns(each)


def _json_patterns(value: object) -> Iterator[str]:
    if isinstance(value, dict):
        for key, each in cast("dict[str, object]", value).items():
            if key == "pattern" and isinstance(each, str):
                yield each
            yield from _json_patterns(each)
    elif isinstance(value, list):
        for each in cast("list[object]", value):
            yield from _json_patterns(each)
