"""The environment variables that a xacro file may read: those of ROS and Gazebo, and those that the caller names."""

from collections.abc import Iterable, Mapping
from fnmatch import fnmatchcase

from twinform.compiler.input.xacro.allowed_files import DeniedError

# a name does not show what is a secret: DBPASS, a connection string or the address of a web hook. So these are listed
# one by one, and no prefix lets in what somebody else has called ROS_SOMETHING.
_USUAL = frozenset({
    "AMENT_CURRENT_PREFIX", "AMENT_PREFIX_PATH", "CMAKE_PREFIX_PATH", "COLCON_CURRENT_PREFIX", "COLCON_PREFIX_PATH",
    "RMW_IMPLEMENTATION", "ROS_AUTOMATIC_DISCOVERY_RANGE", "ROS_DISTRO", "ROS_DOMAIN_ID", "ROS_ETC_DIR", "ROS_HOME",
    "ROS_HOSTNAME", "ROS_IP", "ROS_LOCALHOST_ONLY", "ROS_LOG_DIR", "ROS_MASTER_URI", "ROS_NAMESPACE",
    "ROS_OS_OVERRIDE", "ROS_PACKAGE_PATH", "ROS_PYTHON_VERSION", "ROS_ROOT", "ROS_STATIC_PEERS", "ROS_VERSION",
    "GAZEBO_MASTER_URI", "GAZEBO_MODEL_DATABASE_URI", "GAZEBO_MODEL_PATH", "GAZEBO_PLUGIN_PATH",
    "GAZEBO_RESOURCE_PATH", "GAZEBO_WORLD_LAT", "GAZEBO_WORLD_LON", "GZ_CONFIG_PATH", "GZ_FUEL_CACHE_PATH",
    "GZ_GUI_PLUGIN_PATH", "GZ_IP", "GZ_PARTITION", "GZ_SIM_PHYSICS_ENGINE_PATH", "GZ_SIM_RESOURCE_PATH",
    "GZ_SIM_SYSTEM_PLUGIN_PATH", "GZ_VERSION", "IGNITION_VERSION", "IGN_CONFIG_PATH", "IGN_FUEL_CACHE_PATH",
    "IGN_GAZEBO_RESOURCE_PATH", "IGN_GAZEBO_SYSTEM_PLUGIN_PATH", "IGN_IP", "IGN_PARTITION", "SDF_PATH",
})  # fmt: skip


def variable(name: str, environment: Mapping[str, str], given: Iterable[str] = ()) -> str | None:
    """The value of an environment variable; None where it is not set. `given` are names, in which `*` may stand.

    Raises:
        DeniedError: it is set, and is none of these.
    """
    value = environment.get(name)
    if value is None or name in _USUAL or any(fnmatchcase(name, each) for each in given):
        return value
    message = f"the environment variable {name!r} is set, but is not given to xacro files, since it may be a secret"
    raise DeniedError(message, f"give it with --env {name}, or as an argument")
