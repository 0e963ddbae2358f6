"""A script that mends models by the answers of `twinform mcp` alone: it knows XML, and nothing of robots.

It writes what `fix` fixes. For what is left it tries edits of the piece that a finding is about, one after the other,
which come from what the finding says, from `schema`, and from other names in the file, and keeps the one after which
`check` finds least. Taking the part away comes last.
"""

import asyncio
import math
import re
import shutil
from collections.abc import AsyncIterator, Iterator, Sequence
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from typing import Any, NamedTuple

from testbed.agent import Agent, agent
from testbed.mistakes import FOLDER, MISTAKES, Mistake

Finding = dict[str, Any]
_WEIGHTS = {"info": 0, "warning": 1, "error": 10}
_UNREADABLE = 1000
"""The weight of an error that keeps the rest from being looked at."""
_HIDING = frozenset({"not-well-formed", "xacro-error", "missing-argument"})
_MODELS = (".urdf", ".sdf", ".xacro")
_QUOTED = re.compile(r"'([^']+)'|(?<=mean )([\w./:-]+)(?=\?)")
_NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")
_COUNTS = {"three numbers": 3, "four numbers": 4, "six numbers": 6, "number": 1, "value of its type": 1}
_REFERENCES = re.compile(r' (?:link|joint|reference)="([^"$]+)"')
_NAMES = re.compile(r'<(?:link|joint|frame|model)\s[^>]*?name="([^"$]+)"')


class Edit(NamedTuple):
    """A piece of a file, from one offset to another, and what is to stand there."""

    file: Path
    start: int
    end: int
    new: str


class Ending(StrEnum):
    """What became of a file with a mistake."""

    SAME = "the robot is as it was before the mistake"
    ANOTHER = "nothing is left to find, in another robot"
    REMOVED = "nothing is left to find, and a part is gone"
    LEFT = "something is left to find"
    UNFOUND = "the mistake was not found"


PLANTED = [each for each in MISTAKES if not each.file.startswith("corpus:")]
"""The mistakes in files in which there is nothing else to find."""


def mend_planted(folder: Path, mistakes: Sequence[Mistake]) -> list[Ending]:
    """Plant each mistake in a copy of its own below a folder, and let the script mend them in one session."""
    endings: list[Ending] = []
    shutil.copytree(FOLDER, folder / "right")

    async def work(session: Agent) -> None:
        mender = Mender(session, folder)
        for number, mistake in enumerate(mistakes):
            path, _ = mistake.make(folder / str(number))
            inner = path.relative_to(folder / str(number))
            endings.append(await mender.ending(f"{number}/{inner}", f"right/{inner}"))

    asyncio.run(agent(folder, work))
    return endings


@dataclass
class Mended:
    """How it ended: what is left, and whether parts were taken away."""

    left: list[Finding]
    removed: bool = False


