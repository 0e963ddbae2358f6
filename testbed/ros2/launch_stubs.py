"""As much of `launch` and `launch_ros` as launch files of packages use, without ROS: their names, and nothing else."""

import runpy
import shlex
import subprocess
import sys
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from types import ModuleType
from unittest.mock import patch


@dataclass
class LaunchConfiguration:
    variable_name: str


@dataclass
class Command:
    """What a command prints; a launch ends where it fails or, unless told otherwise, says anything on stderr."""

    command: Sequence[str | LaunchConfiguration]
    on_stderr: str = field(default="fail", kw_only=True)


Text = str | LaunchConfiguration | Command | Sequence[str | LaunchConfiguration]


@dataclass
class DeclareLaunchArgument:
    name: str
    default_value: str = field(kw_only=True)
    description: str = field(kw_only=True)


@dataclass
class IfCondition:
    predicate_expression: LaunchConfiguration


@dataclass
class UnlessCondition:
    predicate_expression: LaunchConfiguration


@dataclass
class ParameterValue:
    value: Text
    value_type: type = field(kw_only=True)


@dataclass(kw_only=True)
class Node:
    package: str
    executable: str
    arguments: Sequence[Text] = ()
    parameters: Sequence[Mapping[str, ParameterValue | bool]] = ()
    condition: IfCondition | UnlessCondition | None = None
    output: str = "log"


@dataclass
class PythonLaunchDescriptionSource:
    launch_file_path: str


@dataclass
class IncludeLaunchDescription:
    launch_description_source: PythonLaunchDescriptionSource
    launch_arguments: Sequence[tuple[str, Text]] = field(kw_only=True)


@dataclass(kw_only=True)
class OnProcessExit:
    target_action: Node
    on_exit: Sequence[Node]


@dataclass
class RegisterEventHandler:
    event_handler: OnProcessExit


Action = DeclareLaunchArgument | Node | IncludeLaunchDescription | RegisterEventHandler


@dataclass
class LaunchDescription:
    initial_entities: Sequence[Action]

    @property
    def arguments(self) -> dict[str, str]:
        """The arguments with their defaults."""
        return {
            each.name: each.default_value for each in self.initial_entities if isinstance(each, DeclareLaunchArgument)
        }

    @property
    def nodes(self) -> list[Node]:
        """The nodes that are started, also those behind others."""
        found = [each for each in self.initial_entities if isinstance(each, Node)]
        handlers = [each.event_handler for each in self.initial_entities if isinstance(each, RegisterEventHandler)]
        return [*found, *(node for handler in handlers for node in handler.on_exit)]

    def node(self, package: str) -> Node:
        """The one node of a package."""
        (found,) = [node for node in self.nodes if node.package == package]
        return found

    def perform(self, text: Text) -> str:
        """The text that a substitution stands for; an argument that is not declared is an error."""
        if isinstance(text, LaunchConfiguration):
            return self.arguments[text.variable_name]
        if isinstance(text, Command):
            done = subprocess.run(shlex.split(self.perform(text.command)), capture_output=True, text=True, check=True)
            if done.stderr and text.on_stderr == "fail":
                raise RuntimeError(done.stderr)
            return done.stdout
        return text if isinstance(text, str) else "".join(map(self.perform, text))


_MODULES: Mapping[str, Sequence[type]] = {
    "launch": [LaunchDescription],
    "launch.actions": [DeclareLaunchArgument, IncludeLaunchDescription, RegisterEventHandler],
    "launch.conditions": [IfCondition, UnlessCondition],
    "launch.event_handlers": [OnProcessExit],
    "launch.launch_description_sources": [PythonLaunchDescriptionSource],
    "launch.substitutions": [Command, LaunchConfiguration],
    "launch_ros": [],
    "launch_ros.actions": [Node],
    "launch_ros.parameter_descriptions": [ParameterValue],
    "ament_index_python": [],
}


def described(launch_file: Path, prefix: Path) -> LaunchDescription:
    """What a launch file describes, where packages are installed below a folder."""
    with patch.dict(sys.modules, dict(_modules(prefix))):
        made = runpy.run_path(str(launch_file))["generate_launch_description"]()
    assert isinstance(made, LaunchDescription)
    return made


def texts(description: LaunchDescription) -> Iterator[str]:
    """All texts of a description, as they are when it runs."""
    yield from description.arguments.values()
    for node in description.nodes:
        yield from map(description.perform, node.arguments)
        for parameters in node.parameters:
            given = [each for each in parameters.values() if isinstance(each, ParameterValue)]
            yield from (description.perform(each.value) for each in given)
    for each in description.initial_entities:
        if isinstance(each, IncludeLaunchDescription):
            yield each.launch_description_source.launch_file_path


def _modules(prefix: Path) -> Iterator[tuple[str, ModuleType]]:
    for name, contents in _MODULES.items():
        module = ModuleType(name)
        for each in contents:
            module.__dict__[each.__name__] = each
        yield name, module

    def get_package_share_directory(package_name: str) -> str:
        return str(prefix / "share" / package_name)

    packages = ModuleType("ament_index_python.packages")
    packages.__dict__["get_package_share_directory"] = get_package_share_directory
    yield packages.__name__, packages
