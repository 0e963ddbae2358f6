"""What MuJoCo and Drake make of our MJCF of one file; runs in a worker process, since both may end it."""

import twinform
from reports.same_robot.reader_verdicts import Outcome, Verdict, shown
from testbed.corpus.examine import first_error
from testbed.corpus.files import CorpusFile, Kind
from testbed.engines.readers.meshless import without_meshes as boxed
from testbed.mjcf.compiled import Compiled, UnreadableError, compile_mjcf, compile_urdf, turn_rotors, without_meshes
from testbed.mjcf.differences import differences
from testbed.mjcf.from_drake import UncomparableError, differences_from_drake
from twinform.testing.oracles import drake

URDF, MODEL, WORLD = ("URDF",), ("SDF model",), ("SDF world",)


def judge(file: CorpusFile) -> list[Outcome]:
    """What becomes of a file, as every kind that it is. No exception comes out of it."""
    if file.kind is Kind.URDF:
        return [_urdf(file)]
    is_world = b"<world" in file.path.read_bytes()
    return [_world(file) if is_world else _model(file)]


def _urdf(file: CorpusFile) -> Outcome:
    """The robot with a box for each mesh: MuJoCo would read no file without its meshes."""
    text = boxed(file.path.read_bytes())
    try:
        source = compile_urdf(text, absent_is_nothing=False)
        turn_rotors(text, source)
    except UnreadableError as error:
        return Outcome(file.name, URDF, Verdict.SOURCE, str(error))
    made = _written(file, URDF, text)
    if isinstance(made, Outcome):
        return made
    found = differences(source, made)
    if not found:
        return Outcome(file.name, URDF, Verdict.SAME)
    try:
        massless = compile_urdf(text, absent_is_nothing=True)
        turn_rotors(text, massless)
        other = differences(massless, made)
    except UnreadableError:
        other = found
    if not other:
        return Outcome(file.name, URDF, Verdict.ABSENT, shown(found))
    return Outcome(file.name, URDF, Verdict.DIFFERENT, shown(other))


def _model(file: CorpusFile) -> Outcome:
    try:
        drake.parts(file.path)
    except Exception as error:  # noqa: BLE001 - Drake has no narrower type
        return Outcome(file.name, MODEL, Verdict.SOURCE, str(error).partition("\n")[0])
    made = _written(file, MODEL)
    if isinstance(made, Outcome):
        return made
    try:
        found = differences_from_drake(file.path, made)
    except UncomparableError as error:
        return Outcome(file.name, MODEL, Verdict.TAKEN, str(error))
    return Outcome(file.name, MODEL, Verdict.DIFFERENT if found else Verdict.SAME, shown(found))


def _world(file: CorpusFile) -> Outcome:
    made = _written(file, WORLD)
    return made if isinstance(made, Outcome) else Outcome(file.name, WORLD, Verdict.TAKEN)


def _written(file: CorpusFile, kind: tuple[str], text: bytes | None = None) -> Compiled | Outcome:
    """Our MJCF, compiled without meshes: of a text, or else of the file."""
    try:
        made = twinform.convert(file.path if text is None else text, to="mjcf", paths=file.paths).text
    except twinform.CompileError as error:
        return Outcome(file.name, kind, Verdict.NOT_WRITTEN, first_error(error.diagnostics))
    try:
        return compile_mjcf(without_meshes(made))
    except UnreadableError as error:
        return Outcome(file.name, kind, Verdict.REFUSED, str(error))