class Mender:
    """Mends the files below the root of an agent's server."""

    def __init__(self, agent: Agent, root: Path) -> None:
        self.agent, self.root = agent, root

    async def ending(self, name: str, before: str) -> Ending:
        """Mend a file, and compare it with the one without the mistake."""
        if not await self._found(name):
            return Ending.UNFOUND
        done = await self.mend(name)
        if done.left or done.removed:
            return Ending.LEFT if done.left else Ending.REMOVED
        compared = await self.agent.ask("diff", a=before, b=name)
        return Ending.SAME if compared.get("same") else Ending.ANOTHER

    async def mend(self, name: str) -> Mended:
        """Mend a file; return what is found in it then."""
        done = Mended(await self._found(name))
        for unsafe in (False, True):
            if done.left:
                await self.agent.ask("fix", path=name, write=True, unsafe=unsafe)
                done.left = await self._found(name)
        while done.left:
            better = await self._improve(name, done)
            if better is None:
                break
            done.left = better
        return done

    async def _found(self, name: str) -> list[Finding]:
        """The warnings and errors about a file, the worst first."""
        answer = await self.agent.ask("check", path=name)
        found = [each for file in answer["files"] for each in file["diagnostics"] if each["severity"] != "info"]
        return sorted(found, key=lambda each: -_WEIGHTS[each["severity"]])

    async def _improve(self, name: str, done: Mended) -> list[Finding] | None:
        """Make the edit after which least is found, and return that; None where none makes anything better."""
        for last in (False, True):
            best, kept = done.left, dict[Path, str]()
            for finding in done.left:
                file = self.root / finding.get("file", name)
                async for edits in self._edits(finding, file, done.left, last=last):
                    found, after = await self._try(name, file, edits)
                    if _weight(found) < _weight(best):
                        best, kept = found, after
                    if not found:
                        break
                if not best:
                    break
            if kept:
                for file, text in kept.items():
                    file.write_text(text, "utf-8")
                done.removed |= last
                return best
        return None

    async def _try(self, name: str, file: Path, edits: list[Edit]) -> tuple[list[Finding], dict[Path, str]]:
        """Edit a file, fix what can be fixed then, and undo both; return what was found between, with the texts."""
        files = [each for each in (self.root / name).parent.rglob("*") if each.suffix in _MODELS]
        before = {each: each.read_text("utf-8") for each in files}
        file.write_text(_applied(before[file], edits), "utf-8")
        await self.agent.ask("fix", path=name, write=True, unsafe=True)
        found = await self._found(name)
        after = {each: each.read_text("utf-8") for each in files}
        for each, text in before.items():
            if after[each] != text:
                each.write_text(text, "utf-8")
        return found, {each: text for each, text in after.items() if text != before[each]}

    async def _edits(
        self, finding: Finding, file: Path, found: list[Finding], *, last: bool
    ) -> AsyncIterator[list[Edit]]:
        """Yield edits for a finding, the likeliest first."""
        text = file.read_text("utf-8")
        start, end = _span(finding, text)
        if last:
            for edit in _removals(file, text, start):
                yield [edit]
            return
        for new in _texts(finding, text[start:end]):
            yield [Edit(file, start, end, new)]
        for edit in _edits_of_tags(finding, file, text, end, found):
            yield [edit]
        async for edit in self._edits_by_schema(finding, file, (start, end), text):
            yield [edit]
        for other in dict.fromkeys(_NAMES.findall(text)):
            yield [Edit(file, start, end, other)]
        yield _swapped(file, text, start)

    async def _edits_by_schema(
        self, finding: Finding, file: Path, span: tuple[int, int], text: str
    ) -> AsyncIterator[Edit]:
        """Yield edits to the names, values and defaults that the element may have."""
        steps = [re.sub(r"\[.*?\]", "", each) for each in re.sub(r"'[^']*'", "", finding["path"]).split("/") if each]
        elements = [each for each in steps if not each.startswith("@")]
        if not elements:
            return
        try:
            answer = await self.agent.ask("schema", format=_format(text), element="/".join(elements[-2:]))
        except ValueError:
            return
        for place in answer["places"]:
            rows = {each["name"]: each for each in place["attributes"]}
            attribute = steps[-1].removeprefix("@") if steps[-1].startswith("@") else ""
            of_value = rows.get(attribute, {}) if attribute else place
            for value in (of_value.get("default"), *of_value.get("values", ())):
                if value is not None:
                    yield Edit(file, *span, str(value))
            for name in rows if "attribute" in finding["rule"] else ():
                yield Edit(file, *span, name)


def _weight(found: list[Finding]) -> int:
    return sum(_UNREADABLE if each["rule"] in _HIDING else _WEIGHTS[each["severity"]] for each in found)


def _applied(text: str, edits: list[Edit]) -> str:
    for edit in sorted(edits, key=lambda each: -each.start):
        text = text[: edit.start] + edit.new + text[edit.end :]
    return text


def _offset(text: str, line: int, column: int) -> int:
    start = 0
    for _ in range(line - 1):
        start = text.index("\n", start) + 1
    return start + max(0, column - 1)


def _span(finding: Finding, text: str) -> tuple[int, int]:
    """The offsets of the piece that a finding is about."""
    line = finding["line"]
    return _offset(text, line, finding["column"]), _offset(text, line, finding["end_column"])


def _format(text: str) -> str:
    return "sdf" if "<sdf" in text else "urdf"


