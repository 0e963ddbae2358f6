# pyright: basic, reportMissingTypeStubs=false
"""What catkin_pkg and yamllint say, which have no types, in types."""

from dataclasses import dataclass
from html import unescape
from pathlib import Path

from catkin_pkg.package import parse_package
from yamllint import linter
from yamllint.config import YamlLintConfig

_STYLE = YamlLintConfig("{extends: relaxed, rules: {line-length: disable}}")


@dataclass(frozen=True)
class Manifest:
    """A `package.xml` as catkin reads it, with its warnings."""

    name: str
    version: str
    build_type: str
    description: str
    maintainers: tuple[tuple[str, str], ...]
    licenses: tuple[str, ...]
    exec_depends: frozenset[str]
    warnings: tuple[str, ...]


def manifest(folder: Path) -> Manifest:
    """The manifest of a package; raises where catkin takes it for none."""
    warnings: list[str] = []
    package = parse_package(str(folder), warnings=warnings)
    package.validate(warnings=warnings)
    return Manifest(
        name=package.name,
        version=package.version,
        build_type=package.get_build_type(),
        description=unescape(package.description),  # catkin gives it as XML
        maintainers=tuple((each.name, each.email) for each in package.maintainers),
        licenses=tuple(str(each) for each in package.licenses),
        exec_depends=frozenset(each.name for each in package.exec_depends),
        warnings=tuple(warnings),
    )


def yaml_problems(text: str) -> list[str]:
    """What yamllint finds in a text; long lines are no problem, since names may be long."""
    return [str(each) for each in linter.run(text, _STYLE)]
