"""What a package says where no option says it: as the package or model around the source."""

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.write_files import write_files
from twinform.compiler.packaging.order import PLACEHOLDERS, PackageDetails, details_around

PACKAGE = """<package format="3"><name>arm</name><version>1.2.3</version>
<description>An <b>arm</b>,
  made of steel.</description>
<maintainer email=" ann@example.org ">Ann Onym</maintainer><maintainer email="bob@example.org">Bob</maintainer>
<license>BSD-3-Clause</license><license file="LICENSE">Apache-2.0</license><author email="c@example.org">Cee</author>
</package>"""
MODEL = """<model><name>Arm</name><version>1.0</version><sdf version="1.6">model.sdf</sdf>
<author><name>Dee</name><email>d@example.org</email></author><description> An arm. </description></model>"""
UNSAID = """<package><version>one</version><description>{description}</description>
<maintainer email="{email}">{maintainer}</maintainer><license>{license}</license></package>""".format_map(PLACEHOLDERS)
SAID = PackageDetails(
    description="An arm, made of steel.",
    version="1.2.3",
    author="Cee",
    maintainer="Ann Onym",
    email="ann@example.org",
    license="BSD-3-Clause, Apache-2.0",
)
SAID_OF_MODEL = PackageDetails(description="An arm.", version="1.0.0", maintainer="Dee", email="d@example.org")
NOTHING = PackageDetails()
BOMB = '<!DOCTYPE p [<!ENTITY a "ha"><!ENTITY b "&a;&a;">]><package><description>&b;</description></package>'


@pytest.mark.parametrize(
    ("files", "expected"),
    [
        ({"package.xml": PACKAGE}, SAID),
        ({"urdf/package.xml": MODEL.replace("model>", "package>"), "package.xml": PACKAGE}, None),
        ({"model.config": MODEL}, SAID_OF_MODEL),
        ({"package.xml": PACKAGE, "model.config": MODEL}, SAID),
        ({"package.xml": PACKAGE, "urdf/model.config": MODEL}, SAID_OF_MODEL),
        ({"package.xml": UNSAID}, NOTHING),
        ({"package.xml": "<package/>"}, NOTHING),
        ({"package.xml": "<package>"}, NOTHING),
        ({"package.xml": ""}, NOTHING),
        ({"package.xml": PACKAGE + " " * 2**20}, NOTHING),
        ({"package.xml": BOMB}, NOTHING),
        ({}, NOTHING),
    ],
    ids=[
        "package", "nearest", "model", "package before model", "model nearer", "unsaid", "empty element", "broken",
        "empty", "huge", "entities", "none",
    ],
)  # fmt: skip
def test_details_are_those_of_the_nearest_package_or_model(
    files: dict[str, str], expected: PackageDetails | None, tmp_path: Path
) -> None:
    write_files(tmp_path, files)
    found = details_around(tmp_path / "urdf" / "arm.urdf")
    assert found == expected if expected is not None else found.version == "1.0.0"


TEXTS = st.sampled_from(["", "a", "b"])
DETAILS = st.builds(PackageDetails, **dict.fromkeys(PackageDetails.__dataclass_fields__, TEXTS))


@given(DETAILS, DETAILS)
def test_what_is_given_wins_and_people_are_not_mixed(said: PackageDetails, others: PackageDetails) -> None:
    told = said.or_else(others)
    for name in ("description", "version", "author", "license"):
        assert getattr(told, name) == (getattr(said, name) or getattr(others, name))
    people = {(said.maintainer, said.email), (others.maintainer, others.email)}
    assert (told.maintainer, told.email) in people
    assert told.or_else(others) == told or (told.maintainer, told.email) == ("", "")
