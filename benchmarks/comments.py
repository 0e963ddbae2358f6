"""What comments cost: real files beside the same files without comments."""

from collections.abc import Iterable
from pathlib import Path

from lxml import etree

from benchmarks.engines import TO_SDF
from benchmarks.inputs import FOLDER
from benchmarks.targets import Part, at_most
from benchmarks.turns import in_turns, milliseconds
from testbed.markdown import subsection, table
from testbed.output_files import kept

LIMIT = 1.05
_ABOUT = """\
URDF to SDF of every real file that has comments, and of the same file without them, in turns; the times are summed.
Comments are kept in a conversion."""


def measure(files: Iterable[Path], rounds: int) -> Part:
    """Convert each file that has comments with and without them."""
    pairs = [(_seconds(path, rounds), _seconds(bare, rounds)) for path in files if (bare := _without_comments(path))]
    TO_SDF.close()
    both = [(with_them, without) for with_them, without in pairs if with_them and without]
    with_them, without = (sum(column) for column in zip(*both, strict=True)) if both else (0.0, 0.0)
    ratios = [with_them / without] if both else []
    rows = [(len(both), *(milliseconds(each) for each in (with_them, without)), *(f"{each:.3f}" for each in ratios))]
    text = table(["files", "with comments, ms", "without, ms", "ratio"], rows if both else [])
    return Part(subsection("Comments", _ABOUT, text), [at_most("with comments, in times of without", LIMIT, ratios)])


def _seconds(path: Path, rounds: int) -> float:
    """The time of a file, 0 where it is refused."""
    return in_turns([TO_SDF], path, rounds)[TO_SDF.name].seconds


def _without_comments(path: Path) -> Path | None:
    """The file without its comments, in a file of its own; None where it has none, or cannot be parsed."""
    try:
        tree = etree.parse(path, etree.XMLParser(resolve_entities=False, no_network=True))
    except etree.XMLSyntaxError:
        return None
    if not any(True for _ in tree.iter(etree.Comment)):
        return None
    etree.strip_tags(tree, etree.Comment)
    return kept(FOLDER / "without_comments" / path.parent.name / path.name, etree.tostring(tree, encoding="unicode"))
