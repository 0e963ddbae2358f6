"""Models of SDF as text, and what becomes of them in URDF."""

from lxml import etree

from twinform.compiler.output.emitting import document_tree
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Document
from twinform.passes import Pipeline
from twinform.passes.carriers.carriers import NAMESPACE
from twinform.passes.legalise.to_urdf.sequence import to_urdf
from twinform.request_options import Requested
from twinform.schemas import Context, XmlElement, libxml2_errors, parse_version, reader

LINK = "<link name='a'/>"
TF = {"tf": NAMESPACE}


def read(text: str, version: str = "1.11", around: str = "<model name='m'>{}</model>") -> Document:
    root = etree.fromstring(f"<sdf version='{version}'>{around.format(text)}</sdf>")
    sink = DiagnosticSink()
    data = reader("sdf", parse_version(version)).read(root, Context(sink, "", "sdf", parse_version(version)))
    assert [str(each.message) for each in sink.diagnostics if each.is_error] == []
    return Document.model_validate({"format": "sdf", **data})


def lower(document: Document, *, model: str | None = None, carriers: bool = True) -> tuple[XmlElement, DiagnosticSink]:
    sink = DiagnosticSink()
    made = Pipeline(to_urdf(requested=Requested(model=model, carriers=carriers))).run(document, sink)
    if sink.has_errors:
        return etree.Element("none"), sink
    assert made.format == "urdf"
    version = parse_version(made.version or "1.0")
    root = document_tree(made)
    assert libxml2_errors(root, "urdf", version) == []
    return root, sink


def convert(text: str, version: str = "1.11") -> XmlElement:
    root, sink = lower(read(text, version))
    assert [each.message for each in sink.diagnostics if each.is_error] == []
    return root


def values_at(root: XmlElement, path: str) -> list[str]:
    found = root.xpath(path, namespaces=TF)
    assert isinstance(found, list)
    return [str(each) for each in found]  # pyright: ignore[reportUnknownArgumentType, reportUnknownVariableType] - texts


def joint(kind: str, inside: str = "", name: str = "j", parent: str = "a", child: str = "b") -> str:
    return f"<joint name='{name}' type='{kind}'><parent>{parent}</parent><child>{child}</child>{inside}</joint>"


def arm(kind: str, inside: str = "") -> str:
    return LINK + "<link name='b'/>" + joint(kind, inside)


def link(inside: str, name: str = "a") -> str:
    return f"<link name='{name}'>{inside}</link>"


def visual(inside: str, name: str = "v") -> str:
    return f"<visual name='{name}'>{inside}</visual>"


BOX = "<geometry><box><size>1 2 3</size></box></geometry>"
COLLISION = f"<collision name='{{}}'>{BOX}{{}}</collision>"
INNER = """<model name='inner'><pose>0 0 1 0 0 0</pose><static>false</static><link name='l'/><link name='k'/>
  <frame name='f' attached_to='k'><pose>0 0 1 0 0 0</pose></frame>
  <joint name='j' type='revolute'><parent>l</parent><child>k</child>
  <axis><xyz expressed_in='__model__'>0 1 0</xyz></axis></joint>
  </model>"""
EVERYTHING = (
    LINK
    + link(
        "<pose degrees='true'>1 0 0 90 0 0</pose><gravity>0</gravity>"
        + visual("<geometry><plane/></geometry>", "p")
        + visual(BOX + "<transparency>0.5</transparency><material><emissive>1 1 1 1</emissive></material>")
        + "<sensor name='s' type='imu'><pose relative_to='a'>0 0 0 0 0 0</pose></sensor>",
        "b",
    )
    + joint("revolute", "<axis><limit><dissipation>2</dissipation></limit></axis>")
    + "<frame name='f'/>"
    + INNER
)
