"""Makes the page of the passes of legalisation, in the order in which they run."""

from collections.abc import Iterable, Iterator
from typing import NamedTuple

from twinform.ir import Format
from twinform.passes.framework.pass_base import Pass
from twinform.passes.framework.pass_page import summary
from twinform.passes.framework.pipeline import Pipeline
from twinform.passes.legalise import Target, legalisation
from twinform.request_options import URDF_VERSIONS
from twinform.schemas import versions_of

_INTRODUCTION = """\
# The pipeline

What happens to a document between reading and writing, in order. `twinform convert --print-pipeline` prints it for one
file, `--dump-ir-after PASS` and `--print-changes` show it happening, `--time-passes` prints how long each takes.

1. **Reading.** Parsing, the schema of the format and version, the typed document, and what it must keep beyond its
   schema. Findings up to here are those of `twinform check`.
2. **Includes**, where they are asked for or the target has none, are put in their place.
3. **Your passes**, those of `--passes`, [each with its page](../reference/passes.md). The document is verified after
   each that changed something.
4. **Legalisation**: the passes below, which turn what the target cannot express into what it can. The document is
   verified after the last of them.
5. **Writing**, and the schema of the target once more.
"""
_CARRIERS = """\
Without `--no-carriers`, what the target cannot express travels in our own namespace; each of these passes documents
in its docstring what it changes, what it never touches and what it reports.
"""
_SOURCE = "../.."
"""From the page to the folder that the package is in."""


class ConversionDirection(NamedTuple):
    """From one format and version to another."""

    title: str
    source: Format
    version: str | None
    target: Target
    remark: str


def directions() -> Iterator[ConversionDirection]:
    """Yield the directions of conversion on the page; together they have every pass."""
    versions = versions_of("sdf")
    oldest, newest = versions[0], versions[-1]
    older = "An older version takes some of the passes of the last chapter, before the last one of these."
    usual = Target(Format.SDF)
    yield ConversionDirection(f"From URDF to SDF {usual.sdf_version}", Format.URDF, None, usual, older)
    remark = "A document of another version is upgraded to the newest one first."
    yield ConversionDirection("From SDF to URDF", Format.SDF, newest, Target(Format.URDF), remark)
    remark = "A document of SDF takes the last two, behind those that make it one of the newest version."
    yield ConversionDirection("From URDF to MJCF", Format.URDF, None, Target(Format.MJCF), remark)
    remark = "Of these, those run that lie between the two versions."
    yield ConversionDirection("From older SDF to newer", Format.SDF, oldest, Target(Format.SDF, newest), remark)
    yield ConversionDirection("From newer SDF to older", Format.SDF, newest, Target(Format.SDF, oldest), remark)
    remark = "Where `--urdf-version` asks for another version than that of the file, newer or older."
    to = Target(Format.URDF, urdf_version=URDF_VERSIONS[-1])
    yield ConversionDirection("From URDF to another version", Format.URDF, None, to, remark)


def pipeline_page() -> str:
    """The whole page in Markdown."""
    return "\n".join([_INTRODUCTION, "## Legalisation", "", _CARRIERS, *map(_chapter, directions())])


def _chapter(direction: ConversionDirection) -> str:
    passes = legalisation(direction.source, direction.version, direction.target)
    return "\n".join([f"### {direction.title}", "", direction.remark, "", *_items(passes), ""])


def _items(passes: Iterable[Pass]) -> Iterator[str]:
    for number, each in enumerate(passes, 1):
        path = f"{_SOURCE}/{type(each).__module__.replace('.', '/')}.py"
        yield f"{number}. [`{Pipeline((each,))}`]({path}): {summary(type(each))}"
