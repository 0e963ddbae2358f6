"""Classes of defaults in MJCF that is written: what most geoms, joints, sites, meshes and materials say alike, once."""

from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import ClassVar

from twinform.diagnostics import DiagnosticSink
from twinform.ir import Document, Element, Format, Opaque
from twinform.passes.framework.pass_base import Pass
from twinform.passes.legalise.to_mjcf.elements import make_element

_SEEN, _TOUCHED = "visual", "collision"
_SECTIONS: Mapping[str, str] = {"joint": "worldbody", "site": "worldbody", "mesh": "asset", "material": "asset"}
"""The elements whose defaults are of the class `main`, which has no name in a file, and where they stand."""
_OF_ONE_ALONE = frozenset({
    "name", "class", "pos", "quat", "size", "range", "actuatorfrcrange", "ref", "user", "mesh", "hfield", "texture",
})  # fmt: skip
"""What an element says of itself, also where several say the same by chance."""
_OF_MESHES = frozenset({"scale", "inertia", "maxhullvert"})
"""What a class can say of meshes."""

Values = dict[str, str]


class FactorDefaults(Pass):
    """Write what many elements of MJCF say alike into classes of defaults.

    Changes: an attribute that all geoms of one kind have, and most of them with the same value, stands in the class
    `visual` or `collision`; of joints, sites, meshes and materials it stands in the class of all. Elements whose value
    is another one keep it.
    Never touches: names, places, sizes and ranges; attributes that not all have, since a default would give them to the
    others, too; a file that has classes.
    Diagnostics: none.
    """

    name: ClassVar[str] = "factor-defaults"

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document with classes."""
        sections = [each.element for each in document.opaque if each.element is not None]
        if sink.has_errors or document.format is not Format.MJCF or any(each.name == "default" for each in sections):
            return document
        classes = {name: _alike(group) for name, group in _geoms(sections).items()}
        main = {tag: _alike(list(_all_of(tag, sections))) for tag in _SECTIONS}
        if next(_all_of("flexcomp", sections), None) is not None:
            del main["joint"]  # it makes joints, which would take the values of the class
        defaults = [make_element(tag, values.items()) for tag, values in main.items() if values]
        defaults += [
            make_element("default", [("class", name)], [make_element("geom", values.items())])
            for name, values in classes.items()
            if values
        ]
        if not defaults:
            return document
        written = [_rewritten(each, lambda element: _without(element, main, classes)) for each in sections]
        at = next(number for number, each in enumerate(written) if each.name not in _BEFORE)
        written.insert(at, make_element("default", (), defaults))
        attributes = [each for each in document.opaque if each.element is None]
        return document.copy(opaque=(*attributes, *(Opaque.unchecked(element=each) for each in written)))


_BEFORE = frozenset({"compiler", "option", "size", "visual", "statistic"})


def _geoms(sections: Sequence[Element]) -> dict[str, list[Element]]:
    found: dict[str, list[Element]] = {_SEEN: [], _TOUCHED: []}
    for geom in _all_of("geom", sections):
        found[_class_of(geom)].append(geom)
    return found


def _class_of(geom: Element) -> str:
    says = dict(geom.attributes)
    return _SEEN if says.get("contype") == says.get("conaffinity") == "0" else _TOUCHED


def _all_of(tag: str, sections: Sequence[Element]) -> Iterator[Element]:
    section = _SECTIONS.get(tag, "worldbody")
    waiting = [each for each in sections if each.name == section]
    while waiting:
        here = waiting.pop()
        if here.name == tag:
            yield here
        waiting += here.children if here.name in {section, "body"} else ()


def _alike(elements: Sequence[Element]) -> Values:
    """Return what all elements say, and most of them alike.

    A list of numbers that is shorter than that of the class would be filled up from it, so that all have one length.
    """
    found: Values = {}
    says = [dict(each.attributes) for each in elements]
    for name in says[0] if len(says) > 1 else ():
        if name in _OF_ONE_ALONE or (elements[0].name == "mesh" and name not in _OF_MESHES):
            continue
        values = [each[name] for each in says if name in each]
        value, count = Counter(values).most_common(1)[0]
        if len(values) == len(says) < 2 * count and len({len(each.split()) for each in values}) == 1:
            found[name] = value
    return found


def _without(element: Element, main: Mapping[str, Values], classes: Mapping[str, Values]) -> Element:
    """Return an element without what its class says."""
    if element.name == "geom":
        name = _class_of(element)
        values = classes[name]
        own = (("class", name),) if values else ()
    else:
        values, own = main.get(element.name, {}), ()
    left = tuple(pair for pair in element.attributes if values.get(pair[0]) != pair[1])
    if len(left) == len(element.attributes) and not own:
        return element
    at = 1 if left and left[0][0] == "name" else 0
    return element.copy(attributes=(*left[:at], *own, *left[at:]))


def _rewritten(section: Element, change: Callable[[Element], Element]) -> Element:
    """Return a section with the elements changed that have defaults; tendons and others name joints and sites, too."""
    if section.name not in {"worldbody", "asset", "body"}:
        return section
    return section.copy(children=tuple(_rewritten(change(each), change) for each in section.children))
