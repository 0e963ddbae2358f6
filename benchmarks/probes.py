"""Small URDF files that two versions of libsdformat turned into SDF, and what we do: `make probes`."""

import re
import sys
import tomllib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from fnmatch import fnmatchcase
from functools import cached_property
from pathlib import Path

import twinform
from benchmarks.markdown import table, write
from benchmarks.probe_values import Part, XmlElement, lost, parsed
from tests.corpus.files import ROOT, SHARED
from twinform.testing import oracles
from twinform.testing.oracles.looking import compared

PROBES = SHARED / "reference" / "probes" / "urdf"
MISSING = "there are no probes in reference/probes/urdf; TWINFORM_SHARED says where that is"
PAGE = ROOT / "docs" / "reference" / "probes.md"
KNOWN = Path(__file__).with_name("probes_known.toml")
OUT = ROOT / "out" / "probes"
VERSIONS = {"12": "1.9", "17": "1.12"}
"""The versions of libsdformat, and the newest SDF of each."""
_ABORTED = 128
_STATUS = re.compile(r"rc=(\d+)\s*$")
_INTRODUCTION = """# Probes

Made by `make probes`.

Small URDF files, each about one thing, that libsdformat 12 and 17 turned into SDF. *Only theirs* counts the names and
values of their SDF that are nowhere in ours: no element or attribute of that name has that value, wherever it is,
carriers included. Poses and inertias are not among them, since lumping computes them anew; for these, *same robot* is
the verdict of libsdformat 12 on the URDF file and our SDF 1.9, links that are fixed to each other weighed together.
*Only ours* counts links and joints.

Every difference has its explanation: no value of a file that they keep is lost here."""


@dataclass(frozen=True, slots=True)
class Reference:
    """What a version of libsdformat made of a probe."""

    output: XmlElement | None
    status: int

    @property
    def text(self) -> str:
        """In words."""
        if self.status >= _ABORTED:
            return "crash"
        done = "refused" if self.output is None else "converted"
        return done if self.output is None or not self.status else f"{done}, with errors"


@dataclass(frozen=True)
class Probe:
    """A probe and what became of it: our SDF by version, or the rules that it breaks."""

    path: Path
    outputs: Mapping[str, bytes]
    refused: tuple[str, ...]

    @property
    def name(self) -> str:
        """Its number and subject."""
        return self.path.stem

    @cached_property
    def references(self) -> dict[str, Reference]:
        """What each version of libsdformat made of it."""
        return {version: _reference(self.path, version) for version in VERSIONS}

    @cached_property
    def lost(self) -> list[Part]:
        """What is in theirs and not in ours."""
        return list(dict.fromkeys(part for theirs, ours in self._pairs() for part in lost(theirs, ours)))

    @cached_property
    def more(self) -> list[str]:
        """Links and joints that are in ours and not in theirs."""
        found = (_bodies(ours) - _bodies(theirs) for theirs, ours in self._pairs())
        return sorted(set[str]().union(*found))

    @cached_property
    def robot(self) -> str:
        """Whether it is the same robot, in words, and why not."""
        if self.refused or not oracles.available("libsdformat"):
            return ""
        try:
            found = compared(self.path, _written(self), ("libsdformat", "libsdformat"), lumped=True)
        except oracles.UnreadableError:
            return ""
        return "yes" if found else found.cause

    def _pairs(self) -> Iterator[tuple[XmlElement, XmlElement]]:
        for version, reference in self.references.items():
            ours = parsed(self.outputs.get(version, b""))
            if reference.output is not None and ours is not None:
                yield reference.output, ours


def main() -> int:
    """Convert, compare, write the page, and fail where a difference has no explanation."""
    if not PROBES.is_dir():
        print(MISSING, file=sys.stderr)
        return 1
    found = probes()
    known = tomllib.loads(KNOWN.read_text(encoding="utf-8"))
    write(PAGE, _INTRODUCTION, table(_HEAD, (_row(probe, known) for probe in found)))
    failures = [failure for probe in found for failure in unexplained(probe, known)]
    print(f"{len(found)} probes, written to {PAGE.relative_to(ROOT)}")
    print(*failures, sep="\n", file=sys.stderr)
    return 1 if failures else 0


