"""What a plugin of Gazebo Classic reads of its parameters. Those for ROS 1 and for ROS 2 have files of one name."""

from twinform.ir import Plugin
from twinform.passes.plugins.catalog import classic_plugins_of_file
from twinform.passes.plugins.catalog_types import PluginKind

# The element with the settings of a node, which only plugins for ROS 2 have.
_ROS = "ros"


def ros2_kind(plugin: Plugin) -> PluginKind | None:
    """The kind of a plugin that is for ROS 2; None for one that is for ROS 1, or may be.

    It has `<ros>`, or its file is only there for ROS 2, or its parameters are.
    """
    kinds = classic_plugins_of_file(plugin.filename or "")
    if "ros2" not in kinds:
        return None
    written = {child.name for child in plugin.content}
    new = {row.name for row in kinds["ros2"].parameters}
    old = {row.name for row in kinds["noetic"].parameters} if "noetic" in kinds else set[str]()
    # Files of gazebo_ros_pkgs have one name for ROS 1 and ROS 2, and many robots keep parameters of
    # both in one plugin. A mixture counts as ROS 1 unless <ros> says otherwise: nothing that was
    # read then gets lost.
    is_new = _ROS in written or not old or (bool(written & new - old) and not written & old - new)
    return kinds["ros2"] if is_new else None


def as_read(plugin: Plugin) -> Plugin:
    """The plugin, and where it is for ROS 2 without the parameters that only those for ROS 1 read."""
    kind = ros2_kind(plugin)
    if kind is None or kind.free:
        return plugin
    # What the plugin of ROS 2 does not read had no effect, so it must have none after the migration
    # either.
    content = tuple(child for child in plugin.content if kind.parameter(child.name) is not None)
    return plugin if len(content) == len(plugin.content) else plugin.copy(content=content)
