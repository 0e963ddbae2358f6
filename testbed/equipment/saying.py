"""What a conversion from URDF to SDF says of differences from what libsdformat 12 makes of the URDF itself."""

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from fnmatch import fnmatchcase

import twinform
from testbed.equipment.differences import Difference
from twinform.ir import Document
from twinform.passes.structure.gazebo_blocks import BODY_FLAGS

_RULES = {
    "unreached-shape": ("*: ?*", ""),
    "conflicting-material": ("visual: material/*", ""),
    "gazebo-conflict": ("visual: material/*", ""),
    "outside-version": ("sensor: /sensor/*", ""),
    "unnamed-material": ("*: ", "/.."),
    "missing-element": ("*: ", "/.."),
    "tiny-mass": ("*: ", "/.."),
    "massless-link": ("*", "below"),
}
"""What a rule explains, as `kind: path`: in the part that it speaks of, with `/..` also where that is another one of
the link, or with `below` in the link and all links that it holds."""
_GAZEBO = re.compile(r"/gazebo\[[^]]*\]")
_MAP = "material/pbr/metal/albedo_map"
_BLACK = "0 0 0 1"


@dataclass(frozen=True, slots=True)
class Said:
    """Which rules spoke, each with the path in the URDF; where each part of the SDF was there; what holds a link."""

    rules: tuple[tuple[str, str], ...]
    places: Mapping[tuple[str, ...], str]
    above: Mapping[str, str]

    @classmethod
    def by(cls, conversion: twinform.Conversion) -> "Said":
        """What a conversion said."""
        spoken = (*conversion.diagnostics, *conversion.ledger.entries)
        said = tuple((each.rule.name, each.location.path) for each in spoken)
        above = {joint.child or "": joint.parent or "" for joint in conversion.document.models[0].joints}
        return cls(said, dict(_places(conversion.document)), above)

    def explains(self, found: Difference) -> bool:
        """Whether a finding or an entry of the ledger is about the difference."""
        what, place = f"{found.kind}: {found.path}", self.places.get((found.kind, *found.parts), "")
        link = place.rpartition("/")[0]
        places = {"": (place,), "/..": (link,), "below": self._holding(found.parts[0]) if found.parts else ()}
        for rule, path in self.rules:
            pattern, about = _RULES.get(rule, ("", ""))
            if fnmatchcase(what, pattern) and any(_is_in(path, each) for each in places[about]):
                return True
            if rule == "gazebo-material" and _is_as_gazebo_shows_it(found):
                return True
            if rule == "early-static" and what == "model: static":
                return True
            if rule == "lumped-flag" and _is_set_by(path.rpartition("/")[2], found):
                return True
        return False

    def _holding(self, link: str) -> tuple[str, ...]:
        """Where the link is in the URDF, and all links that hold it."""
        held = list[str]()
        while link in self.above:
            held.append(link)
            link = self.above[link]
        return tuple(self.places.get(("link", each), "") for each in (*held, link))


def _places(document: Document) -> Iterator[tuple[tuple[str, ...], str]]:
    for link in document.models[0].links:
        yield ("link", str(link.name)), _without_details(link.location.path)
        for kind, parts in (("visual", link.visuals), ("collision", link.collisions), ("sensor", link.sensors)):
            for part in parts:
                for each in (kind, "plugin"):
                    yield (each, str(link.name), str(part.name)), _without_details(part.location.path)


def _without_details(path: str) -> str:
    """A path in which a `<gazebo>` is neither counted nor described by what it refers to."""
    return _GAZEBO.sub("/gazebo", path)


def _is_in(path: str, place: str) -> bool:
    return bool(place) and f"{_without_details(path)}/".startswith(f"{place}/")


def _is_set_by(tag: str, found: Difference) -> bool:
    """Whether a tag is about the flag of a link that differs."""
    return found.kind == "link" and found.path.partition("/")[0] == BODY_FLAGS.get(tag)


def _is_as_gazebo_shows_it(found: Difference) -> bool:
    """Whether the texture is missing, or the color is divided by 0.8 and cut off at 1."""
    if found.path == _MAP:
        return not found.here
    if found.kind != "visual" or found.path not in {"material/ambient", "material/diffuse"}:
        return False
    ours, theirs = ([float(part) for part in (text or _BLACK).split()] for text in (found.there, found.here))
    return all(abs(min(1, part / 0.8) - other) < 1e-5 for part, other in zip(ours[:3], theirs[:3], strict=True))
