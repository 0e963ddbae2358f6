"""Where URIs lead, in a small tree of folders."""

import pickle
from collections.abc import Mapping
from pathlib import Path

import pytest

from tests.write_files import write_files
from twinform.compiler.resolve_uris import SearchPath, UriError
from twinform.diagnostics import rules

TREE = {
    "gz/crate/model.sdf": "",
    "classic/lamp/model.sdf": "",
    "ament/share/arm_description/meshes/hand.stl": "",
    "ws/src/repo/legs/package.xml": "<package><name>legs_description</name></package>",
    "ws/src/repo/legs/urdf/leg.xacro": "",
    "project/models/table/model.sdf": "",
    "project/twinform.toml": "",
    "project/worlds/room.sdf": "",
    "project/worlds/near.sdf": "",
    "home/.gz/fuel/fuel.gazebosim.org/openrobotics/models/euro pallet/2/model.sdf": "",
    "home/.gz/fuel/fuel.gazebosim.org/openrobotics/models/euro pallet/10/model.sdf": "",
    "secret.sdf": "",
}
VARIABLES = {
    "GZ_SIM_RESOURCE_PATH": "gz",
    "GAZEBO_MODEL_PATH": "classic",
    "AMENT_PREFIX_PATH": "ament",
    "ROS_PACKAGE_PATH": "ws/src",
    "HOME": "home",
}
PALLET = "https://fuel.gazebosim.org/1.0/OpenRobotics/models/Euro pallet"
PALLETS = "home/.gz/fuel/fuel.gazebosim.org/openrobotics/models/euro pallet"
FOUND = {
    "model://crate": "gz/crate",
    "model://crate/model.sdf": "gz/crate/model.sdf",
    "  model://crate  ": "gz/crate",
    "model://lamp/./model.sdf": "classic/lamp/model.sdf",
    "model://table": "project/models/table",
    "package://arm_description/meshes/hand.stl": "ament/share/arm_description/meshes/hand.stl",
    "model://arm_description/meshes/hand.stl": "ament/share/arm_description/meshes/hand.stl",
    "package://legs_description/urdf/leg.xacro": "ws/src/repo/legs/urdf/leg.xacro",
    "near.sdf": "project/worlds/near.sdf",
    "../models/table": "project/worlds/../models/table",
    "crate": "gz/crate",
    "file://near.sdf": "project/worlds/near.sdf",
    PALLET: f"{PALLETS}/10",
    f"{PALLET}/2": f"{PALLETS}/2",
    f"{PALLET}/tip/files/model.sdf": f"{PALLETS}/10/model.sdf",
    PALLET.replace(" ", "%20").replace("gazebosim", "ignitionrobotics"): f"{PALLETS}/10",
}
REFUSED = {
    "model://nothing": (rules.UNRESOLVED_URI, "is not found"),
    "package://legs_description/no.xacro": (rules.UNRESOLVED_URI, "is not found"),
    "model://crate/../../secret.sdf": (rules.URI_LEAVES_FOLDER, "leads out of the folders"),
    "package://../secret.sdf": (rules.URI_LEAVES_FOLDER, "leads out of the folders"),
    "model://": (rules.UNRESOLVED_URI, "names no model"),
    "model:///secret.sdf": (rules.UNRESOLVED_URI, "names no model"),
    "model://" + "x" * 5000: (rules.UNRESOLVED_URI, "is not found"),
    "gopher://crate": (rules.UNRESOLVED_URI, "'gopher'"),
    "https://fuel.gazebosim.org/1.0/OpenRobotics/models/Nothing": (rules.UNRESOLVED_URI, "nothing is fetched"),
    "https://fuel.gazebosim.org/1.0/../models/..": (rules.UNRESOLVED_URI, "nothing is fetched"),
    "": (rules.UNRESOLVED_URI, "is not found"),
}


@pytest.fixture
def tree(tmp_path: Path) -> Path:
    return write_files(tmp_path, TREE)


def _variables(tree: Path) -> Mapping[str, str]:
    return {name: str(tree / folder) for name, folder in VARIABLES.items()}


@pytest.fixture
def search(tree: Path) -> SearchPath:
    return SearchPath.of(environment=_variables(tree))


@pytest.mark.parametrize(("uri", "path"), FOUND.items())
def test_a_uri_leads_to_the_first_place_that_has_it(tree: Path, search: SearchPath, uri: str, path: str) -> None:
    assert search.find(uri, tree / "project/worlds/room.sdf") == tree / path


@pytest.mark.parametrize(("uri", "why"), REFUSED.items(), ids=lambda each: str(each)[:40])
def test_a_uri_that_leads_nowhere_is_refused(tree: Path, search: SearchPath, uri: str, why: tuple[object, str]) -> None:
    with pytest.raises(UriError) as caught:
        search.find(uri, tree / "project/worlds/room.sdf")
    assert caught.value.rule is why[0]
    assert why[1] in caught.value.message


def test_the_error_has_where_it_was_looked_for(tree: Path, search: SearchPath) -> None:
    with pytest.raises(UriError) as caught:
        search.find("model://nothing", tree / "project/worlds/room.sdf")
    assert str(tree / "gz") in (caught.value.help or "")
    assert "--path DIR" in (caught.value.help or "")


def test_own_folders_come_before_those_of_the_environment(tree: Path) -> None:
    own = tree / "own"
    (own / "crate").mkdir(parents=True)
    search = SearchPath.of([own], _variables(tree))
    assert search.find("model://crate", tree / "project/worlds/room.sdf") == own / "crate"


def test_a_link_out_of_the_folders_is_refused_unless_its_target_is_named(tree: Path, tmp_path: Path) -> None:
    (tree / "gz/crate/out.sdf").symlink_to(tree / "secret.sdf")
    beside = tree / "project/worlds/room.sdf"
    (tree / "project/.git").mkdir()
    with pytest.raises(UriError, match="outside of the folders"):
        SearchPath.of(environment=_variables(tree)).find("model://crate/out.sdf", beside)
    allowed = SearchPath.of([tmp_path], _variables(tree))
    assert allowed.find("model://crate/out.sdf", beside) == tree / "gz/crate/out.sdf"


def test_a_package_is_known_by_its_manifest_and_by_its_folder(tree: Path) -> None:
    inside = tree / "ws/src/repo/legs/urdf/leg.xacro"
    search = SearchPath.of(environment={"HOME": str(tree / "home")})
    assert search.package("legs_description", inside) == tree / "ws/src/repo/legs"
    assert search.package("legs", inside) == tree / "ws/src/repo/legs"


def test_nothing_above_the_repository_is_looked_at(tree: Path) -> None:
    (tree / "project/worlds/.git").mkdir()
    search = SearchPath.of(environment={})
    with pytest.raises(UriError):
        search.find("model://table", tree / "project/worlds/room.sdf")


def test_a_search_path_goes_to_other_processes_with_what_it_knows() -> None:
    assert pickle.loads(pickle.dumps(SearchPath.of([], {}))) == SearchPath.of([], {})
