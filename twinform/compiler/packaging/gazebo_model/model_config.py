"""Writes model.config: what a model folder of Gazebo says about itself."""

from collections.abc import Iterable, Mapping

from lxml import etree

from twinform.compiler.packaging.order import PackageDetails
from twinform.schemas import XmlElement


def model_config(
    name: str, details: PackageDetails, sdf_files: Mapping[str, str], includes: Iterable[str] = ()
) -> bytes:
    """The text of a model.config.

    `sdf_files` are the SDF files by their versions, the newest first: Gazebo takes the newest that it reads. `includes`
    are the URIs of models that this one depends on.
    """
    root = etree.Element("model")
    _add(root, "name", name)
    _add(root, "version", details.version)
    for version, file in sdf_files.items():
        _add(root, "sdf", file).set("version", version)
    author = etree.SubElement(root, "author")
    _add(author, "name", details.author or details.maintainer)
    _add(author, "email", details.email)
    _add(root, "description", details.description)
    uris = sorted(set(includes))
    if uris:
        depend = etree.SubElement(root, "depend")
        for uri in uris:
            model = etree.SubElement(depend, "model")
            _add(model, "uri", uri)
            _add(model, "version", "1.0")
    etree.indent(root)
    return etree.tostring(root, encoding="UTF-8", xml_declaration=True).replace(b"'", b'"', 4) + b"\n"


def _add(parent: XmlElement, name: str, text: str) -> XmlElement:
    element = etree.SubElement(parent, name)
    element.text = text
    return element
