"""What the package or the model folder around a file says about itself: who made it, its license, its version."""

import re
from pathlib import Path

from lxml import etree

from twinform.compiler.packaging.order import PLACEHOLDERS, PackageDetails
from twinform.compiler.packaging.origins import HIGHEST
from twinform.compiler.search.packages import MANIFEST, MODEL_CONFIG, read_manifest
from twinform.schemas import XmlElement

_TEXTS = etree.Element
"""Elements have texts that count: neither comments nor entities, which are not resolved."""
_UNSAID = frozenset(PLACEHOLDERS.values())
_VERSION = re.compile(r"(\d+\.\d+)(\.\d+)?")


def details_around(file: Path) -> PackageDetails:
    """What the nearest package.xml or model.config says, of the folder of a file and those around it.

    Empty are those fields that it does not have. Several maintainers are the first of them, several licenses stand in a
    row, and a version of two numbers gets a third, which packages of ROS need (REP 149).
    """
    for folder in file.absolute().parents[:HIGHEST]:
        if (package := read_manifest(folder / MANIFEST)) is not None:
            return _of_package(package)
        if (model := read_manifest(folder / MODEL_CONFIG)) is not None:
            return _of_model(model)
    return PackageDetails()


def _of_package(root: XmlElement) -> PackageDetails:
    maintainer = root.find("maintainer")
    return PackageDetails(
        description=_text(root.find("description")),
        version=_version(root),
        author=_text(root.find("author")),
        maintainer=_text(maintainer),
        email=_email(maintainer),
        license=", ".join(filter(None, map(_text, root.findall("license")))),
    )


def _of_model(root: XmlElement) -> PackageDetails:
    name = _text(root.find("author/name"))
    return PackageDetails(
        description=_text(root.find("description")),
        version=_version(root),
        maintainer=name,
        email=_text(root.find("author/email")),
    )


def _email(maintainer: XmlElement | None) -> str:
    text = "" if maintainer is None else str(maintainer.get("email") or "").strip()
    return "" if text in _UNSAID else text


def _version(root: XmlElement) -> str:
    found = _VERSION.fullmatch(_text(root.find("version")))
    return "" if found is None else f"{found[1]}{found[2] or '.0'}"


def _text(element: XmlElement | None) -> str:
    """All text of an element, with one space between words; nothing where it only says that nobody has said it."""
    text = "" if element is None else " ".join("".join(element.itertext(_TEXTS)).split())
    return "" if text in _UNSAID else text
