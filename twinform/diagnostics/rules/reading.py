"""Rules about files as files and as XML."""

from twinform.diagnostics.fix import Safety
from twinform.diagnostics.rule import Rule, Severity

UNREADABLE_FILE = Rule(
    name="unreadable-file",
    severity=Severity.ERROR,
    fatal=True,
    finds="A file that is not there, cannot be opened, is empty, or is larger than 64 MB.",
    matters="There is nothing to compile. The limit keeps a hostile file from filling the memory; robots stay far "
    "below.",
    example="`twinform check no_such_robot.urdf`",
    better="Check the path. A larger file that is your own is read with `--max-size`.",
)
OVERSIZED_FILE = Rule(
    name="oversized-file",
    severity=Severity.ERROR,
    fatal=True,
    finds="A file beyond the limits: 64 MB, a million tags, elements 256 deep, 50,000 elements and "
    "256 attributes in one element, 10,000 texts between elements, 10,000 names with two colons, names of 1,024 "
    "characters, 10 MB in one text; entities that unfold into more.",
    matters="A hostile file could fill the memory, or keep the machine busy for hours. Robots stay far below: a chain "
    "of 10,000 links has 280,000 tags.",
    example="A million `<x/>`; a link in a link in a link, a thousand deep.",
    better="Split the world into files, and include them. For a file that is your own, `--max-size` and `--max-tags` "
    "lift the first two limits; more than a million tags also mean any number of elements in one, and of texts.",
)
NOT_WELL_FORMED = Rule(
    name="not-well-formed",
    severity=Severity.ERROR,
    fatal=True,
    fix=Safety.SAFE,
    finds="Text that is not XML, in a way that cannot be repaired with certainty.",
    matters="The parser cannot tell what was meant, and a guess may be another robot.",
    example="An end tag that does not match, an attribute without quotes, a file cut off in the middle.",
    better="Correct the line that the message names, as its help proposes.",
    references="XML 1.0, section 2.1",
)
REPAIRED_XML = Rule(
    name="repaired-xml",
    severity=Severity.WARNING,
    strict=Severity.ERROR,
    fix=Safety.SAFE,
    finds="A breach of the rules of XML that has one meaning only, and that the parsers of ROS and Gazebo let pass.",
    matters="Those two read the file, every other XML tool refuses it.",
    example="`--` inside a comment, `<?xml version='0.0'?>`, `<?xml` after a blank line or without its `<`, "
    "a prefix without `xmlns:`.",
    better="Follow the message; the output of a conversion is well formed in any case.",
    references="XML 1.0, sections 2.5 and 2.8; Namespaces in XML 1.0, section 5",
)
DOCTYPE = Rule(
    name="doctype",
    severity=Severity.ERROR,
    fatal=True,
    fix=Safety.SAFE,
    finds="A document type declaration.",
    matters="Entities and default attributes change a document's content, can read other files and fill the memory. "
    "No robot needs one.",
    example="`<!DOCTYPE robot [<!ENTITY mass '1.0'>]>`",
    better="Write the values out, or use xacro properties.",
)
UNKNOWN_ROOT = Rule(
    name="unknown-root",
    severity=Severity.ERROR,
    fatal=True,
    finds="A document whose root element is neither `robot` nor `sdf`.",
    matters="It is another format, or a dialect older than SDF 1.2, whose root was `gazebo`.",
    example="`<gazebo version='1.0'>`, `<model>` of a model.config, `<COLLADA>`.",
    better="Name the model file itself; bring a file of SDF before 1.2 up to date with Gazebo Classic's own tool.",
)
OLD_ROOT = Rule(
    name="old-root",
    severity=Severity.WARNING,
    fix=Safety.SAFE,
    finds="A file of SDF 1.2, whose root element was still called `gazebo`.",
    matters="Most readers look for `sdf` and refuse the file.",
    example="`<gazebo version='1.2'>`",
    better="Call the root `sdf`; it is read and written as that, and in a newer version when asked for.",
)
WIDE_ENCODING = Rule(
    name="wide-encoding",
    severity=Severity.WARNING,
    strict=Severity.ERROR,
    finds="A file in UTF-16, or another encoding with several bytes for each letter.",
    matters="urdfdom, libsdformat and Drake refuse it. We read it, and what we write is UTF-8.",
    example='A file that an editor on Windows has saved as "Unicode".',
    better="Save it as UTF-8: `iconv -f UTF-16 -t UTF-8 robot.urdf > robot.utf8.urdf`, and correct `encoding` in its "
    "first line.",
)
