"""Finds what a file of MJCF has of a node: its geom, the assets of that, and the elements that a sensor became."""

from collections import defaultdict
from functools import cached_property

from twinform.ir import Element, Light, Sensor
from twinform.passes.legalise.to_mjcf.writing_context import MjcfContext

_SHOWN = frozenset({"camera", "light"})
"""Elements in bodies that sensors and lights become."""


class WrittenElements:
    """The elements of one file, whose other sections than `custom` are complete."""

    def __init__(self, context: MjcfContext) -> None:
        self.sections = context.sections

    @cached_property
    def geoms(self) -> dict[str, Element]:
        """The geoms by their names."""
        return {each.get("name") or "": each for each in self._in_bodies if each.name == "geom"}

    def asset(self, tag: str, name: str | None) -> Element | None:
        """The asset of a name, such as a mesh or a material."""
        return self._assets.get((tag, name))

    def file_of(self, geom: Element) -> str | None:
        """The file of the mesh or height field of a geom."""
        assets = (self.asset(kind, name) for kind in ("mesh", "hfield") if (name := geom.get(kind)))
        return next((each.get("file") for each in assets if each is not None), None)

    def parts_of(self, part: Sensor | Light) -> list[Element]:
        """The elements that a sensor or light has become: readings, and then cameras, lights and sites."""
        readings = self._readings.get(id(part.source), [])
        sites = {each.get("site") or each.get("objname") for each in readings}
        places = [
            *self._shown.get(id(part.source), ()),
            *(place for name in sites for place in self._sites.get(name, ())),
        ]
        return [*readings, *(self._in_bodies[place] for place in sorted(places))]

    @cached_property
    def _in_bodies(self) -> list[Element]:
        """All elements of the world and its bodies."""
        return [each for body in self.sections.get("worldbody", ()) for each in body.walk()]

    @cached_property
    def _assets(self) -> dict[tuple[str, str | None], Element]:
        return {(each.name, each.get("name")): each for each in reversed(self.sections.get("asset", ()))}

    @cached_property
    def _readings(self) -> dict[int, list[Element]]:
        """The elements of the `sensor` section by the identity of what they were made from."""
        found: dict[int, list[Element]] = defaultdict(list)
        for each in self.sections.get("sensor", ()):
            found[id(each.source)].append(each)
        return found

    @cached_property
    def _shown(self) -> dict[int, list[int]]:
        """The places of cameras and lights in the bodies by the identity of what they were made from."""
        found: dict[int, list[int]] = defaultdict(list)
        for place, each in enumerate(self._in_bodies):
            if each.name in _SHOWN:
                found[id(each.source)].append(place)
        return found

    @cached_property
    def _sites(self) -> dict[str | None, list[int]]:
        """The places of sites in the bodies by their names."""
        found: dict[str | None, list[int]] = defaultdict(list)
        for place, each in enumerate(self._in_bodies):
            if each.name == "site":
                found[each.get("name")].append(place)
        return found
