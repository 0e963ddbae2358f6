"""Are the comments of real files still there, whatever is done with the files?"""

from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from enum import StrEnum

import twinform
from reports.harness.sample import Sample
from reports.harness.section import Findings, Section
from testbed.comments import OTHER, comments
from testbed.corpus.files import CorpusFile, Kind
from testbed.markdown import listing, subsection, table
from twinform import CompileError
from twinform.compiler import ConversionRequest, LoadOptions, SearchPath
from twinform.compiler.formatting import formatted
from twinform.compiler.in_place import convert_in_place
from twinform.request_options import Language
from twinform.text.formatting import FormatOptions

_ABOUT = """\
Every URDF and SDF file of the corpus that has a comment is formatted, converted to its own format and to the other one,
converted in its place, and what it became in the other format is converted back. *Kept* are comments that are there
once, with their text; *in the ledger* are those of what is not converted, such as the rest of a world around a model.
Files are refused for what is wrong in them, not for comments; `format` and `--in-place` want XML that is well-formed.
Comments of xacro files stay in these, since what they expand to is another text; `format` keeps them."""


class Deed(StrEnum):
    """What is done with a file."""

    FORMAT = "format"
    SAME = "convert to the same format"
    IN_PLACE = "convert --in-place"
    OTHER = "convert to the other format"
    BACK = "and back"


@dataclass(frozen=True, slots=True)
class Outcome:
    """What became of the comments of a file; `wrong` are those that are gone without a word, or there twice."""

    deed: Deed
    name: str
    of: int = 0
    kept: int = 0
    left: int = 0
    wrong: int = 0
    refused: bool = False


def measure(sample: Sample) -> Findings:
    """Do everything with every file."""
    files = [file for file in sample.models(Kind.URDF, Kind.SDF) if b"<!--" in file.path.read_bytes()]
    found = [outcome for file in files for outcome in _outcomes(file)]
    rows = [_row(deed, [each for each in found if each.deed is deed]) for deed in Deed]
    totals = table(("what is done", "files", "refused", "comments", "kept", "in the ledger", "wrong"), rows)
    wrong = [each for each in found if each.wrong]
    listed = listing(("file", "what was done", "comments"), [(each.name, each.deed, each.wrong) for each in wrong])
    return Findings([totals, subsection("Wrong", listed)], totals, [f"not explained: {each.name}" for each in wrong])


def _row(deed: Deed, found: list[Outcome]) -> tuple[object, ...]:
    done = [each for each in found if not each.refused]
    sums = Counter[str]()
    for each in done:
        sums.update(of=each.of, kept=each.kept, left=each.left, wrong=each.wrong)
    return (deed, len(done), len(found) - len(done), sums["of"], sums["kept"], sums["left"], sums["wrong"])


def _outcomes(file: CorpusFile) -> Iterator[Outcome]:
    data, own = file.path.read_bytes(), _language(file)
    yield _judged(Deed.FORMAT, file, data, lambda: (formatted(data, file.name, FormatOptions()), 0))
    yield _judged(Deed.SAME, file, data, lambda: _converted(file, own))
    yield _judged(Deed.IN_PLACE, file, data, lambda: _in_place(file, own))
    try:
        there, _ = _converted(file, OTHER[own])
    except CompileError:
        yield Outcome(Deed.OTHER, file.name, refused=True)
        return
    yield _judged(Deed.OTHER, file, data, lambda: _converted(file, OTHER[own]))
    yield _judged(Deed.BACK, file, there, lambda: (twinform.convert(there, to=own).text.encode(), 0))


def _judged(deed: Deed, file: CorpusFile, data: bytes, make: Callable[[], tuple[bytes, int]]) -> Outcome:
    before = comments(data)
    try:
        made, left = make()
    except CompileError:
        return Outcome(deed, file.name, refused=True)
    after = comments(made)
    lost, twice = (before - after).total(), (after - before).total()
    kept = (before & after).total()
    return Outcome(deed, file.name, before.total(), kept, left, abs(lost - left) + twice)


def _converted(file: CorpusFile, to: Language) -> tuple[bytes, int]:
    made = twinform.convert(file.path, to=to, paths=file.paths)
    return made.text.encode(), sum(entry.rule.name == "left-comment" for entry in made.ledger.entries)


def _in_place(file: CorpusFile, own: Language) -> tuple[bytes, int]:
    load_options = LoadOptions(search=SearchPath.of(file.paths))
    return convert_in_place(ConversionRequest(to=own), file.path, load_options).data, 0


def _language(file: CorpusFile) -> Language:
    return "urdf" if file.kind is Kind.URDF else "sdf"


SECTION = Section("comments", _ABOUT, measure)
