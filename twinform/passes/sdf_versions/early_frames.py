"""Frames in a version of SDF in which they mean nothing."""

from twinform.ir import Document, Format, Frame, bits_of, census_of, walk
from twinform.passes.sdf_versions.version_pass import known_version
from twinform.schemas import Version, parse_version

NAMED_FRAMES: Version = (1, 7)
"""Since this version a pose may name a frame."""


def has_early_frames(document: Document) -> bool:
    """Whether a document of a version before 1.7 has frames, which may stand in 1.5 and 1.6 and mean nothing there."""
    # Some files of 1.5 and 1.6 have <frame> elements in models; their meaning came with 1.7.
    early = document.format is Format.SDF and parse_version(known_version(document.version)) < NAMED_FRAMES
    if not early or not census_of(document) & bits_of(Frame):
        return False
    return any(isinstance(node, Frame) for node in walk(document))
