"""On every real file the normative XSD 1.1 in xmlschema and the default path come to one verdict."""

from collections import Counter
from collections.abc import Iterable
from pathlib import Path

import pytest

from testbed.corpus.files import CorpusFile
from tests.corpus.portions import chunks
from tests.schema_documents import read_tree, version_of
from twinform.compiler.input.parsing import UnreadableError, parse, strip_default_namespace
from twinform.diagnostics import DiagnosticSink, rules
from twinform.schemas import (
    Version,
    XmlElement,
    libxml2_errors,
    validate,
    xmlschema_errors,
)

_FORMATS = {"robot": "urdf", "sdf": "sdf"}
_NAMED_IN_SDF = {
    "actor", "animation", "battery", "collision", "frame", "gripper", "joint", "light", "link", "model",
    "particle_emitter", "population", "projector", "road", "sensor", "visual", "world",
}  # fmt: skip
"""Elements whose names are unique among their like, by the documentation of SDFormat."""
_NAMED_IN_STATES = {"collision_state", "joint_state", "light_state", "link_state", "model_state"}


@pytest.mark.parametrize("chunk", chunks())
def test_both_engines_agree(chunk: str, corpus: Path):
    assert corpus.is_dir()
    assert [found for file in chunks()[chunk] if (found := _disagreement(file)) is not None] == []


def _disagreement(file: CorpusFile) -> str | None:
    try:
        root = parse(file.path.read_bytes(), DiagnosticSink())
    except UnreadableError:
        return None
    strip_default_namespace(root)
    if root.tag not in _FORMATS:
        return None
    name = _FORMATS[str(root.tag)]
    version = version_of(root, name)
    context = read_tree(root, name, version)
    normative = xmlschema_errors(root, name, version)
    default = not libxml2_errors(root, name, version) and context.structural == 0
    names = not _names_clash(root, name, version)
    if (default and names) is bool(normative):
        return f"{file.name}: {default=}, {names=}, {normative[:1]}"
    validate(root, context)
    if any(found.rule is rules.SCHEMA_DISAGREEMENT for found in context.sink.diagnostics):
        return f"{file.name}: {context.sink.diagnostics[-1].message}"
    return None


def _names_clash(root: XmlElement, name: str, version: Version) -> bool:
    """Another judge of the keys: it walks the tree and knows neither the facts nor XPath."""
    return _clashes_in_urdf(root) if name == "urdf" else any(_clashes_in(element, version) for element in _ours(root))


def _clashes_in_urdf(root: XmlElement) -> bool:
    links = [link.get("name") for link in root.iterchildren("link")]
    joints = [joint.get("name") for joint in root.iterchildren("joint")]
    wanted = {end.get("link") for joint in root.iterchildren("joint") for end in joint.iterchildren("parent", "child")}
    mimicked = {mimic.get("joint") for joint in root.iterchildren("joint") for mimic in joint.iterchildren("mimic")}
    unique = len(links) == len(set(links)) and len(joints) == len(set(joints))
    return not unique or not wanted <= set(links) or not mimicked <= set(joints)


def _clashes_in(element: XmlElement, version: Version) -> bool:
    named = _NAMED_IN_SDF | _NAMED_IN_STATES
    if version <= (1, 5):
        named = named - {"light"}  # its name was optional
    # the <collision> of a <contact> has no name, it is one
    names = [(child.tag, child.get("name")) for child in element if child.tag in named and "name" in child.attrib]
    return max(Counter(names).values(), default=1) > 1


def _ours(element: XmlElement) -> Iterable[XmlElement]:
    """The elements outside of plugins and other namespaces."""
    yield element
    for child in element:
        if str(child.tag)[0] != "{" and child.tag not in {"plugin", "auto_inertia_params"}:
            yield from _ours(child)
