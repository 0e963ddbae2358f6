"""Checks the names of canonical MJCF: each is unique among things of its kind, and what is referred to is there."""

from collections.abc import Collection, Iterator, Mapping

from twinform.compiler.input.mjcf.element_findings import ElementFindings
from twinform.diagnostics import nearest_name, rules
from twinform.schemas import XmlElement
from twinform.schemas.mjcf_references import ASSET_KINDS, KINDS, SECTION_KINDS, kind_of, own_references

_WORLD = "world"
_WORDS = {"geom": "geom", "hfield": "height field", "key": "keyframe", "exclude": "excluded pair"}
_REFERRED = frozenset({*KINDS.values(), *ASSET_KINDS, *SECTION_KINDS.values(), "tuple"}) - {"model"}

_MAKERS: Mapping[str, Collection[str]] = {"flexcomp": ("body",), "composite": KINDS.values()}
"""What makes parts; a `composite` is reported itself, since newer versions have none."""
_SECTIONS = frozenset({
    "asset", "worldbody", "contact", "deformable", "equality", "tendon", "actuator", "sensor", "custom",
})  # fmt: skip

Named = dict[str, dict[str, XmlElement]]
"""The named elements by kind and name."""


def check_names(root: XmlElement, findings: ElementFindings) -> Named:
    """Report names that two things of a kind have, and return the elements that have names."""
    found: Named = {kind: {} for kind in _REFERRED}
    for section, element in _named_elements(root):
        kind, name = kind_of(element, section), element.get("name")
        if kind is None or not name:
            continue
        known = found.setdefault(kind, {})
        if name in known or (kind == "body" and name == _WORLD):
            message = f"there is more than one {_WORDS.get(kind, kind)} called {name!r}"
            if name == _WORLD and kind == "body":
                message = "the world is a body called 'world', so that no other body can be called so"
            findings.report(rules.DUPLICATE_NAME, element, message, "@name", found=name)
        known.setdefault(name, element)
    return found


def check_frame_names(root: XmlElement, findings: ElementFindings) -> None:
    """Report names that two frames have, while there are frames in a tree."""
    known: set[str] = set()
    for frame in root.iter("frame"):
        name = frame.get("name")
        if name in known:
            message = f"there is more than one frame called {name!r}"
            findings.report(rules.DUPLICATE_NAME, frame, message, "@name", found=name)
        known.update([name] if name else ())


def check_references(root: XmlElement, named: Named, findings: ElementFindings) -> None:
    """Report what refers to nothing."""
    made_up: set[str] = set()  # the kinds of parts that are made, and whose names are not known here
    for tag, kinds in _MAKERS.items():
        made_up.update(kinds if next(root.iter(tag), None) is not None else ())
    sections = (section for section in root.iterchildren("*") if section.tag in _SECTIONS)  # MuJoCo skips others
    for element in (element for section in sections for element in section.iter("*")):
        for reference in own_references(element):
            kind, name = reference.kind, reference.name
            if kind not in _REFERRED or name in named[kind] or kind in made_up or (kind == "body" and name == _WORLD):
                continue
            word = _WORDS.get(kind, kind)
            near = nearest_name(name, list(named[kind]))
            hint = f"did you mean {near!r}?" if near else None
            message = f"{reference.attribute!r} of <{element.tag}> is {name!r}, and there is no {word} of that name"
            findings.report(
                rules.DANGLING_REFERENCE,
                element,
                message,
                f"@{reference.attribute}",
                found=name,
                expected=near,
                help=hint,
            )


def _named_elements(root: XmlElement) -> Iterator[tuple[str, XmlElement]]:
    """Yield all elements that may have a name of their own, with the section that they are in."""
    for section in root.iterchildren("*"):
        tag = str(section.tag)
        for element in section.iterdescendants("*") if tag == "worldbody" else section.iterchildren("*"):
            yield tag, element
