"""The text of generated readers, in pieces."""

MODULE = '''\
"""The generated reader of {format}: a function for each element that makes a node, or fills one.

Written by `python -m twinform.compiler.input.readers.generate` from the facts tables; not to be edited.
"""

from typing import Any

from twinform.compiler.input.readers.reading import Reading
from twinform.compiler.input.readers.values import {parsers}
from twinform.diagnostics import Source
from twinform.ir import {classes}
from twinform.ir.record import maker
from twinform.schemas import Data, XmlElement, locate

{makers}


{functions}
'''

MAKER = "make_{name} = maker({node})"

READ = '''
def {function}(element: XmlElement, above: Source | None, step: str, key: str | int | None, reading: Reading) -> Data:
    """The values of a {node}, from `{path}`."""
    source = locate(Source, (reading.file, element.sourceline or 0, above, step, key))
    node: Data = {{"source": source{constants}}}
{body}
    return node
'''

FILL = '''
def {function}(element: XmlElement, node: Data, reading: Reading) -> None:
    """`{path}`, which fills the {node} around it."""
{body}
'''

ATTRIBUTES = """
for name, text in element.items():
    {branches}
    else:
        reading.attribute({path!r}, element, name, text, node{at})
"""

NO_ATTRIBUTES = """
for name, text in element.items():
    reading.attribute({path!r}, element, name, text, node{at})
"""

MISSING_ATTRIBUTES = """
if {condition}:
    reading.missing_attributes({path!r}, element)
"""

NO_TEXT = """
if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
    reading.text({path!r}, element, node{at})
"""

FREE_TEXT = """
if (text := element.text) and not (text.isspace() and text.isascii()):
    reading.text({path!r}, element, node{at})
"""

POSE = """
if (value := pose(element.text)) is not None and node.get("rotation_format") != "quat_xyzw":
    node["xyz"], node["rpy"] = value
else:
    reading.text({path!r}, element, node{at})
"""

NO_CHILDREN = """
if len(element):
    reading.children({path!r}, element, node{at})
"""

CONTENT = """
if len(element):
    node[{field!r}] = tuple([reading.content(child, source) for child in element])
"""

TEXT_OF = """
text_of = reading.text_of
"""

CHILDREN = """
counts: dict[Any, int] = {{}}
for child in element:
    tag = child.tag
    place = counts[tag] = counts.get(tag, 0) + 1
    {branches}
    else:
        reading.child({path!r}, child, node, place{at})
    if reading.is_unsure and (text := child.tail) and not (text.isspace() and text.isascii()):
        reading.tail({path!r}, element, child, node{at})
"""

MISSING_CHILDREN = """
if {condition}:
    reading.missing_children({path!r}, element, counts)
"""

MAKE_INNER = """
if {field!r} in node:
    node[{field!r}] = make_{maker}(node[{field!r}])
"""

MAKE_TUPLE = """
if {field!r} in node:
    node[{field!r}] = tuple(node[{field!r}])
"""

BREAK = """
if {condition}:
    reading.broken = True
"""

OTHER_VERSION = """
if {guard}:
    reading.other_version({path!r}, child)
"""

FILL_FROM = "{function}(child, node, reading)"

APPEND_NODE = """
data = {function}(child, {above}, {step!r}, {key}, reading)
node.setdefault({field!r}, []).append(make_{maker}(data))
"""

SET_KIND = """
node[{field!r}] = make_{maker}({function}(child, {above}, {step!r}, {key}, reading))
"""

SET_NODE = """
data = {function}(child, {above}, {step!r}, {key}, reading)
if len(data) > 1:
    node[{field!r}] = make_{maker}(data)
else:
    reading.keep(child, node{at})
"""

SET_INNER_NODE = """
data = {function}(child, {above}, {step!r}, {key}, reading)
inner = node.setdefault({outer!r}, {{"source": data["source"]}})
if len(data) > 1:
    inner[{field!r}] = make_{maker}(data)
else:
    reading.keep(child, node{at})
"""

SET_VALUE = "node[{field!r}] = {value}"
APPEND_VALUE = "node.setdefault({field!r}, []).append({value})"
SET_INNER_VALUE = "reading.holder(node, {outer!r}, {element})[{field!r}] = {value}"
