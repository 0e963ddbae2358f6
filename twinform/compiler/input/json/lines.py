"""The lines of a JSON text on which its values begin; asked only where something is to be said of one."""

import json
import re

from twinform.schemas.json_check import JsonPath

_TOKEN = re.compile(r'"(?:[^"\\]|\\.)*"|[{}\[\],:]|[^\s{}\[\],:"]+')


def lines_of(text: str) -> dict[JsonPath, int]:
    """The line of every value of a JSON text, by the names and places that lead to it."""
    found: dict[JsonPath, int] = {}
    path: list[str | int] = []
    line, seen, names = 1, 0, False
    for token in _TOKEN.finditer(text):
        line, seen, word = line + text.count("\n", seen, token.start()), token.start(), token[0]
        match word:
            case "}" | "]":
                path.pop()
                names = False
            case ":":
                names = False
            case "," if isinstance(path[-1], int):
                path[-1] += 1
            case ",":
                names = True
            case _ if names:
                path[-1] = json.loads(word)
            case _:
                found[tuple(path)] = line
                names = word == "{"
                if word in "{[":
                    path.append("" if names else 0)
    return found
