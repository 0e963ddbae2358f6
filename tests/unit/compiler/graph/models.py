"""Models that graphs are made of in tests."""

from itertools import pairwise
from xml.sax.saxutils import quoteattr

HOSTILE = (
    '"',
    "end",
    "<script>alert(1)</script>",
    "a\nb",
    "a::b",
    "x" * 1_000,
    "\N{RIGHT-TO-LEFT OVERRIDE}abc",
    "日本\N{ROBOT FACE}é",
    "\\",
    "\\N\\",
    "`**bold**`",
    "#quot;&lt;",
    "%%{init}%%",
    "subgraph",
    "]]>",
    "--> n1",
    "' onload='x",
    "graph",
    " ",
)
"""Names that mean something to one of the languages."""

NESTED = """\
<sdf version="1.11"><model name="robot"><link name="base"/><link name="arm"/>
  <model name="hand"><link name="palm"/><link name="thumb"/><frame name="grasp" attached_to="thumb"/>
    <joint name="thumb_joint" type="revolute"><parent>palm</parent><child>thumb</child>
      <axis><xyz>0 0 1</xyz><limit><lower>-0.5</lower><upper>1.25</upper></limit>
        <mimic joint="wave"><multiplier>-2</multiplier><offset>0.1</offset></mimic></axis></joint></model>
  <frame name="tool" attached_to="arm"/>
  <joint name="shoulder" type="prismatic"><parent>base</parent><child>arm</child>
    <axis><xyz>1 0 0</xyz><limit><lower>0</lower><upper>0.4</upper></limit></axis></joint>
  <joint name="wrist" type="fixed"><parent>tool</parent><child>hand::palm</child></joint>
  <joint name="loop" type="ball"><parent>base</parent><child>hand::thumb</child></joint>
</model></sdf>
"""
WORLD = """\
<sdf version="1.11"><world name="yard"><include><name>box</name><uri>model://crate</uri></include>
  <model name="a"><link name="l"/></model><model name="b"><link name="l"/></model>
  <joint name="held" type="fixed"><parent>world</parent><child>a::l</child></joint>
  <joint name="tied" type="fixed"><parent>a::l</parent><child>b</child></joint>
  <joint name="put" type="fixed"><parent>b::l</parent><child>box::base</child></joint>
</world></sdf>
"""


def hostile_urdf() -> str:
    """A chain of links with hostile names, and joints with the same."""
    names = [quoteattr(name) for name in HOSTILE]
    links = "".join(f"<link name={name}/>" for name in names)
    joints = "".join(
        f'<joint name={child} type="fixed"><parent link={parent}/><child link={child}/></joint>'
        for parent, child in pairwise(names)
    )
    return f"<robot name={quoteattr(HOSTILE[2])}>{links}{joints}</robot>"