def probes(every: int = 1) -> list[Probe]:
    """All probes, or each so many-th, converted."""
    return [_converted(path) for path in sorted(PROBES.glob("*.urdf"))[::every]]


def unexplained(probe: Probe, known: Mapping[str, Mapping[str, str]]) -> list[str]:
    """The differences of a probe that nobody has explained, and an explanation of what is no difference."""
    own = probe.name in known["probes"]
    found = [f"{probe.name}: nowhere in ours: {part}" for part in probe.lost if not _reason(part, known)]
    differs = bool(_kinds(probe))
    if differs and not own:
        found.append(f"{probe.name}: {'; '.join(_kinds(probe))}")
    if own and not differs:
        found.append(f"{probe.name}: there is an explanation, and nothing to explain")
    return found


def _kinds(probe: Probe) -> list[str]:
    """The differences that need an explanation of their own."""
    kinds: list[str] = []
    verdicts = {reference.text for reference in probe.references.values()}
    ours = "refused" if probe.refused else "converted"
    if verdicts != {ours}:
        kinds.append(f"{ours}, and with them {' or '.join(sorted(verdicts))}")
    if probe.more and not _is_lumped(probe):
        kinds.append(f"only ours: {', '.join(probe.more)}")
    if probe.robot not in {"", "yes"}:
        kinds.append(f"another robot: {probe.robot}")
    return kinds


def _is_lumped(probe: Probe) -> bool:
    """Whether what they lack are fixed joints and their children, which they lump."""
    root = parsed(probe.outputs["12"])
    assert root is not None
    fixed = [joint for joint in root.iter("joint") if joint.get("type") == "fixed"]
    names = {joint.get("name", "") for joint in fixed} | {joint.findtext("child", "") for joint in fixed}
    return set(probe.more) <= names


_HEAD = ["probe", "ours", "libsdformat 12", "libsdformat 17", "only theirs", "only ours", "same robot", "explanation"]


def _row(probe: Probe, known: Mapping[str, Mapping[str, str]]) -> tuple[object, ...]:
    ours = f"refused: {', '.join(probe.refused)}" if probe.refused else "converted"
    verdicts = [reference.text for reference in probe.references.values()]
    robot = probe.robot if probe.robot in {"", "yes"} else "no"
    return (
        probe.name,
        ours,
        *verdicts,
        len(probe.lost),
        len(probe.more),
        robot,
        "; ".join(_explanations(probe, known)),
    )


def _explanations(probe: Probe, known: Mapping[str, Mapping[str, str]]) -> list[str]:
    own = [known["probes"][probe.name]] if probe.name in known["probes"] else []
    lumped = ["they lump what is fixed, it stays with us"] if probe.more and _is_lumped(probe) else []
    return list(dict.fromkeys([*own, *lumped, *(_reason(part, known) for part in probe.lost)]))


def _reason(part: Part, known: Mapping[str, Mapping[str, str]]) -> str:
    return next((why for pattern, why in known["values"].items() if fnmatchcase(str(part), pattern)), "")


def _converted(path: Path) -> Probe:
    try:
        outputs = {version: twinform.convert(path, to="sdf", sdf_version=sdf) for version, sdf in VERSIONS.items()}
    except twinform.CompileError as error:
        rules = dict.fromkeys(found.rule.name for found in error.diagnostics if found.is_error)
        return Probe(path, {}, tuple(rules))
    return Probe(path, {version: output.text.encode() for version, output in outputs.items()}, ())


def _reference(path: Path, version: str) -> Reference:
    output = path.with_name(f"{path.stem}.libsdformat{version}.sdf")
    said = path.with_name(f"{path.stem}.libsdformat{version}.err").read_text(encoding="utf-8", errors="replace")
    status = _STATUS.search(said)
    root = parsed(output.read_bytes()) if output.is_file() else None
    return Reference(root, int(status[1]) if status else 0)


def _bodies(root: XmlElement) -> set[str]:
    # children of models alone, since carriers have links and joints in them too
    return {part.get("name", "") for kind in ("link", "joint") for part in root.iterfind(f".//model/{kind}")}


def _written(probe: Probe) -> Path:
    output = OUT / f"{probe.name}.sdf"
    output.parent.mkdir(parents=True, exist_ok=True)
    output.write_bytes(probe.outputs["12"])
    return output


if __name__ == "__main__":
    sys.exit(main())
