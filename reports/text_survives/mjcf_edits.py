"""Is what stands in a file what counts, where MJCF is one of the languages? Edits of converted files."""

from collections.abc import Iterator

from reports.harness.sample import Sample
from reports.harness.section import Findings, Section
from reports.text_survives.edit_jobs import Job
from reports.text_survives.edits import generated, measured
from testbed.corpus.files import Kind, models
from testbed.edits.edited_file import Language
from testbed.mjcf.canonical_models import CASES, PACKAGES, package_files

_EDITS = 8
_MODELS, _EDITS_OF_MODELS = 200, 12
_OTHERS: tuple[Language, ...] = ("urdf", "sdf")
ABOUT = """\
As in [edits](#edits-win), with MJCF: URDF and SDF are converted to MJCF, edited there and converted back, and files of
MJCF (our cases, and those of `make mjcf`) are converted to URDF and to SDF, edited there and converted back. MuJoCo,
which reads no carriers, has to see one robot in the edited MJCF and in what its result becomes again, and in an edited
URDF and its result; for SDF it is Drake that reads the edited file. `twinform diff` is the second judge. What no engine
reads or what differs before an edit is left to `diff`, and counted below."""


def measure(sample: Sample) -> Findings:
    """Edit, convert, and compare."""
    return measured(sample, sample.of(_jobs(sample)))


def _jobs(sample: Sample) -> Iterator[Job]:
    for file in models():
        language = "urdf" if file.kind is Kind.URDF else "sdf"
        yield Job(file.name, file.path, file.paths, language, "mjcf", sample.seed, _EDITS)
    yield from generated(sample, "mjcf", _MODELS, _EDITS_OF_MODELS)
    for path in [*sorted(CASES.glob("*.mjcf")), *sorted((CASES.parent / "from_mjcf").glob("*.mjcf")), *package_files()]:
        name = str(path.relative_to(PACKAGES if path.is_relative_to(PACKAGES) else CASES.parents[2]))
        for edited in _OTHERS:
            yield Job(name, path, (PACKAGES,), "mjcf", edited, sample.seed, _EDITS)


SECTION = Section("mjcf_edits", ABOUT, measure)
