"""Puts the models that MJCF attaches in their places: a body, a frame or all of another file, with a prefix to names.

What stands in other sections of that file, such as actuators and sensors, comes with what it refers to; of its assets
all come. Its classes and the units of its compiler hold for it alone. A model may be attached to itself.
"""

import os
from collections.abc import Callable, Iterable, Mapping
from copy import deepcopy
from dataclasses import field
from pathlib import Path
from posixpath import dirname

from lxml import etree

from twinform.compiler.input.mjcf.attached_keys import AttachedKeys, UncountableError
from twinform.compiler.input.mjcf.compiler_settings import CompilerSettings
from twinform.compiler.input.mjcf.copy_budget import CopyBudget, weight_of_tree
from twinform.compiler.input.mjcf.element_findings import TURN, ElementFindings, give_number
from twinform.compiler.input.mjcf.expand_frames import add_to_names, expand_frames
from twinform.compiler.input.mjcf.merge_settings import merge_settings
from twinform.compiler.input.mjcf.model_files import CanonicalModel, ModelFiles
from twinform.dataclass import dataclass
from twinform.diagnostics import rules
from twinform.schemas import XmlElement
from twinform.schemas.mjcf_references import ASSET_KINDS, kind_of, names_in, references_in, rename

_SECTIONS = ("contact", "deformable", "tendon", "equality", "actuator", "sensor", "custom")
"""The sections that come with what their elements refer to, each behind those that it may refer to."""

_NUMBERS = 4
"""How many numbers of a keyframe count as one element."""

Prepare = Callable[[XmlElement, ElementFindings, "Attaching"], CompilerSettings]
"""Makes all canonical in the tree of an attached file but its frames."""


