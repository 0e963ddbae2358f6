import tomllib
from collections.abc import Iterator
from importlib.metadata import Distribution, EntryPoint, entry_points
from pathlib import Path
from typing import ClassVar

import pytest

from tests.distributions import Install, write_distribution
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Document
from twinform.passes import GROUP, Pass, RegistryError, UnknownPassError, collect, find_pass, registered_passes

PROJECT = Path(__file__).parents[4] / "pyproject.toml"


class Sample(Pass):
    """Does nothing."""

    name: ClassVar[str] = "sample"

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        del sink
        return document


def entries(folder: Path, distribution: str, *names: str) -> Iterator[EntryPoint]:
    """The entry points of a distribution in a folder."""
    folder = folder / distribution
    folder.mkdir()
    write_distribution(folder, distribution, dict.fromkeys(names, "nowhere:Nothing"))
    (found,) = Distribution.discover(path=[str(folder)])
    return iter(found.entry_points)


def test_built_in_passes_come_through_the_entry_points() -> None:
    declared = tomllib.loads(PROJECT.read_text())["project"]["entry-points"][GROUP]
    installed = {
        each.name: each.value for each in entry_points(group=GROUP) if each.dist and each.dist.name == "twinform"
    }
    assert installed == declared, "install the project again: .venv/bin/pip install -e . --no-deps"


def test_every_installed_pass_loads_and_is_documented() -> None:
    for name, each in registered_passes().items():
        kind = each.load()
        assert kind.name == name
        assert kind.__doc__
        assert kind.example


def test_passes_are_sorted_by_name(tmp_path: Path) -> None:
    found = collect([*entries(tmp_path, "one", "zebra", "apple"), *entries(tmp_path, "two", "mango")])
    assert list(found) == ["apple", "mango", "zebra"]
    assert [each.owner for each in found.values()] == ["one", "two", "one"]


def test_two_passes_of_one_name_are_an_error_that_names_both_owners(tmp_path: Path) -> None:
    with pytest.raises(RegistryError, match="one and two both register a pass called apple"):
        collect([*entries(tmp_path, "two", "apple"), *entries(tmp_path, "one", "apple")])


def test_discovery_imports_nothing(tmp_path: Path) -> None:
    assert collect(entries(tmp_path, "one", "apple"))["apple"].entry.value == "nowhere:Nothing"


def test_a_pass_of_another_package_is_found(install: Install) -> None:
    install("stranger", {"sample": f"{__name__}:Sample"})
    assert find_pass("sample") is Sample
    assert registered_passes()["sample"].owner == "stranger"


@pytest.mark.parametrize(
    ("name", "value", "complaint"),
    [
        ("gone", "no_such_module:Thing", "stranger registers gone but it cannot be imported"),
        ("gone", f"{__name__}:Thing", "stranger registers gone but it cannot be imported"),
        ("path", "pathlib:Path", "stranger registers path but pathlib:Path is no subclass of Pass"),
        ("other", f"{__name__}:Sample", "stranger registers other but .* calls itself sample"),
    ],
)
def test_a_pass_that_is_installed_wrongly_names_its_owner(
    name: str, value: str, complaint: str, tmp_path: Path
) -> None:
    write_distribution(tmp_path, "stranger", {name: value})
    (found,) = Distribution.discover(path=[str(tmp_path)])
    with pytest.raises(RegistryError, match=complaint):
        collect(found.entry_points)[name].load()


def test_an_unknown_name_is_an_error() -> None:
    with pytest.raises(UnknownPassError, match="no-such-pass"):
        find_pass("no-such-pass")
