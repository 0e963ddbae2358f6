"""Where files go in a package: always inside of it, and never two in one place."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.profile import examples
from twinform.compiler.packaging.package import (
    FileKind,
    Package,
    PackageLayout,
    PackagePlaces,
    is_inner_path,
    safe_name,
)

_KINDS: list[FileKind] = ["mesh", "image", "script", "data"]
_FILES = st.tuples(
    st.lists(st.text(min_size=1) | st.sampled_from(["meshes", "materials", "textures", "A", "a", ".."]), min_size=1),
    st.sampled_from(_KINDS),
    st.text(),
)


@given(st.lists(_FILES, max_size=20))
@examples()
def test_every_file_has_a_place_of_its_own_inside_of_the_package(
    files: list[tuple[list[str], FileKind, str]],
) -> None:
    layout, places = PackageLayout({"model": "m"}), PackagePlaces()
    taken = [places.take(layout.places(parts, kind, holder)) for parts, kind, holder in files]
    assert len({place.casefold() for place in taken}) == len(taken)
    assert all(map(is_inner_path, taken))
    assert len(Package("m", dict.fromkeys(taken, b"")).files) == len(taken)


def test_no_file_is_where_a_folder_is() -> None:
    places = PackagePlaces()
    assert places.take(["meshes/a.stl"]) == "meshes/a.stl"
    assert places.take(["meshes/a.stl/b.stl"]) == "meshes/b_2.stl"
    assert places.take(["meshes/c.stl/b.stl"]) == "meshes/c.stl/b.stl"
    assert places.take(["meshes/c.stl"]) == "meshes/c_2.stl"
    assert places.take_folder(["meshes"], ["x.png", "A.STL"]) == "meshes_2"


@pytest.mark.parametrize("paths", [["../a"], ["/a"], ["a//b"], ["a/"], [""], ["a\\b"], ["a", "A"], ["a", "a/b"]])
def test_other_paths_are_in_no_package(paths: list[str]) -> None:
    with pytest.raises(ValueError, match=r"package|one file|below a file"):
        Package("m", dict.fromkeys(paths, b""))


@given(st.text())
def test_a_safe_name_is_safe_and_stays(name: str) -> None:
    safe = safe_name(name)
    assert safe.isascii()
    assert is_inner_path(safe)
    assert not safe.startswith((".", "-"))
    assert safe_name(safe) == safe


def test_files_keep_the_path_below_their_folder() -> None:
    layout = PackageLayout({})
    places = {
        ("robots", "a1", "meshes", "visual", "hip.dae"): "meshes/visual/hip.dae",
        ("meshes", "textures", "skin.png"): "meshes/textures/skin.png",
        ("materials", "textures", "skin.png"): "materials/textures/skin.png",
        ("media", "skin.png"): "materials/textures/skin.png",
        ("skin.png",): "materials/textures/skin.png",
        ("deep", "er", "skin.png"): "materials/textures/deep/er/skin.png",
        ("materials", "scripts", "a.material"): "materials/scripts/a.material",
    }
    kinds: dict[str, FileKind] = {"dae": "mesh", "png": "image", "material": "script"}
    for parts, place in places.items():
        assert next(layout.places(parts, kinds[parts[-1].rpartition(".")[2]])) == place
