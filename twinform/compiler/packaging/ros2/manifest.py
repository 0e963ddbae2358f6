"""`package.xml` of a ROS 2 package, format 3 (REP 149)."""

import re
from collections.abc import Iterable
from xml.sax.saxutils import escape, quoteattr

from twinform.compiler.packaging.ros2.contents import PackageContents

_SCHEMA = "http://download.ros.org/schema/package_format3.xsd"
_FORBIDDEN = re.compile(r"[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
"""What XML cannot have, in any notation."""


def package_xml(contents: PackageContents, depends: Iterable[str]) -> str:
    """The file, with these packages as dependencies at run time."""
    details = contents.details
    lines = [
        '<?xml version="1.0"?>',
        f'<?xml-model href="{_SCHEMA}" schematypens="http://www.w3.org/2001/XMLSchema"?>',
        '<package format="3">',
        f"  <name>{_text(contents.package)}</name>",
        f"  <version>{_text(details.version)}</version>",
        f"  <description>{_text(details.description)}</description>",
        f"  <maintainer email={quoteattr(_plain(details.email))}>{_text(details.maintainer)}</maintainer>",
        f"  <license>{_text(details.license)}</license>",
        *([f"  <author>{_text(details.author)}</author>"] if details.author else []),
        "",
        "  <buildtool_depend>ament_cmake</buildtool_depend>",
        "",
        *(f"  <exec_depend>{_text(each)}</exec_depend>" for each in sorted(set(depends))),
        "",
        "  <export>",
        "    <build_type>ament_cmake</build_type>",
        "  </export>",
        "</package>",
    ]
    return "\n".join(lines) + "\n"


def _text(text: str) -> str:
    return escape(_plain(text))


def _plain(text: str) -> str:
    """Text on one line, without what XML cannot have."""
    return " ".join(_FORBIDDEN.sub("", text).split())
