"""Single files that mean harm, each with the rule that has to end it."""

import gzip
from collections.abc import Callable, Mapping
from random import Random
from typing import NamedTuple

_LINK = b'<link name="a"/>'


class Hostile(NamedTuple):
    """A file and the one error that is to be reported; `line` is where, 0 for the file as a whole."""

    make: Callable[[], bytes]
    rule: str
    line: int = 1


def _robot(inside: bytes, before: bytes = b"") -> bytes:
    return before + b'<robot name="r">' + _LINK + inside + b"</robot>"


def _entities(declared: bytes, name: bytes = b"&x;") -> Callable[[], bytes]:
    return lambda: b"<!DOCTYPE robot [" + declared + b']>\n<robot name="' + name + b'">' + _LINK + b"</robot>"


def _many(count: int, each: bytes, times: int = 1) -> bytes:
    return b"".join(each % ((number,) * times) for number in range(count))


def _laughs() -> bytes:
    return b"".join(b'<!ENTITY e%d "%s">' % (n, b"&e%d;" % (n - 1) * 10 if n else b"ha") for n in range(12))


DOCUMENTS: Mapping[str, Hostile] = {
    "an external entity": Hostile(_entities(b'<!ENTITY x SYSTEM "file:///etc/passwd">'), "not-well-formed", 2),
    "an external parameter entity": Hostile(
        _entities(b'<!ENTITY % x SYSTEM "file:///etc/passwd"> %x;', b"r"), "doctype"
    ),
    "a DTD of the network": Hostile(
        lambda: _robot(b"", b'<!DOCTYPE robot SYSTEM "http://127.0.0.1:9/robot.dtd">'), "doctype"
    ),
    "defaults of a DTD": Hostile(
        lambda: b'<!DOCTYPE r [<!ATTLIST link name CDATA "a">]><robot name="r"><link/></robot>', "doctype"
    ),
    "a billion laughs": Hostile(_entities(_laughs(), b"&e11;"), "oversized-file", 2),
    "laughs in quadratic number": Hostile(
        _entities(b'<!ENTITY x "' + b"y" * 100_000 + b'">', b"&x;" * 100_000), "oversized-file", 2
    ),
    "300 levels": Hostile(lambda: _robot(b"<x>" * 300 + b"</x>" * 300), "oversized-file"),
    "100,000 levels": Hostile(lambda: _robot(b"<x>" * 100_000 + b"</x>" * 100_000), "oversized-file"),
    "a text of 20 MB": Hostile(lambda: _robot(b"<x>" + b"y" * 20_000_000 + b"</x>"), "oversized-file"),
    "an attribute of 20 MB": Hostile(lambda: _robot(b'<x a="' + b"y" * 20_000_000 + b'"/>'), "oversized-file"),
    "a name of 9 MB": Hostile(lambda: _robot(b'<link name="' + b"y" * 9_000_000 + b'"/>'), "oversized-file"),
    "65 MB": Hostile(lambda: b" " * (65 * 2**20) + _robot(b""), "unreadable-file", 0),
    "a million elements": Hostile(lambda: _robot(b"<x/>" * 1_000_000), "oversized-file", 0),
    "16 million elements": Hostile(lambda: _robot(b"<x/>" * 16_000_000), "oversized-file", 0),
    "a million links": Hostile(lambda: _robot(_many(1_000_000, b'<link name="l%d"/>')), "oversized-file", 0),
    "a million comments": Hostile(lambda: _robot(b"<!---->" * 1_000_000), "oversized-file", 0),
    "a million elements in UTF-16": Hostile(
        lambda: _robot(b"<x/>" * 1_000_000).decode().encode("utf-16"), "oversized-file", 0
    ),
    "a million elements for Gazebo": Hostile(
        lambda: _robot(b"<gazebo>" + b"<x/>" * 1_000_000 + b"</gazebo>"), "oversized-file", 0
    ),
    "100,000 attributes": Hostile(lambda: _robot(b"<x " + _many(100_000, b'a%d="" ') + b"/>"), "oversized-file"),
    "100,000 attributes of an undeclared prefix": Hostile(
        lambda: _robot(b"<x " + _many(100_000, b'p:a%d="" ') + b"/>"), "oversized-file"
    ),
    "25,000 namespaces in four elements": Hostile(
        lambda: _robot((b"<x>" + _many(25_000, b'<p%d:x xmlns:p%d="urn:%d"/>', 3) + b"</x>") * 4), "oversized-file", 0
    ),
    "20,000 namespaces of the root": Hostile(
        lambda: b"<robot " + _many(20_000, b'xmlns:p%d="urn:%d" ', 2) + b'name="r"><link name="a"/></robot>',
        "oversized-file",
        0,
    ),
    "an attribute 100,000 times": Hostile(lambda: _robot(b"<x " + b'a="" ' * 100_000 + b"/>"), "not-well-formed"),
    "UTF-7": Hostile(lambda: _robot(b"", b'<?xml version="1.0" encoding="UTF-7"?>'), "not-well-formed"),
    "EBCDIC": Hostile(
        lambda: _robot(b"", b'<?xml version="1.0" encoding="cp037"?>').decode().encode("cp037"), "not-well-formed"
    ),
    "EBCDIC behind a declaration in ASCII": Hostile(
        lambda: b'<?xml version="1.0" encoding="cp037"?>' + _robot(b"").decode().encode("cp037"), "not-well-formed"
    ),
    "an encoding that is none": Hostile(
        lambda: _robot(b"", b'<?xml version="1.0" encoding="../../etc/passwd"?>'), "not-well-formed"
    ),
    "bad UTF-8": Hostile(lambda: _robot(b'<link name="\xff"/>'), "not-well-formed"),
    "half a character of UTF-16": Hostile(lambda: _robot(b"").decode().encode("utf-16") + b"x", "not-well-formed"),
    "NUL": Hostile(lambda: _robot(b'\0<link name="b"/>'), "not-well-formed"),
    "NUL by number": Hostile(lambda: _robot(b'<link name="&#0;"/>'), "not-well-formed"),
    "a tail of NUL": Hostile(lambda: _robot(b"") + b"\0" * 100_000, "not-well-formed"),
    "a bomb of gzip": Hostile(
        lambda: gzip.compress(_robot(b"<x>" + b"y" * 100_000_000 + b"</x>"), 1), "not-well-formed"
    ),
    "noise": Hostile(lambda: Random(6).randbytes(1_000_000), "not-well-formed"),
    "JSON of 100,000 levels": Hostile(lambda: b'{"format":"urdf","models":' + b"[" * 100_000, "invalid-value", 1),
    "JSON of four million models": Hostile(
        lambda: b'{"format":"urdf","models":[' + b'{"name":"r"},' * 4_000_000 + b"{}]}", "oversized-file", 0
    ),
    "JSON of 100,000 namespaces": Hostile(
        lambda: b'{"format":"urdf","namespaces":[' + _many(100_000, b'["p%d","urn:%d"],', 2) + b'["x","y"]]}',
        "oversized-file",
        0,
    ),
    "JSON with a number of a million digits": Hostile(
        lambda: b'{"format":"urdf","version":' + b"1" * 1_000_000 + b"}", "invalid-value", 1
    ),
}
