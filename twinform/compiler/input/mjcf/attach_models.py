"""Puts the models that MJCF attaches in their places: a body, a frame or all of another file, with a prefix to names.

What stands in other sections of that file, such as actuators and sensors, comes with what it refers to; of its assets
all come. Its classes and the units of its compiler hold for it alone. A model may be attached to itself.
"""

from collections.abc import Callable, Iterable
from contextlib import suppress
from copy import deepcopy
from dataclasses import field
from pathlib import Path
from posixpath import dirname

from lxml import etree

from twinform.compiler.input.load_options import LoadOptions, unexpanded_name
from twinform.compiler.input.mjcf.attached_keys import AttachedKeys, UncountableError
from twinform.compiler.input.mjcf.compiler_settings import CompilerSettings
from twinform.compiler.input.mjcf.element_findings import ElementFindings, give_number
from twinform.compiler.input.mjcf.expand_frames import add_to_names, expand_frames, is_too_large
from twinform.compiler.input.mjcf.merge_settings import merge_settings
from twinform.compiler.input.mjcf.references import ASSET_KINDS, kind_of, names_in, references_in, rename
from twinform.compiler.input.mjcf.splice_includes import splice_includes
from twinform.compiler.input.parsing import UnreadableError, parse, read_bytes, strip_default_namespace
from twinform.compiler.input.size_limits import LIFTED_BY_TAGS
from twinform.dataclass import dataclass
from twinform.diagnostics import Diagnostic, DiagnosticSink, rules
from twinform.schemas import XmlElement

_SECTIONS = ("contact", "deformable", "tendon", "equality", "actuator", "sensor", "custom")
"""The sections that come with what their elements refer to, each behind those that it may refer to."""
_DEEPEST = 32

Prepare = Callable[[XmlElement, ElementFindings, "Attaching"], CompilerSettings]
"""Makes all canonical in the tree of an attached file but its frames."""


