"""The versions of the formats, and the one that readers take a declaration for."""

from twinform.lazy import lazy_pattern

Version = tuple[int, int]

_VERSIONS = {
    "urdf": ("1.0", "1.1", "1.2"),
    "sdf": ("1.2", "1.3", "1.4", "1.5", "1.6", "1.7", "1.8", "1.9", "1.10", "1.11", "1.12"),
    "mjcf": ("3.3", "4.0"),
}
DEFAULT_SDF_VERSION = "1.11"
"""The version of Gazebo Harmonic, the newest long-term release, and the first that has `mimic`."""
# urdfdom reads both numbers of a version by `std::stoul`, which takes zeros and a sign in front.
_SPELT_VERSION = lazy_pattern(r"\s*\+?([0-9]{1,9})\.\s*\+?([0-9]{1,9})")
_FIRST_SDF = "1.0"
"""A version of SDF that libsdformat reads, and that it does not describe."""


def versions_of(format: str) -> tuple[str, ...]:
    """The versions of a format, from the oldest on; of MJCF, which declares none, that of MuJoCo."""
    return _VERSIONS[format]


def parse_version(text: str) -> Version:
    """Parse `1.10` to (1, 10).

    Raises:
        ValueError: it is not two whole numbers with a dot between them.
    """
    major, minor = text.split(".")
    return int(major), int(minor)


def print_version(version: Version) -> str:
    """Print a version; the inverse of `parse_version`."""
    return f"{version[0]}.{version[1]}"


def version_read(format: str, declared: str | None) -> Version:
    """The version that a file is read by: the declared one where readers know it, or else the newest."""
    return known_version(format, declared) or parse_version(versions_of(format)[-1])


def known_version(format: str, declared: str | None) -> Version | None:
    """The version that readers understand a declaration as; None where they refuse the file for it."""
    versions = versions_of(format)
    if format == "mjcf":  # which has no declaration: files are for the program
        return parse_version(versions[-1])
    if declared is None:
        return parse_version(versions[0]) if format == "urdf" else None
    if declared in versions:
        return parse_version(declared)
    if format == "sdf":
        found = versions[-1] if declared.strip() == _FIRST_SDF else declared.strip()
    else:
        spelt = _SPELT_VERSION.fullmatch(declared)
        found = f"{int(spelt[1])}.{int(spelt[2])}" if spelt else ""
    return parse_version(found) if found in versions else None
