"""Where the time of a conversion goes: a sample of the stack at each tick of the CPU clock, counted by folder and file.

Nothing is taken apart or called in another order: what is sampled is `twinform.convert`. A sample weighs the CPU time
since the one before, since a call into C, such as that of an XSD, delays the ticks that fall into it to its end.
"""

import signal
import time
from collections import defaultdict
from collections.abc import Generator, Iterable, Mapping, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from types import FrameType

import twinform
from testbed.markdown import paragraphs, subsection, table
from twinform.request_options import Language

TICK = 0.001
"""In seconds; a kernel makes four of it."""
ENOUGH = 8.0
"""So many seconds of a conversion are sampled, or all files once."""
_PACKAGE = f"{Path(twinform.__file__).parent}/"
_PYDANTIC = "/pydantic/"
_STAGES: Sequence[tuple[str, tuple[str, ...]]] = (
    ("XSD of the output", ("compiler/output/", "schemas/validator.py")),
    ("XSD of the input", ("schemas/validator.py",)),
    ("verify the input", ("compiler/input/", "ir/verify/")),
    ("verify the result", ("ir/verify/",)),
    ("passes", ("passes/",)),
    ("write", ("compiler/output/",)),
    ("parse", ("compiler/input/parsing.py",)),
    ("Pydantic", ("compiler/input/", _PYDANTIC)),
    ("read", ("compiler/input/",)),
)
"""Each stage, and what has to be on the stack: the first one for which all is."""
REST = "rest"
_ORDER = (
    *("parse", "XSD of the input", "read", "Pydantic", "verify the input", "passes", "verify the result"),
    *("write", "XSD of the output", REST),
)
_ABOUT = """\
The stack of `twinform.convert` sampled at ticks of the CPU clock. *Read* is what makes the IR of the XML tree: facts
tables, values, lowering; *write* is the back end, with the text. A stage below 1 % is within the noise."""


def stage_of(places: Iterable[str]) -> str:
    """The stage of a stack, which is given by the files of its frames, those of the package relative to it."""
    stack = list(places)
    for stage, wanted in _STAGES:
        if all(any(_is_in(place, want) for place in stack) for want in wanted):
            return stage
    return REST


def _is_in(place: str, want: str) -> bool:
    return want in place if want is _PYDANTIC else place.startswith(want)


@contextmanager
def sampled(seconds: dict[str, float]) -> Generator[None]:
    """Count the CPU time of what happens inside, by stage."""
    before = time.process_time()

    def tick(_number: int, frame: FrameType | None) -> None:
        nonlocal before
        now = time.process_time()
        seconds[stage_of(_places(frame))] += now - before
        before = time.process_time()

    previous = signal.signal(signal.SIGPROF, tick)
    signal.setitimer(signal.ITIMER_PROF, TICK, TICK)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, previous)


def _places(frame: FrameType | None) -> Generator[str]:
    while frame is not None:
        yield frame.f_code.co_filename.removeprefix(_PACKAGE)
        frame = frame.f_back


def profile(paths: Sequence[Path], to: Language) -> Mapping[str, float]:
    """The seconds of each stage of one conversion of each file."""
    seconds: dict[str, float] = defaultdict(float)
    _convert(paths[:1], to)  # reads tables and schemas
    start, runs = time.process_time(), 0
    with sampled(seconds):
        while not runs or time.process_time() - start < ENOUGH:
            _convert(paths, to)
            runs += 1
    return {stage: value / runs for stage, value in seconds.items()}


def _convert(paths: Iterable[Path], to: Language) -> None:
    for path in paths:
        with suppress(twinform.CompileError):
            twinform.convert(path, to=to)


def page(profiles: Mapping[str, Mapping[str, float]]) -> str:
    """The section with a column for each profile."""
    wholes = [sum(seconds.values()) for seconds in profiles.values()]
    rows = [
        (
            stage,
            *(_cell(seconds.get(stage, 0), whole) for seconds, whole in zip(profiles.values(), wholes, strict=True)),
        )
        for stage in _ORDER
    ]
    rows.append(("all", *(f"{whole * 1e3:,.0f} ms" for whole in wholes)))
    return subsection("Where the time goes", paragraphs(_ABOUT, table(["stage", *profiles], rows)))


def _cell(seconds: float, whole: float) -> str:
    return f"{seconds * 1e3:,.0f} ms ({seconds / whole:.0%})" if whole else ""