@dataclass(slots=True)
class Attaching:
    """How models are read, the files that are being read, and how many elements were attached so far."""

    load_options: LoadOptions
    prepare: Prepare
    files: tuple[Path, ...]
    elements: list[int] = field(default_factory=lambda: [0])
    keys: AttachedKeys = field(default_factory=AttachedKeys)

    def attach_all(self, root: XmlElement, findings: ElementFindings) -> None:
        """Put all attached models of a tree in their places."""
        attachments = [each for section in root.iterchildren("worldbody") for each in section.iter("attach")]
        whole = deepcopy(root) if any("model" not in each.attrib for each in attachments) else None
        for attachment in attachments:
            child = self._child(attachment, root, whole, findings)
            content = None if child is None else self._content(attachment, child)
            if child is not None and content is not None:
                merge_settings(root, child, attachment, findings)
                _take_in(attachment, child, content, root)
            parent = attachment.getparent()
            if parent is not None:
                parent.remove(attachment)
        attached = {each.get("model") for each in attachments}
        for asset in [*root.iterfind("asset/model")]:
            if self._name_of(asset) not in attached:
                self._find(asset, findings)  # MuJoCo reads it, too
            parent = asset.getparent()
            if parent is not None:
                parent.remove(asset)

    def _child(
        self, attachment: XmlElement, root: XmlElement, whole: XmlElement | None, findings: ElementFindings
    ) -> XmlElement | None:
        """Return the tree that a model is taken from, with all in it canonical; None where there is none."""
        name = attachment.get("model")
        if name is None:
            return None if whole is None else self._own_tree(attachment, whole, findings)
        asset = next((each for each in root.iterfind("asset/model") if self._name_of(each) == name), None)
        if asset is None:
            message = f"no <model> of the assets is called {name!r}"
            findings.report(rules.UNATTACHED_MODEL, attachment, message, "@model", found=name)
            return None
        child = self._find(asset, findings)
        if child is None or self._is_too_much(child, attachment, findings):
            return None
        give_number(child, attachment)
        path = self._path(asset)
        keys = AttachedKeys(counted=self.keys.counted)
        inner = Attaching(self.load_options, self.prepare, (*self.files, path.resolve()), self.elements, keys)
        settings = self.prepare(child, findings, inner)
        folder = dirname(asset.get("file", "").replace("\\", "/"))
        around = CompilerSettings(mesh_folder=folder, texture_folder=folder)
        for each in child.iter("*"):
            around.resolve_files(each)
        if is_too_large(child, findings, self.load_options.limits.tags):
            return None
        self._take_keys(attachment, child, settings, inner.keys, findings)
        return self._selected(attachment, child, settings, findings)

    def write_keys(self, root: XmlElement, findings: ElementFindings) -> None:
        """Write the keyframes of what was attached into a tree whose frames are expanded."""
        try:
            self.keys.write(root)
        except UncountableError:
            _report_left_out_keys(self.keys.waiting[0].origin, findings)

    def _take_keys(
        self,
        attachment: XmlElement,
        child: XmlElement,
        settings: CompilerSettings,
        inner: AttachedKeys,
        findings: ElementFindings,
    ) -> None:
        """Take the keyframes of a model, and those that come with what is attached to that one."""
        try:
            if inner.waiting:
                whole = self._expanded(child, settings, findings)
                inner.write(whole)
                for section in [*child.iterchildren("keyframe")]:
                    child.remove(section)
                child.extend(whole.iterchildren("keyframe"))
            if next(child.iterfind("keyframe/key"), None) is not None:
                self.keys.mark(child)
                self.keys.take(self._expanded(child, settings, findings), attachment.get("prefix", ""), attachment)
        except UncountableError:
            _report_left_out_keys(attachment, findings)

    def _expanded(self, child: XmlElement, settings: CompilerSettings, findings: ElementFindings) -> XmlElement:
        """Return a copy of a tree with its frames expanded; what is wrong with them is reported for the tree itself."""
        copy = deepcopy(child)
        expand_frames(copy, settings, findings.silent(), self.load_options.limits.tags)
        return copy

    def _name_of(self, asset: XmlElement) -> str:
        """Return the name of a model among the assets: where it has none, the one that its file says."""
        name, root = asset.get("name"), None
        if not name:
            with suppress(UnreadableError):
                root = self._tree(self._path(asset), DiagnosticSink())
        return name or (root.get("model", "MuJoCo Model") if root is not None else "")

    def _own_tree(self, attachment: XmlElement, whole: XmlElement, findings: ElementFindings) -> XmlElement | None:
        """Return a copy of the tree that an attachment is in, whose values are canonical already."""
        if "body" not in attachment.attrib and "frame" not in attachment.attrib:
            message = "to attach a part of this model itself, its 'body' or 'frame' has to be named"
            findings.report(rules.UNATTACHED_MODEL, attachment, message)
            return None
        child = deepcopy(whole)
        if self._is_too_much(child, attachment, findings):
            return None
        child = self._selected(attachment, child, CompilerSettings(degrees=False), findings)
        if child is not None and next(child.iter("attach"), None) is not None:
            message = "what is attached here has an <attach> in it, maybe this one"
            findings.report(rules.UNATTACHED_MODEL, attachment, message)
            return None
        return child

    def _selected(
        self, attachment: XmlElement, child: XmlElement, settings: CompilerSettings, findings: ElementFindings
    ) -> XmlElement | None:
        """Return a tree with nothing but the named body or frame in its world, and its frames expanded."""
        worldbody = child.find("worldbody")
        for tag in ("body", "frame"):
            name = attachment.get(tag)
            if name is None:
                continue
            found = None if worldbody is None else next((e for e in worldbody.iter(tag) if e.get("name") == name), None)
            if worldbody is None or found is None:
                message = f"the model that is attached has no {tag} {name!r}"
                findings.report(rules.UNATTACHED_MODEL, attachment, message, f"@{tag}", found=name)
                return None
            for each in list(worldbody):
                worldbody.remove(each)
            worldbody.append(found)
            break
        expand_frames(child, settings, findings, self.load_options.limits.tags)
        return child

    def _is_too_much(self, child: XmlElement, attachment: XmlElement, findings: ElementFindings) -> bool:
        self.elements[0] += sum(1 for _ in child.iter("*"))
        most = self.load_options.limits.tags
        if self.elements[0] <= most:
            return False
        message = f"the models that are attached have more than {most:,} elements together"
        findings.report(rules.OVERSIZED_FILE, attachment, message, help=LIFTED_BY_TAGS)
        return True

    def _path(self, asset: XmlElement) -> Path:
        return self.files[-1].parent / asset.get("file", "")

    def _find(self, asset: XmlElement, findings: ElementFindings) -> XmlElement | None:
        """Return the tree of the file of an asset, or None where it cannot be read, which is reported."""
        file, path = asset.get("file", ""), self._path(asset)
        if path.resolve() in self.files:
            message = f"{file!r} attaches itself, directly or by way of others"
            findings.report(rules.INCLUDE_CYCLE, asset, message, "@file", found=file)
            return None
        if len(self.files) > _DEEPEST:
            message = f"{file!r} is attached inside of {_DEEPEST} other models"
            findings.report(rules.TOO_MANY_INCLUDES, asset, message, "@file", found=file)
            return None
        found = DiagnosticSink(str(path))
        root: XmlElement | None = None
        with suppress(UnreadableError):
            root = self._tree(path, found)
        problem = next((each for each in found.diagnostics if each.is_error), None)
        if problem is not None or root is None:
            _report_unread(problem, file, asset, findings)
            return None
        if root.tag != "mujoco":
            message = f"{file!r} is a <{root.tag}>, and only MJCF can be attached here"
            findings.report(rules.UNATTACHED_MODEL, asset, message, "@file", found=file, expected="<mujoco>")
            return None
        return root

    def _tree(self, path: Path, sink: DiagnosticSink) -> XmlElement:
        search = self.load_options.search
        unsaved = search.unsaved_of(path)
        main = self.files[0]
        text = read_bytes(path, sink, self.load_options.limits, search.readable(main)) if unsaved is None else unsaved
        search.seen.add(path)
        spliced = splice_includes(path, text, sink, self.load_options) if b"<include" in text else None
        root = parse(spliced.text if spliced else text, sink, self.load_options.limits)
        strip_default_namespace(root)
        return root

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


def _report_left_out_keys(element: XmlElement, findings: ElementFindings) -> None:
    """Report that keyframes are missing."""
    message = "the keyframes of the attached model are left out"
    findings.report(rules.UNATTACHED_MODEL, element, message, severity=rules.DROPPED_REFERENCE.severity)


def _report_unread(problem: Diagnostic | None, file: str, asset: XmlElement, findings: ElementFindings) -> None:
    why = problem.message if problem else "it cannot be read"
    hint = problem.help if problem else None
    findings.report(rules.UNATTACHED_MODEL, asset, f"{file!r}: {why}", "@file", found=file, help=hint)


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
            own.extend(list(section.iterchildren("*")))


def main_file(name: str) -> Path:
    """Return the path of the file that is being read."""
    return Path(unexpanded_name(name)).resolve()
