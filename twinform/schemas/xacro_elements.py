"""The elements of xacro's own language: their attributes, and what they mean."""

from typing import NamedTuple

NAMESPACES = ("http://www.ros.org/wiki/xacro", "http://ros.org/wiki/xacro", "http://wiki.ros.org/xacro")
"""The names that real files give xacro's namespace, that of its documentation first. xacro takes any."""


class XacroAttribute(NamedTuple):
    """An attribute. `prefixed` means that it is in xacro's namespace too."""

    name: str
    meaning: str
    required: bool = False
    prefixed: bool = False


class XacroElement(NamedTuple):
    """An element. `holds_xml` means that it has content, of any kind, and not only attributes and text."""

    name: str
    meaning: str
    attributes: tuple[XacroAttribute, ...]
    holds_xml: bool = False
    free: bool = False
    """Whether it takes any other attributes."""


_CONDITION = XacroAttribute("value", "True or false, 1 or 0, or an expression that gives one.", required=True)

ELEMENTS = (
    XacroElement(
        "arg",
        "An argument that is given on the command line or by whoever includes the file, for $(arg NAME).",
        (
            XacroAttribute("name", "What it is called.", required=True),
            XacroAttribute("default", "Its value where none is given.", required=True),
        ),
    ),
    XacroElement(
        "property",
        "A name for a value, or for the XML in it, for ${NAME} and insert_block.",
        (
            XacroAttribute("name", "What it is called. Names of blocks begin with * where they are inserted.", True),
            XacroAttribute("value", "Its value; without it, the XML in the element."),
            XacroAttribute("default", "Its value where it has none yet."),
            XacroAttribute(
                "scope", "Where it is known besides: in the calling macro (parent), or everywhere (global)."
            ),
            XacroAttribute("remove", "True takes the name away again."),
            XacroAttribute("lazy_eval", "False evaluates the value here, and not where it is used."),
        ),
        holds_xml=True,
    ),
    XacroElement(
        "macro",
        "A piece of XML with parameters; <xacro:NAME .../> is replaced by it.",
        (
            XacroAttribute("name", "What it is called.", required=True),
            XacroAttribute(
                "params",
                "Its parameters, with blanks between them: NAME, NAME:=DEFAULT, NAME:=^ for that of the caller, "
                "*NAME for a block, **NAME for what a block contains.",
            ),
        ),
        holds_xml=True,
    ),
    XacroElement(
        "include",
        "The content of another xacro file stands here.",
        (
            XacroAttribute("filename", "The file; $(find PACKAGE) leads into a package.", required=True),
            XacroAttribute("ns", "Puts its macros and properties into a namespace: NS.NAME."),
            XacroAttribute("optional", "True lets the file be missing."),
        ),
    ),
    XacroElement("if", "What is in it stands here if the value is true.", (_CONDITION,), holds_xml=True),
    XacroElement("unless", "What is in it stands here if the value is false.", (_CONDITION,), holds_xml=True),
    XacroElement(
        "insert_block",
        "The XML of a block parameter or a block property stands here.",
        (XacroAttribute("name", "The name of the block.", required=True),),
    ),
    XacroElement(
        "call",
        "A macro whose name is an expression.",
        (XacroAttribute("macro", "The name of the macro.", required=True),),
        holds_xml=True,
        free=True,
    ),
    XacroElement(
        "element",
        "An element whose name is an expression.",
        (XacroAttribute("name", "The name.", required=True, prefixed=True),),
        holds_xml=True,
        free=True,
    ),
    XacroElement(
        "attribute",
        "An attribute of the element around it, whose name and value are expressions.",
        (
            XacroAttribute("name", "The name.", required=True),
            XacroAttribute("value", "The value.", required=True),
        ),
    ),
)
"""By the source of xacro 2.1; every element but these is the call of a macro."""

TARGET_NAMESPACE = XacroAttribute("targetNamespace", "The default namespace of the result.", prefixed=True)
"""An attribute of the root."""
