"""Small URDF files that two versions of libsdformat turned into SDF, and what we make of them."""

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import twinform
from reports.harness.known import Known
from reports.harness.sample import Sample
from testbed.corpus.examine import rules_of
from testbed.corpus.files import SHARED
from testbed.output_files import OUT, kept
from tests.oracles.probe_values import Part, lost, parsed
from twinform.schemas import XmlElement
from twinform.testing import oracles
from twinform.testing.oracles.robot_comparison import compared

PROBES = SHARED / "reference" / "probes" / "urdf"
MISSING = "there are no probes in reference/probes/urdf; TWINFORM_SHARED names the folder"
KNOWN = Known.beside(__file__)
VERSIONS = {"12": "1.9", "17": "1.12"}
"""The versions of libsdformat, and the newest SDF of each."""
_ABORTED = 128
_STATUS = re.compile(r"rc=(\d+)\s*$")


@dataclass(frozen=True, slots=True)
class Reference:
    """What a version of libsdformat made of a probe."""

    output: XmlElement | None
    status: int

    @property
    def text(self) -> str:
        """In short."""
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
        """Whether it is the same robot, as text, and why not."""
        if self.refused or not oracles.available("libsdformat"):
            return ""
        try:
            found = compared(self.path, _written(self), ("libsdformat", "libsdformat"), lumped=True)
        except oracles.EngineUnreadableError:
            return ""
        return "yes" if found else found.cause

    def _pairs(self) -> Iterator[tuple[XmlElement, XmlElement]]:
        for version, reference in self.references.items():
            ours = parsed(self.outputs.get(version, b""))
            if reference.output is not None and ours is not None:
                yield reference.output, ours


def probes(sample: Sample) -> list[Probe]:
    """The chosen probes, converted."""
    return [_converted(path) for path in sample.of(sorted(PROBES.glob("*.urdf")))]


def unexplained(probe: Probe) -> list[str]:
    """The differences of a probe that nobody has explained."""
    found = [f"{probe.name}: nowhere in ours: {part}" for part in probe.lost if not _reason(part)]
    differs = _kinds(probe)
    return [*found, f"{probe.name}: {'; '.join(differs)}"] if differs and not _own(probe) else found


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


def _own(probe: Probe) -> str:
    return KNOWN.why("probes", probe.name)


def _reason(part: Part) -> str:
    return KNOWN.why("values", str(part))


def _converted(path: Path) -> Probe:
    try:
        outputs = {version: twinform.convert(path, to="sdf", sdf_version=sdf) for version, sdf in VERSIONS.items()}
    except twinform.CompileError as error:
        return Probe(path, {}, rules_of(error.diagnostics))
    return Probe(path, {version: output.text.encode() for version, output in outputs.items()}, ())


def _reference(path: Path, version: str) -> Reference:
    output = path.with_name(f"{path.stem}.libsdformat{version}.sdf")
    printed = path.with_name(f"{path.stem}.libsdformat{version}.err").read_text(encoding="utf-8", errors="replace")
    status = _STATUS.search(printed)
    root = parsed(output.read_bytes()) if output.is_file() else None
    return Reference(root, int(status[1]) if status else 0)


def _bodies(root: XmlElement) -> set[str]:
    # children of models alone, since carriers have links and joints in them too
    return {part.get("name", "") for kind in ("link", "joint") for part in root.iterfind(f".//model/{kind}")}


def _written(probe: Probe) -> Path:
    return kept(OUT / "probes" / f"{probe.name}.sdf", probe.outputs["12"].decode())
