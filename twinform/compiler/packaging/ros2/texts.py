"""The generated files of a ROS 2 package, by their paths in it."""

from twinform.compiler.packaging.ros2.contents import PackageContents
from twinform.compiler.packaging.ros2.controllers import controllers_yaml
from twinform.compiler.packaging.ros2.gazebo_control import CONTROLLERS, control_package
from twinform.compiler.packaging.ros2.manifest import package_xml
from twinform.compiler.packaging.ros2.rendering import cmake_text, python_text, render
from twinform.compiler.packaging.ros2.rviz import rviz_config
from twinform.passes.plugins.bridge import bridge_yaml
from twinform.passes.plugins.ground_clearance import lowest_point

_LAUNCH = (
    "ament_index_python",
    "launch",
    "launch_ros",
    "robot_state_publisher",
    "rviz2",
    "ros_gz_bridge",
    "ros_gz_sim",
)
_SLIDERS = ("joint_state_publisher", "joint_state_publisher_gui")
_HOOKS = ("gazebo_resource_path.dsv.in", "gazebo_resource_path.sh.in")
_WORLD = "world"


def generated_files(contents: PackageContents) -> dict[str, str]:
    """The files that are text of our own: all but the URDF, the world, and meshes with their textures."""
    name = contents.package
    files = {
        "package.xml": package_xml(contents, _depends(contents)),
        "launch/display.launch.py": _launch(contents, "display.launch.py.in"),
        "launch/gazebo.launch.py": _launch(contents, "gazebo.launch.py.in"),
        f"rviz/{name}.rviz": rviz_config(contents),
        "config/bridge.yaml": bridge_yaml(contents.bridges),
    }
    if contents.controllers:
        files[CONTROLLERS] = controllers_yaml(contents.controllers)
    variable = "IGN_GAZEBO_RESOURCE_PATH" if contents.release == "fortress" else "GZ_SIM_RESOURCE_PATH"
    files |= {f"env-hooks/{each}": render(each, {"variable": variable}, {}) for each in _HOOKS}
    return {**files, "CMakeLists.txt": _cmake(contents, files)}


def _depends(contents: PackageContents) -> list[str]:
    found = [*_LAUNCH, *(_SLIDERS if contents.moves else ()), *(each.package for each in contents.controllers)]
    if contents.controlled:
        found += ["controller_manager", control_package(contents.release)]
    return found


def _cmake(contents: PackageContents, files: dict[str, str]) -> str:
    folders = {path.partition("/")[0] for path in files if "/" in path} - {"env-hooks"}
    folders |= {"urdf", "worlds", *contents.folders}
    values = {
        "package": contents.package,
        "folders": " ".join(map(cmake_text, sorted(folders))),
        "files": " ".join(map(cmake_text, contents.files)),
    }
    return render("CMakeLists.txt.in", values, {"files": bool(contents.files)})


def _launch(contents: PackageContents, template: str) -> str:
    values = {
        "package": contents.package,
        "robot": python_text(contents.model.name),
        "height": f"{_height(contents):g}",
        "controllers": "\n".join(f"    {python_text(each.name)}," for each in contents.started),
    }
    moves, controlled = contents.moves, contents.controlled
    facts = {"moves": moves, "rigid": not moves, "controlled": controlled, "uncontrolled": not controlled}
    return render(template, values, facts)


def _height(contents: PackageContents) -> float:
    """How high above the ground the root link begins, so that the robot stands on it; one that is held begins at 0."""
    model = contents.model
    if any(link.name == _WORLD for link in model.links):
        return 0.0
    depth = lowest_point(model)
    return round(-depth, 9) if depth else 0.0
