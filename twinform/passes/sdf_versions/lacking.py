"""What each version of SDF lacks: made by `make generate` from the facts tables, not to be edited."""

from collections.abc import Mapping

INCOMPLETE: Mapping[str, str] = {
    "1.2": """
actor air_pressure air_speed altimeter audio_source camera collision forcetorque frame geometry gps gui
heightmap_shape imu include inertial inertial_pose joint lidar light light_state link link_state magnetometer
material mesh_shape model model_state navsat noise particle_emitter physics population pose projector ray road
robot scene sdf sensor sonar spherical_coordinates state surface visual world
""",
    "1.3": """
actor air_pressure air_speed altimeter audio_source camera collision forcetorque frame geometry gps gui
heightmap_shape imu include inertial inertial_pose joint lidar light light_state link link_state magnetometer
material mesh_shape model model_state navsat noise particle_emitter physics population pose projector ray road
robot scene sdf sensor sonar spherical_coordinates state surface visual world
""",
    "1.4": """
actor air_pressure air_speed altimeter audio_source camera collision forcetorque frame geometry gps gui
heightmap_shape imu include inertial inertial_pose joint lidar light light_state link link_state magnetometer
material mesh_shape model model_state navsat noise particle_emitter physics population pose projector ray road
robot scene sdf sensor sonar spherical_coordinates state surface visual world
""",
    "1.5": """
actor air_pressure air_speed altimeter audio_source camera collision forcetorque frame geometry gps gui
heightmap_shape imu include inertial inertial_pose joint lidar light light_state link link_state magnetometer
material mesh_shape model model_state navsat noise particle_emitter physics population pose projector ray road
robot scene sdf sensor sonar spherical_coordinates state surface visual world
""",
    "1.6": """
actor audio_source camera collision forcetorque frame geometry gui imu include inertial inertial_pose joint
lidar light light_state link link_state material mesh_shape model model_state particle_emitter physics
population pose projector ray road robot scene sdf sensor spherical_coordinates state visual world
""",
    "1.7": """
actor audio_source camera collision frame geometry gui imu include inertial inertial_pose joint lidar light
light_state link link_state mesh_shape model model_state particle_emitter physics population pose projector ray
robot scene sdf sensor spherical_coordinates state visual world
""",
    "1.8": """
actor audio_source camera collision frame geometry gui imu include inertial inertial_pose joint lidar light
light_state link link_state mesh_shape model model_state particle_emitter physics population pose projector ray
robot scene sdf sensor spherical_coordinates state visual world
""",
    "1.9": """
actor audio_source camera collision frame geometry gui imu include inertial joint light light_state link
link_state mesh_shape model model_state particle_emitter physics population pose projector robot sdf sensor
spherical_coordinates state visual world
""",
    "1.10": """
actor audio_source camera collision frame geometry gui imu include inertial joint light light_state link
link_state mesh_shape model model_state particle_emitter physics population pose projector robot sdf sensor
state visual world
""",
    "1.11": """
actor audio_source camera collision frame geometry gui imu include inertial joint light light_state link
link_state mesh_shape model model_state particle_emitter physics population pose projector robot sdf sensor
state visual world
""",
    "1.12": """
actor audio_source camera collision frame geometry gui imu include inertial joint light light_state link
link_state mesh_shape model model_state particle_emitter physics population pose projector robot sdf sensor
state visual world
""",
}
"""Definitions that lack something in a version, at any depth, that another version has."""

LACKING: Mapping[str, str] = {
    "1.2": """
Axis.expressed_in Axis.mimic Axis.use_parent_model_frame Capsule Cone Dynamics.spring_reference
Dynamics.spring_stiffness Ellipsoid Empty Include.merge Include.placement_frame Inertial.auto Inertial.pose
Joint.gearbox_ratio Joint.gearbox_reference_body Joint.screw_thread_pitch Joint.sensors Light.intensity
Limit.dissipation Limit.stiffness Link.enable_wind Link.lights Material.albedo_map Model.canonical_link
Model.enable_wind Model.frames Model.models Model.placement_frame Model.self_collide Polyline Pose.degrees
Pose.relative_to Pose.rotation_format Sensor.enable_metrics Sensor.frame_id Visual.plugins World.frames
World.gravity
""",
    "1.3": """
Axis.expressed_in Axis.mimic Axis.use_parent_model_frame Capsule Cone Dynamics.spring_reference
Dynamics.spring_stiffness Ellipsoid Include.merge Include.placement_frame Inertial.auto Inertial.pose
Joint.gearbox_ratio Joint.gearbox_reference_body Joint.screw_thread_pitch Joint.sensors Light.intensity
Limit.dissipation Limit.stiffness Link.enable_wind Link.lights Material.albedo_map Model.canonical_link
Model.enable_wind Model.frames Model.models Model.placement_frame Model.self_collide Polyline Pose.degrees
Pose.relative_to Pose.rotation_format Sensor.enable_metrics Sensor.frame_id World.frames World.gravity
""",
    "1.4": """
Axis.expressed_in Axis.mimic Axis.use_parent_model_frame Capsule Cone Dynamics.spring_reference
Dynamics.spring_stiffness Ellipsoid Include.merge Include.placement_frame Inertial.auto Inertial.pose
Joint.screw_thread_pitch Light.intensity Link.enable_wind Link.lights Material.albedo_map Model.canonical_link
Model.enable_wind Model.frames Model.models Model.placement_frame Model.self_collide Polyline Pose.degrees
Pose.relative_to Pose.rotation_format Sensor.enable_metrics Sensor.frame_id World.frames World.gravity
""",
    "1.5": """
Axis.expressed_in Axis.mimic Capsule Cone Ellipsoid Frame.attached_to Include.merge Include.placement_frame
Inertial.auto Inertial.pose Joint.screw_thread_pitch Light.intensity Link.enable_wind Link.lights
Material.albedo_map Model.canonical_link Model.enable_wind Model.placement_frame Pose.degrees Pose.relative_to
Pose.rotation_format Sensor.enable_metrics Sensor.frame_id World.frames World.gravity
""",
    "1.6": """
Axis.expressed_in Axis.mimic Capsule Cone Ellipsoid Frame.attached_to Include.merge Include.placement_frame
Inertial.auto Inertial.pose Joint.screw_thread_pitch Light.intensity Model.canonical_link Model.placement_frame
Pose.degrees Pose.relative_to Pose.rotation_format Sensor.enable_metrics Sensor.frame_id World.frames
""",
    "1.7": """
Axis.mimic Axis.use_parent_model_frame Capsule Cone Ellipsoid Include.merge Include.placement_frame
Inertial.auto Inertial.pose Joint.screw_thread_pitch Light.intensity Model.placement_frame Pose.degrees
Pose.rotation_format Sensor.frame_id World.joints
""",
    "1.8": """
Axis.mimic Axis.use_parent_model_frame Cone Include.merge Inertial.auto Inertial.pose Joint.screw_thread_pitch
Pose.degrees Pose.rotation_format Sensor.frame_id World.joints
""",
    "1.9": """
Axis.mimic Axis.use_parent_model_frame Cone Inertial.auto Inertial.pose Joint.screw_thread_pitch Sensor.frame_id
World.joints
""",
    "1.10": """
Axis.mimic Axis.use_parent_model_frame Cone Inertial.auto Inertial.pose Sensor.frame_id
""",
    "1.11": """
Axis.use_parent_model_frame Inertial.pose Sensor.frame_id
""",
    "1.12": """
Axis.use_parent_model_frame Inertial.pose
""",
}
"""Nodes and fields that a version lacks, allows only once or defines otherwise."""