def _texts(finding: Finding, written: str) -> Iterator[str]:
    """Yield what may be written instead: suggestions, the values that are expected, and numbers that fit."""
    help_, expected = finding["help"] or "", finding["expected"] or ""
    if "did you mean" in help_:
        suggested = ["".join(each) for each in _QUOTED.findall(help_)]
        yield from suggested
        yield from (f"{written.rpartition('/')[0]}/{each}" for each in suggested if "/" in written)
    if expected.startswith(("one of ", "true or false")):
        yield from re.split(r", | or ", expected.removeprefix("one of "))
    numbers = [float(each) for each in _NUMBER.findall(written)]
    count = next((count for words, count in _COUNTS.items() if words in f"{expected} {finding['message']}"), 0)
    if count:
        yield " ".join(f"{each:g}" for each in [*numbers, *[0.0] * count][:count])
        yield " ".join(["1"] * count)
    if len(numbers) == 1:
        (number,) = numbers
        yield f"{abs(number):g}"
        yield f"{math.radians(number):g}"
        bounds = _NUMBER.findall(expected)
        yield from bounds
    if "name" in finding["rule"]:
        yield f"{written}_2"
    yield re.sub(r"[-+*/]\s*\}", "}", written)


def _edits_of_tags(finding: Finding, file: Path, text: str, end: int, found: list[Finding]) -> Iterator[Edit]:
    """Yield edits that add what a tag lacks, behind the piece that a finding is about."""
    help_, message = finding["help"] or "", finding["message"]
    closing = re.compile(r"\s*/?>").search(text, end)
    if "close the tag" in help_:
        yield Edit(file, end, end, ">")
    if "close the quotes" in help_ and closing:
        yield Edit(file, closing.start(), closing.start(), '"')
        yield Edit(file, end, end, '"')
    if (finding["expected"] or "").startswith("@"):
        yield from _attributes(finding, file, text, end, found)
    parameter = re.search(r"without its parameter '(\w+)'", message)
    if parameter:
        yield Edit(file, end, end, f' {parameter[1]}="0"')
    argument = re.search(r"argument '(\w+)' has no value", message)
    if argument:
        root = text.index(">", text.index("<robot")) + 1
        yield Edit(file, root, root, f'\n  <xacro:arg name="{argument[1]}" default="1"/>')


def _attributes(finding: Finding, file: Path, text: str, end: int, found: list[Finding]) -> Iterator[Edit]:
    """Yield edits that give an element the attribute that it lacks."""
    name = finding["expected"].removeprefix("@")
    for other in found:  # one that nobody knows in the same element is this one, misspelt
        if other["rule"] == "unknown-attribute" and other["line"] == finding["line"]:
            yield Edit(file, *_span(other, text), name)
    others = reversed(re.findall(r'"([^"]+)"', text[end : text.index(">", end)]))
    known = {*_NAMES.findall(text)}
    values = [each for each in _REFERENCES.findall(text) if each not in known] if name == "name" else [*others, "1"]
    yield from (Edit(file, end, end, f' {name}="{value}"') for value in dict.fromkeys(values))


def _swapped(file: Path, text: str, start: int) -> list[Edit]:
    """Return edits that exchange the parent and the child of the joint at an offset."""
    begin, end = text.rfind("<joint", 0, start), text.find("</joint>", start)
    ends = [re.compile(rf'<{each} link="([^"]*)"').search(text, begin, end) for each in ("parent", "child")]
    if begin < 0 or not all(ends):
        return []
    parent, child = (each for each in ends if each)
    return [Edit(file, *parent.span(1), child[1]), Edit(file, *child.span(1), parent[1])]


def _removals(file: Path, text: str, start: int) -> Iterator[Edit]:
    """Yield edits that take the attribute or the element at an offset away."""
    attribute = re.compile(r'\s[\w:-]+="[^"]*"').match(text, start - 1)
    if attribute:
        yield Edit(file, *attribute.span(), "")
    begin = text.rfind("<", 0, start + 1)
    tag = re.compile(r"<([\w:]+)[^>]*?(/?)>").match(text, begin)
    if tag:
        end = tag.end() if tag[2] else text.find(f"</{tag[1]}>", begin) + len(tag[1]) + 3
        yield Edit(file, begin, end, "")
