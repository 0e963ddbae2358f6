"""The built-in passes, by their names in a pipeline: modules below `twinform.passes`, and classes.

Made by `make generate` from the entry points of `pyproject.toml`; do not edit it.
"""

from collections.abc import Mapping

BUILT_IN: Mapping[str, str] = {
    "add-actuators": "joints.add_actuators:AddActuators",
    "add-plugin": "plugins.add_plugin:AddPlugin",
    "add-root": "structure.add_root:AddRoot",
    "add-sensor": "plugins.add_sensor:AddSensor",
    "attach": "structure.attach:Attach",
    "balance-inertia": "inertia.balance_inertia:BalanceInertia",
    "bridge-config": "plugins.bridge_config:BridgeConfig",
    "check-inertia": "inertia.check_inertia:CheckInertia",
    "check-limits": "joints.check_limits:CheckLimits",
    "check-plugins": "plugins.check_plugins:CheckPlugins",
    "convert-meshes": "meshes.convert_meshes:ConvertMeshes",
    "decimate-visuals": "meshes.decimate_visuals:DecimateVisuals",
    "drop": "structure.drop:Drop",
    "drop-bare-scripts": "appearance.drop_bare_scripts:DropBareScripts",
    "drop-flat-shapes": "appearance.drop_flat_shapes:DropFlatShapes",
    "drop-repeats": "structure.drop_repeats:DropRepeats",
    "fill-inertia": "inertia.fill_inertia:FillInertia",
    "fill-limits": "joints.fill_limits:FillLimits",
    "flatten-models": "structure.flatten_models:FlattenModels",
    "limit-sensors": "meshes.limit_sensors:LimitSensors",
    "lump-fixed-joints": "structure.lump_fixed_joints:LumpFixedJoints",
    "materials": "appearance.materials:Materials",
    "migrate-gazebo-classic": "classic.migrate_gazebo_classic:MigrateGazeboClassic",
    "order-limits": "joints.order_limits:OrderLimits",
    "prefix-names": "structure.prefix_names:PrefixNames",
    "rename": "structure.rename:Rename",
    "replace-continuous": "joints.replace_continuous:ReplaceContinuous",
    "reroot": "structure.reroot:Reroot",
    "rewrite-uris": "appearance.rewrite_uris:RewriteUris",
    "ros2-control-from-transmissions": "joints.ros2_control_from_transmissions:Ros2ControlFromTransmissions",
    "set-surface": "appearance.set_surface:SetSurface",
    "simplify-collisions": "meshes.simplify_collisions:SimplifyCollisions",
    "split-massless": "inertia.split_massless:SplitMassless",
    "tag-shapes": "structure.tag_shapes:TagShapes",
    "tidy-materials": "appearance.tidy_materials:TidyMaterials",
    "tidy-shapes": "appearance.tidy_shapes:TidyShapes",
    "tidy-transmissions": "joints.tidy_transmissions:TidyTransmissions",
    "tighten-limits": "joints.tighten_limits:TightenLimits",
    "transmissions-from-ros2-control": "joints.transmissions_from_ros2_control:TransmissionsFromRos2Control",
    "weld-to-world": "structure.weld_to_world:WeldToWorld",
}
