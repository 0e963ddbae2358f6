"""What a conversion from URDF to SDF says of differences from what libsdformat 12 makes of the URDF itself."""

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from fnmatch import fnmatchcase

import twinform
from reports.equipment.differences import Difference
from twinform.ir import Document

_RULES = {
    "unreached-shape": ("*: ?*", ""),
    "conflicting-material": ("visual: material/*", ""),
    "outside-version": ("sensor: /sensor/*", ""),
    "unnamed-material": ("*: ", "/.."),
    "missing-element": ("*: ", "/.."),
    "tiny-mass": ("*: ", "/.."),
    "massless-link": ("*: ", "/.."),
}
"""What a rule explains, as `kind: path`; `/..` where it may speak of anything in the link that the part is on."""
_GAZEBO = re.compile(r"/gazebo\[[^]]*\]")
_MAP = "material/pbr/metal/albedo_map"
_BLACK = "0 0 0 1"


@dataclass(frozen=True, slots=True)
class Said:
    """Which rules spoke, each with the path in the URDF; and where each part of the SDF was there."""

    rules: tuple[tuple[str, str], ...]
    places: Mapping[tuple[str, ...], str]

    @classmethod
    def by(cls, conversion: twinform.Conversion) -> "Said":
        """What a conversion said."""
        spoken = (*conversion.diagnostics, *conversion.ledger.entries)
        return cls(tuple((each.rule.name, each.location.path) for each in spoken), dict(_places(conversion.document)))

    def explains(self, found: Difference) -> bool:
        """Whether a finding or an entry of the ledger is about the difference."""
        what, place = f"{found.kind}: {found.path}", self.places.get((found.kind, *found.parts), "")
        for rule, path in self.rules:
            pattern, up = _RULES.get(rule, ("", ""))
            if fnmatchcase(what, pattern) and _is_in(path, place.rpartition("/")[0] if up else place):
                return True
            if rule == "gazebo-material" and _is_as_gazebo_shows_it(found):
                return True
        return False


def _places(document: Document) -> Iterator[tuple[tuple[str, ...], str]]:
    for link in document.models[0].links:
        for kind, parts in (("visual", link.visuals), ("collision", link.collisions), ("sensor", link.sensors)):
            for part in parts:
                yield (kind, str(link.name), str(part.name)), _plain(part.location.path)


def _plain(path: str) -> str:
    """A path in which a `<gazebo>` is neither counted nor described by what it refers to."""
    return _GAZEBO.sub("/gazebo", path)


def _is_in(path: str, place: str) -> bool:
    return bool(place) and f"{_plain(path)}/".startswith(f"{place}/")


def _is_as_gazebo_shows_it(found: Difference) -> bool:
    """Whether the texture is missing, or the color is divided by 0.8 and cut off at 1."""
    if found.path == _MAP:
        return not found.here
    if found.kind != "visual" or found.path not in {"material/ambient", "material/diffuse"}:
        return False
    ours, theirs = ([float(part) for part in (text or _BLACK).split()] for text in (found.there, found.here))
    return all(abs(min(1, part / 0.8) - other) < 1e-5 for part, other in zip(ours[:3], theirs[:3], strict=True))