@dataclass(slots=True)
class Attaching:
    """The files of models, the ones around the tree that is at hand, and how much may be attached.

    A file is attached as its path says; that it is a link counts only for what may be read.
    """

    files: ModelFiles
    prepare: Prepare
    budget: CopyBudget
    above: tuple[Path, ...] = ()
    keys: AttachedKeys = field(default_factory=AttachedKeys)

    def __post_init__(self) -> None:
        self.above = self.above or (self.files.main,)

    def attach_all(self, root: XmlElement, findings: ElementFindings) -> None:
        """Put all attached models of a tree in their places."""
        attachments = [each for section in root.iterchildren("worldbody") for each in section.iter("attach")]
        assets: dict[str, XmlElement] = {}
        for asset in root.iterfind("asset/model"):
            assets.setdefault(self.files.name_of(asset, self._path(asset)), asset)
        _number_turns(root)
        whole = deepcopy(root) if any("model" not in each.attrib for each in attachments) else None
        for attachment in attachments:
            child = self._child(attachment, assets, whole, findings)
            content = None if child is None else self._content(attachment, child)
            if child is not None and content is not None:
                merge_settings(root, child, attachment, findings)
                _take_in(attachment, child, content, root)
            parent = attachment.getparent()
            if parent is not None:
                parent.remove(attachment)
            if self.budget.is_spent:
                return
        attached = {each.get("model") for each in attachments}
        for name, asset in assets.items():
            if name not in attached:
                self.files.find(asset, self._path(asset), self.above, findings)  # MuJoCo reads it, too
        for asset in [*root.iterfind("asset/model")]:
            parent = asset.getparent()
            if parent is not None:
                parent.remove(asset)

    def _child(
        self,
        attachment: XmlElement,
        assets: Mapping[str, XmlElement],
        whole: XmlElement | None,
        findings: ElementFindings,
    ) -> XmlElement | None:
        """Return the tree that a model is taken from, with all in it canonical; None where there is none."""
        name = attachment.get("model")
        if name is None:
            return None if whole is None else self._own_tree(attachment, whole, findings)
        asset = assets.get(name)
        if asset is None:
            message = f"no <model> of the assets is called {name!r}"
            findings.report(rules.UNATTACHED_MODEL, attachment, message, "@model", found=name)
            return None
        model = self._canonical(asset, attachment, findings)
        if model is None:
            return None
        child = self._part(attachment, model.root, findings, keep_all=_has_keys(model))
        if child is None:
            return None
        give_number(child, attachment)
        folder = dirname(asset.get("file", "").replace("\\", "/"))
        around = CompilerSettings(mesh_folder=folder, texture_folder=folder)
        for each in child.iter("*"):
            around.resolve_files(each)
        if not self.budget.spend_on_replicates(child, findings):
            return None
        self._take_keys(attachment, child, model, findings)
        return self._selected(attachment, child, model.settings, findings)

    def _canonical(self, asset: XmlElement, attachment: XmlElement, findings: ElementFindings) -> CanonicalModel | None:
        """Return the canonical tree of a file, with all that it attaches; the first time, what is wrong is reported."""
        path, known = self._path(asset), self.files.canonical
        if path in known and path not in self.above:
            return known[path]
        root = self.files.find(asset, path, self.above, findings)
        if root is None:
            return None
        give_number(root, attachment)
        inner = Attaching(
            self.files, self.prepare, self.budget, (*self.above, path), AttachedKeys(counted=self.keys.counted)
        )
        settings = self.prepare(root, findings, inner)
        known[path] = None if self.budget.is_spent else CanonicalModel(root, settings, inner.keys)
        return known[path]

    def write_keys(self, root: XmlElement, findings: ElementFindings) -> None:
        """Write the keyframes of what was attached into a tree whose frames are expanded."""
        if not self._may_write(self.keys, root, root, findings):
            return
        try:
            self.keys.write(root)
        except UncountableError:
            _report_left_out_keys(self.keys.waiting[0].origin, findings)

    def _may_write(self, keys: AttachedKeys, root: XmlElement, element: XmlElement, findings: ElementFindings) -> bool:
        """Count the numbers of keyframes: each has some for all joints, those that are attached beside it too."""
        count = len(keys.waiting) + sum(1 for _ in root.iterfind("keyframe/key"))
        parts = sum(1 for _ in root.iter("joint", "freejoint")) if keys.waiting else 0
        return self.budget.spend(count * (1 + parts // _NUMBERS), element, findings)

    def _take_keys(
        self, attachment: XmlElement, child: XmlElement, model: CanonicalModel, findings: ElementFindings
    ) -> None:
        """Take the keyframes of a model, and those that come with what is attached to that one."""
        if not self._may_write(model.keys, child, attachment, findings):
            return
        try:
            if model.keys.waiting:
                whole = self._expanded(child, model.settings, findings)
                AttachedKeys(list(model.keys.waiting)).write(whole)
                for section in [*child.iterchildren("keyframe")]:
                    child.remove(section)
                child.extend(whole.iterchildren("keyframe"))
            if next(child.iterfind("keyframe/key"), None) is not None:
                self.keys.mark(child)
                whole = self._expanded(child, model.settings, findings)
                self.keys.take(whole, attachment.get("prefix", ""), attachment)
        except UncountableError:
            _report_left_out_keys(attachment, findings)

    def _expanded(self, child: XmlElement, settings: CompilerSettings, findings: ElementFindings) -> XmlElement:
        """Return a copy of a tree with its frames expanded; what is wrong with them is reported for the tree itself."""
        copy = deepcopy(child)
        expand_frames(copy, settings, findings.silent(), CopyBudget(self.budget.most))
        return copy

    def _own_tree(self, attachment: XmlElement, whole: XmlElement, findings: ElementFindings) -> XmlElement | None:
        """Return a copy of the tree that an attachment is in, whose values are canonical already."""
        if "body" not in attachment.attrib and "frame" not in attachment.attrib:
            message = "to attach a part of this model itself, its 'body' or 'frame' has to be named"
            findings.report(rules.UNATTACHED_MODEL, attachment, message)
            return None
        child = self._part(attachment, whole, findings)
        if child is None or not self.budget.spend_on_replicates(child, findings):
            return None
        child = self._selected(attachment, child, CompilerSettings(degrees=False), findings)
        if child is not None and next(child.iter("attach"), None) is not None:
            message = "what is attached here has an <attach> in it, maybe this one"
            findings.report(rules.UNATTACHED_MODEL, attachment, message)
            return None
        return child

    def _part(
        self, attachment: XmlElement, root: XmlElement, findings: ElementFindings, *, keep_all: bool = False
    ) -> XmlElement | None:
        """Return a copy of a tree, with no more in its world than the part that is attached; `keep_all` leaves it."""
        part = None
        tag = next((tag for tag in ("body", "frame") if tag in attachment.attrib), None)
        if tag is not None:
            name = attachment.get(tag)
            tops = root.iterchildren("worldbody")
            part = next((each for top in tops for each in top.iter(tag) if each.get("name") == name), None)
            if part is None:
                message = f"the model that is attached has no {tag} {name!r}"
                findings.report(rules.UNATTACHED_MODEL, attachment, message, f"@{tag}", found=name)
                return None
        kept = [each for each in root.iterchildren("*") if part is None or keep_all or each.tag != "worldbody"]
        more = len(attachment.get("prefix", ""))
        weights = [weight_of_tree(each, more) for each in (*kept, *(() if part is None or keep_all else (part,)))]
        if not self.budget.spend(sum(weights) + 1, attachment, findings):
            return None
        child = etree.Element(root.tag, dict(root.attrib))
        child.extend(deepcopy(each) for each in kept)
        if part is not None and not keep_all:
            etree.SubElement(child, "worldbody").append(deepcopy(part))
        return child

    def _selected(
        self, attachment: XmlElement, child: XmlElement, settings: CompilerSettings, findings: ElementFindings
    ) -> XmlElement | None:
        """Return a tree with nothing but the named body or frame in its world, and its frames expanded."""
        worldbody = child.find("worldbody")
        tag = next((tag for tag in ("body", "frame") if tag in attachment.attrib), None)
        if worldbody is not None and tag is not None:
            name = attachment.get(tag)
            found = next(each for each in worldbody.iter(tag) if each.get("name") == name)
            for each in list(worldbody):
                worldbody.remove(each)
            worldbody.append(found)
        expand_frames(child, settings, findings, self.budget)
        return None if self.budget.is_spent else child

    def _path(self, asset: XmlElement) -> Path:
        return Path(os.path.realpath(self.above[-1].parent / asset.get("file", "")))

    def _content(self, attachment: XmlElement, child: XmlElement) -> list[XmlElement]:
        """Return what stands in the place of an attachment, with its prefix before all names of the tree."""
        prefix = attachment.get("prefix", "")
        worldbody = child.find("worldbody")
        content = [] if worldbody is None else [*worldbody.iterchildren("*")]
        names = _known_names(child, content)
        _keep_followers(child, names)
        if "model" not in attachment.attrib:  # the assets are there already
            names = {kind: each for kind, each in names.items() if kind not in ASSET_KINDS}
            for section in [*child.iterchildren("asset")]:
                child.remove(section)
        for element in content:
            add_to_names(element, names, prefix, "")
        for tag in ("asset", *_SECTIONS):
            for section in child.iterchildren(tag):
                for each in section.iterchildren("*"):
                    if each.get("name"):
                        each.set("name", f"{prefix}{each.get('name')}")
                    rename(each, names, lambda name: f"{prefix}{name}")
        return content


def _number_turns(root: XmlElement) -> None:
    """Number the replicates and attachments of a tree that are not in a replicate, in their order."""
    left = [*root.iterchildren("worldbody")][::-1]
    turn = 0
    while left:
        element = left.pop()
        if element.tag in {"replicate", "attach"}:
            turn += 1
            element.set(TURN, str(turn))
        else:
            left += [*element.iterchildren("body", "frame", "replicate", "attach")][::-1]


def _report_left_out_keys(element: XmlElement, findings: ElementFindings) -> None:
    """Report that keyframes are missing."""
    message = "the keyframes of the attached model are left out"
    findings.report(rules.UNATTACHED_MODEL, element, message, severity=rules.DROPPED_REFERENCE.severity)


def _has_keys(model: CanonicalModel) -> bool:
    return bool(model.keys.waiting) or next(model.root.iterfind("keyframe/key"), None) is not None


def _known_names(child: XmlElement, content: Iterable[XmlElement]) -> dict[str, set[str]]:
    """Return the names of what is attached and of all assets, by kind."""
    names = names_in(content)
    for each in child.iterfind("asset/*"):
        kind, name = ASSET_KINDS.get(str(each.tag)), each.get("name")
        if kind and name:
            names.setdefault(kind, set()).add(name)
    return names


def _keep_followers(child: XmlElement, names: dict[str, set[str]]) -> None:
    """Take out of all other sections what refers to something that is not attached."""
    for section in (section for tag in _SECTIONS for section in child.iterchildren(tag)):
        for each in [*section.iterchildren("*")]:
            if all(reference.name in names.get(reference.kind, ()) for reference in references_in(each)):
                kind, name = kind_of(each, str(section.tag)), each.get("name")
                if kind and name:
                    names.setdefault(kind, set()).add(name)
            else:
                section.remove(each)


def _take_in(attachment: XmlElement, child: XmlElement, content: list[XmlElement], root: XmlElement) -> None:
    for element in content:
        element.tail = None
        attachment.addprevious(element)
    for tag in ("asset", *_SECTIONS):
        for section in child.iterchildren(tag):
            own = root.find(tag)
            if own is None:
                own = etree.SubElement(root, tag)
                give_number(own, attachment)
            for each in section.iterchildren("*"):
                each.attrib.pop(TURN, None)
                if TURN in attachment.attrib:
                    each.set(TURN, attachment.get(TURN, ""))
            own.extend(list(section.iterchildren("*")))
