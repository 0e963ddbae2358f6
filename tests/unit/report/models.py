"""Files that reports are about in tests."""

from pathlib import Path
from xml.sax.saxutils import quoteattr

from twinform.ir import Document
from twinform.view import StandaloneView

EXAMPLES = Path(__file__).parents[3] / "examples"
PAGE = (
    '<!doctype html><html lang="en"><head></head><body><button>reset</button>'
    '<script>document.title = "view"</script></body></html>'
)
EVIL = '<script>alert(1)</script>\'"onclick="alert(2)</style>'


def stand_in(*_: object) -> StandaloneView:
    """Instead of the page of the view."""
    return StandaloneView(PAGE)


def no_page(first: Document, *_: object) -> StandaloneView:
    """Instead of the page of the view, where one must not be made."""
    raise AssertionError(first.format)


def hostile(name: str = EVIL, mass: float = 1) -> str:
    """A robot in which every name is hostile, with a finding about one and parts that SDF does not have."""
    evil, other = quoteattr(name), quoteattr(f"{name}2")
    return f"""<robot name={evil}><link name={evil}><inertial><mass value="{mass}"/>
      <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
      <visual name={evil}><geometry><mesh filename={evil}/></geometry></visual></link>
    <link name={other}/><joint name={evil} type="revolute"><parent link={evil}/><child link={other}/>
      <limit lower="0" upper="1" effort="1" velocity="1"/><calibration rising="1"/></joint>
    <transmission name={evil}><type>a</type><joint name={evil}/></transmission>
    <gazebo reference={other}><sensor name={evil} type="imu"/></gazebo></robot>"""


WRONG = """<robot name="broken"><link name="base"/>
<joint name="j" type="fixed"><parent link="bse"/><child link="base"/></joint></robot>
"""


def two_versions(folder: Path) -> tuple[Path, Path]:
    """Write a robot twice, in files of one name: with a mesh that is not there, and then heavier."""
    mesh = f'<visual><geometry><mesh filename="{folder.as_uri()}/before/gone.stl"/></geometry></visual>'
    text = (EXAMPLES / "arm.urdf").read_text().replace("<visual>", f"{mesh}<visual>", 1)
    made: list[Path] = []
    for name, mass in (("before", "4"), ("after", "5")):
        (folder / name).mkdir()
        made.append(folder / name / "arm.urdf")
        made[-1].write_text(text.replace('<mass value="4"/>', f'<mass value="{mass}"/>'))
    return made[0], made[1]
