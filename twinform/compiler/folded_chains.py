"""Chains of joints that fold back, and the names and numbers that change with them in a reverse conversion."""

from collections.abc import Collection, Iterator
from dataclasses import dataclass
from typing import Self

from twinform.ir.defaults import UNLIMITED
from twinform.ir.frames import MODEL
from twinform.passes.carriers.annotations import MIMIC, SYNTHESIZED
from twinform.passes.carriers.carriers import NAMESPACE
from twinform.passes.carriers.joint_chains import CHAIN, PART
from twinform.passes.carriers.token_mass import TOKEN_MASS
from twinform.passes.legalise.changed_names import NAME, SCOPED_NAME
from twinform.passes.legalise.to_sdf.root_masses import UNSAID
from twinform.passes.shared.gearboxes import GEARED
from twinform.passes.shared.link_shapes import COMPUTED_MASS
from twinform.schemas import XmlElement
from twinform.schemas.value_types import format_number

_OURS = f"{{{NAMESPACE}}}"
_CHAIN, _PART, _MADE, _GEARED, _URDF = (f"{_OURS}{word}" for word in (CHAIN, PART, SYNTHESIZED, GEARED, "urdf"))
_OLD_NAMES = tuple(f"{_OURS}{word}" for word in (NAME, SCOPED_NAME))
_UNSAID = f"{_OURS}{UNSAID}"
_MIMIC = f"{_OURS}{MIMIC}"
_COMPUTED_MASS = f"{_OURS}{COMPUTED_MASS}"
# The mass in SDF of a link that has none in URDF.
_TOKEN_MASS = format_number(TOKEN_MASS)
_NAMED = ("link", "joint", "frame", "model", "visual", "collision")


@dataclass(frozen=True, slots=True)
class Folded:
    """What a result has otherwise, because annotations in the source tell what it was made of.

    `there` has the tag, name and type of each part of the result, and `named` tag and name; `parts` are the names of
    what is gone from it, `followers` the joints that mimic in it, and `ends` those that chains have become.
    """

    there: frozenset[tuple[str, str, str]] = frozenset()
    named: frozenset[tuple[str, str]] = frozenset()
    parts: frozenset[str] = frozenset()
    followers: frozenset[str] = frozenset()
    ends: frozenset[str] = frozenset()

    @classmethod
    def of(cls, source: XmlElement, result: XmlElement) -> Self:
        """Find what differs between two trees because the second folds chains of the first."""
        found = [each for tag in _NAMED for each in result.iter(tag)]
        there = frozenset((str(each.tag), each.get("name", ""), each.get("type", "")) for each in found)
        named = frozenset((tag, name) for tag, name, _ in there)
        followers = frozenset(each.get("name", "") for each in found if next(each.iter("mimic"), None) is not None)
        chains = ((annotation.getparent(), annotation.get("type", "")) for annotation in source.iter(_CHAIN))
        ends = frozenset(
            name for end, kind in chains if end is not None and ("joint", name := end.get("name", ""), kind) in there
        )
        folded = cls(there, named, frozenset(), followers, ends)
        annotations = [annotation.getparent() for word in (_PART, _MADE) for annotation in source.iter(word)]
        gone = {each.get("name", "") for each in annotations if each is not None and folded.is_gone(each)}
        return cls(there, named, frozenset(gone | set(_synthesized_names(source, result, named))), followers, ends)

    def expresses(self, element: XmlElement, attribute: str | None) -> bool:
        """Whether the result expresses a part of the source otherwise, such as by one joint for several."""
        if attribute == "type" and element.tag == "joint":
            return self._is_end(element)
        if _is_synthesized_number(element, attribute) or any(map(self.is_gone, (element, *element.iterancestors()))):
            return True
        holder = element.getparent()
        return element.tag == "mimic" and holder is not None and self._is_geared(holder)

    def is_gone(self, element: XmlElement) -> bool:
        """Whether an element was synthesized by a conversion and left out by the reverse one."""
        part = element.find(_PART)
        if part is not None:
            is_there = self._is_named(str(element.tag), element.get("name", ""))
            return part.get("joint", "") in self.ends and not is_there
        return element.find(_MADE) is not None and not self._is_named(str(element.tag), element.get("name", ""))

    def _is_named(self, tag: str, name: str) -> bool:
        return (tag, name) in self.named

    def _is_end(self, joint: XmlElement) -> bool:
        """Whether a joint has the type in the result that its annotation names."""
        kinds = [annotation.get("type") for annotation in joint.findall(_CHAIN)]
        kinds += [
            annotation.get("value") for annotation in joint.findall(_URDF) if annotation.get("attribute") == "type"
        ]
        if not kinds:
            return any(map(self.is_gone, (joint, *joint.iterancestors())))
        return any(("joint", joint.get("name", ""), kind) in self.there for kind in kinds)

    def _is_geared(self, joint: XmlElement) -> bool:
        """Whether a joint mimicked because of a gearbox, and the result has the gearbox instead."""
        has_gearbox = any(kind == "gearbox" for _, _, kind in self.there)
        return joint.find(_GEARED) is not None and has_gearbox and joint.get("name", "") not in self.followers


def _synthesized_names(source: XmlElement, result: XmlElement, named: Collection[tuple[str, str]]) -> Iterator[str]:
    """Names that a conversion gave to what has its old name again."""
    roots = {(str(result.tag), result.get("name", ""))}
    for annotation in (each for word in _OLD_NAMES for each in source.iter(word)):
        holder, old = annotation.getparent(), annotation.get("was") or (annotation.text or "").strip()
        tag = "" if holder is None else "robot" if holder.tag == "model" else str(holder.tag)
        if (tag, old) in roots or _is_there(tag, old, named):
            yield annotation.get("instead_of", "")


def _is_there(tag: str, old: str, named: Collection[tuple[str, str]]) -> bool:
    """Whether a name is back, in its model or alone; a link of URDF may have stood for a frame or a model."""
    inner = old.removesuffix(f"::{MODEL}").rpartition("::")[2]
    return any((kind, name) in named for kind in (tag, "frame", "model") for name in (old, inner))


def _is_synthesized_number(element: XmlElement, attribute: str | None) -> bool:
    """Whether a number is synthesized: a mass that is computed or a token, an offset of a mimic, no limit."""
    holder = element.getparent()
    if holder is None:
        return False
    if element.tag == "mass":
        is_token = holder.find(_UNSAID) is not None and (element.text or "").strip() == _TOKEN_MASS
        return is_token or holder.find(_COMPUTED_MASS) is not None
    if element.tag == "mimic":
        return attribute == "offset" and holder.find(_MIMIC) is not None
    return element.tag == "limit" and attribute is not None and _is_no_limit(element.get(attribute, ""))


def _is_no_limit(number: str) -> bool:
    """Whether a limit of URDF is so large that it stands for none, which SDF need not write."""
    try:
        return abs(float(number)) >= UNLIMITED
    except ValueError:
        return False
