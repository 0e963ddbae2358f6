"""Do all loaders take a file that was converted with `--for portable`? Every readable URDF, before and after."""

import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import twinform
from reports.harness.known import Known, contains
from reports.harness.sample import Sample
from reports.harness.section import UNEXPLAINED, Findings, Section
from reports.who_reads_it.loader_verdicts import recalled
from reports.who_reads_it.loaders import absent
from testbed.corpus.files import CorpusFile, Kind
from testbed.engines.readers import USUAL
from testbed.engines.readers.meshless import without_meshes
from testbed.markdown import listing, subsection, table
from testbed.output_files import OUT, kept
from twinform.compiler.conversion import convert_once
from twinform.compiler.fitting import assessed, fitted
from twinform.compiler.input.load_options import LoadOptions
from twinform.compiler.request import ConversionRequest
from twinform.profiles import findings, parse

KNOWN = Known.beside(__file__, contains)
_SECONDS = 600
_LONGEST = 200
_ABOUT = """\
A URDF of the corpus is *readable* where `twinform check` finds no error in it: what it cannot read, nothing can
convert. Each is read by every loader, as it is and as it is after

    twinform convert FILE --for portable --to urdf

with a box of 0.1 m for each mesh, in the text of the file, since the corpus has no meshes. A loader takes a file where
it neither throws nor crashes nor returns nothing; how each is asked is
[above](#what-loaders-do-and-what-their-profiles-say). Every refusal that is left has its cause, by message
(`reports/who_reads_it/portable.toml`); one without fails the command.

Where a consumer would still refuse the result, the command ends with an error that says so, and writes nothing. Here
the loaders are asked about what it would have written, and whether it was right."""


@dataclass(frozen=True, slots=True)
class Refusal:
    """What a loader says about a converted file that it does not take."""

    loader: str
    message: str


@dataclass(frozen=True, slots=True)
class Carried:
    """A readable file: who takes it before and after, why not, the passes, and whether the command `told` of it."""

    name: str
    before: frozenset[str]
    after: frozenset[str]
    refusals: tuple[Refusal, ...]
    passes: str
    told: bool = False


def measure(sample: Sample) -> Findings:
    """Convert, and ask all loaders."""
    asked = [loader.profile for loader in USUAL if loader.reader.present()]
    found = sample.outcomes(carried, sample.models(Kind.URDF), _never, seconds=_SECONDS)
    causes = [
        (one.name, each, KNOWN.why("refusal", loader=each.loader, message=each.message))
        for one in found
        for each in one.refusals
    ]
    faults = [f"{name}: {each.loader}: {each.message}" for name, each, why in causes if not why]
    counts = _counts(found, asked)
    left = Counter((each.loader, why or f"{UNEXPLAINED}: {each.message}") for _, each, why in causes)
    rows = ((count, *key) for key, count in sorted(left.items(), key=lambda item: (-item[1], item[0])))
    passes = Counter(step for one in found for step in re.findall(r"[a-z][a-z-]+(?=[,{]|$)", one.passes))
    return Findings(
        [
            subsection("Who takes the files", counts),
            subsection("Refusals that are left", listing(["files", "loader", "cause"], rows)),
            subsection("Passes that were appended", listing(["pass", "files"], passes.most_common())),
            absent(),
        ],
        counts,
        faults,
    )


def carried(file: CorpusFile) -> Carried | None:
    """What becomes of a file; None where it is not readable."""
    folder = OUT / "portable" / Path(file.name).parent
    before = kept(folder / f"{file.path.stem}.urdf", without_meshes(file.path.read_bytes()))
    if any(each.is_error for each in twinform.check(before).diagnostics):
        return None
    taken = frozenset(
        loader.profile for loader in USUAL if loader.reader.present() and recalled().ask(loader.reader, before).ok
    )
    options = LoadOptions(tolerant=True, profiles=parse("portable"))
    request = ConversionRequest(to="urdf")
    try:
        request = fitted(request, before, options)
        made = convert_once(request, before, options)
    except twinform.CompileError as error:
        refusal = Refusal("twinform", str(error)[:_LONGEST])
        return Carried(file.name, taken, frozenset(), (refusal,), str(request.remedies), told=True)
    after = kept(folder / f"{file.path.stem}.portable.urdf", made.text)
    told = any(each.is_error for each in findings(assessed(made, options, file.name)))
    pipeline = str(request.remedies)
    readings = [(loader.profile, recalled().ask(loader.reader, after)) for loader in USUAL if loader.reader.present()]
    refusals = (Refusal(name, reading.error[:_LONGEST]) for name, reading in readings if not reading.ok)
    accepted = frozenset(name for name, reading in readings if reading.ok)
    return Carried(file.name, taken, accepted, tuple(refusals), pipeline, told=told)


def _never(file: CorpusFile, cause: str) -> Carried:
    return Carried(file.name, frozenset(), frozenset(), (Refusal("twinform", cause),), "", told=True)


def _counts(found: Sequence[Carried], asked: Sequence[str]) -> str:
    every = frozenset(asked)
    rows = [(name, sum(name in one.before for one in found), sum(name in one.after for one in found)) for name in asked]
    whole = ("all of them", sum(one.before >= every for one in found), sum(one.after >= every for one in found))
    share = ("of all files", *(f"{100 * count / max(1, len(found)):.1f}%" for count in whole[1:]))
    silent = sum(not one.told and bool(one.refusals) for one in found)
    needless = sum(one.told and not one.refusals for one in found)
    told_of = sum(one.told for one in found)
    errors = f"The command ends with an error for {told_of} of them; for {needless} of these all take"
    told = f"{errors} the result. It says nothing of {silent} that a loader refuses."
    return f"{len(found)} files. {told}\n\n{table(['loader', 'before', 'after'], [*rows, whole, share])}"


SECTION = Section("portable", _ABOUT, measure, known=KNOWN)
