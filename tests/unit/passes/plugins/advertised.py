"""The topics of Gazebo's systems and sensors, as their sources have them: a table that owes nothing to our catalog.

Each entry names the file of gz-sim (below `src/systems`) or of gz-sensors (below `src`) that it was read in. It gives
the direction, the message, and the topic after what the source does with the text: `valid` is `AsValidTopic` of
gz-transport, `first` is `validTopic` of gz-sim, and `raw` is a text that nothing is done to. Where a source returns
because it has no valid topic, the entry returns.
"""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field

Row = tuple[str, str, str | None]
"""`>` for what is read or `<` for what is written, the message, and the topic; None where there is none."""


def valid(text: str | None) -> str | None:
    """`src/TopicUtils.cc` of gz-transport: AsValidTopic."""
    made, index = "", 0
    while text is not None and index < len(text):
        if text[index : index + 2] in {":=", "//"}:
            index += 2
            continue
        if text[index] not in "@~":
            made += "_" if text[index] == " " else text[index]
        index += 1
    return raw(made)


def raw(text: str | None) -> str | None:
    """`src/TopicUtils.cc` of gz-transport: IsValidTopic."""
    if not text or text == "/" or any(part in text for part in ("~", " ", "//", "@", ":=")):
        return None
    return text


def first(*texts: str | None) -> str | None:
    """`src/Util.cc` of gz-sim: validTopic."""
    return next((topic for text in texts if text is not None and (topic := valid(text))), None)


def after(topic: str | None, end: str) -> str | None:
    """A topic that was made valid, with something at its end that nothing more is done to."""
    return raw(topic + end) if topic else None


@dataclass(frozen=True)
class Sdf:
    """A plugin or sensor: its release, the parameters that it has, and the names around it, the outer model first."""

    release: str
    world: str
    models: tuple[str, ...]
    spawned: bool = False
    parameters: Mapping[str, list[str]] = field(default_factory=dict[str, list[str]])

    @property
    def model(self) -> str:
        return self.models[-1]

    def get(self, name: str, default: str | None = None) -> str | None:
        return self.parameters.get(name, [default])[0]

    def has(self, name: str) -> bool:
        return name in self.parameters

    def true(self, name: str) -> bool:
        return self.get(name) in {"true", "1"}

    def scoped(self, *, world: bool) -> str:
        """`src/Util.cc`: topicFromScopedName of the model, with the world or without."""
        name = "/".join(["world", self.world, *(part for model in self.models for part in ("model", model))])
        return valid("/" + (name if world else _without_parent(_without_parent(name)))) or ""

    def configured(self, end: str = "") -> str:
        """The same when a plugin is configured, and the model may not be in the world (`src/SdfEntityCreator.cc`)."""
        name = self.loaded(end)
        if self.release in {"ionic", "jetty"}:
            whole = name if self.spawned else f"world/{self.world}/{name}"
            name = _without_parent(_without_parent(whole))
        return valid(f"/{name}") or ""

    def loaded(self, end: str = "") -> str:
        """`src/Util.cc`: scopedName of a part of the model when a plugin is configured."""
        return "/".join(part for model in self.models for part in ("model", model)) + end


def _without_parent(name: str) -> str:
    """`src/Util.cc`: removeParentScope."""
    return name[name.find("/") + 1 :]


@dataclass(frozen=True)
class Entry:
    """What a source does: `takes` are the parameters that matter for its topics, by the kind of their values."""

    source: str
    rows: Callable[[Sdf], Iterator[Row]]
    takes: Mapping[str, str]


SYSTEMS: dict[str, Entry] = {}


def system(name: str, source: str, takes: str) -> Callable[[Callable[[Sdf], Iterator[Row]]], None]:
    """An entry; `takes` has `parameter` for a topic, and `parameter:kind`, with `!` where the plugin needs it."""
    pairs = [each.partition(":") for each in takes.split()]

    def add(rows: Callable[[Sdf], Iterator[Row]]) -> None:
        SYSTEMS[name] = Entry(source, rows, {each: kind or "topic" for each, _, kind in pairs})

    return add


@system("diff-drive", "diff_drive/DiffDrive.cc", "topic odom_topic tf_topic")
def _(s: Sdf) -> Iterator[Row]:
    yield ">", "Twist", first(s.get("topic"), f"/model/{s.model}/cmd_vel")
    yield ">", "Boolean", first(f"/model/{s.model}/enable")
    yield "<", "Odometry", first(s.get("odom_topic"), f"/model/{s.model}/odometry")
    yield "<", "Pose_V", raw(s.get("tf_topic", f"/model/{s.model}/tf"))


@system(
    "ackermann-steering",
    "ackermann_steering/AckermannSteering.cc",
    "topic sub_topic odom_topic tf_topic steering_only:bool use_actuator_msg:bool actuator_number:int",
)
def _(s: Sdf) -> Iterator[Row]:
    new = s.release != "fortress"
    actuators = new and s.true("use_actuator_msg") and s.has("actuator_number")
    steering = actuators or (new and s.true("steering_only"))
    if new and s.has("topic"):
        topic = s.get("topic")
    elif new and s.has("sub_topic"):
        topic = f"/model/{s.model}/{s.get('sub_topic')}"
    elif steering:
        topic = "/actuators" if actuators else f"/model/{s.model}/steer_angle"
    else:
        topic = f"/model/{s.model}/cmd_vel"
    command = first(topic) if new else first(s.get("topic"), topic)
    yield ">", "Actuators" if actuators else "Double" if steering else "Twist", command
    if command and not steering:
        yield "<", "Odometry", first(s.get("odom_topic"), f"/model/{s.model}/odometry")
        yield "<", "Pose_V", first(s.get("tf_topic"), f"/model/{s.model}/tf")


@system("mecanum-drive", "mecanum_drive/MecanumDrive.cc", "topic odom_topic tf_topic")
def _(s: Sdf) -> Iterator[Row]:
    yield ">", "Twist", first(s.get("topic"), f"/model/{s.model}/cmd_vel")
    yield "<", "Odometry", first(s.get("odom_topic"), f"/model/{s.model}/odometry")
    yield "<", "Pose_V", raw(s.get("tf_topic", f"/model/{s.model}/tf"))


@system("tracked-vehicle", "tracked_vehicle/TrackedVehicle.cc", "topic odom_topic tf_topic steering_efficiency_topic")
def _(s: Sdf) -> Iterator[Row]:
    yield ">", "Twist", first(s.get("topic"), f"/model/{s.model}/cmd_vel")
    yield "<", "Odometry", first(s.get("odom_topic"), f"/model/{s.model}/odometry")
    yield "<", "Pose_V", first(s.get("tf_topic"), f"/model/{s.model}/tf")
    yield ">", "Double", first(s.get("steering_efficiency_topic"), f"/model/{s.model}/steering_efficiency")


@system(
    "track-controller",
    "track_controller/TrackController.cc",
    "link:name! velocity_topic center_of_rotation_topic odometry_topic",
)
def _(s: Sdf) -> Iterator[Row]:
    above = f"/model/{s.model}/link/{s.get('link')}"
    velocity = first(s.get("velocity_topic"), f"{above}/track_cmd_vel")
    center = first(s.get("center_of_rotation_topic"), f"{above}/track_cmd_center_of_rotation")
    yield ">", "Double", velocity
    if velocity:
        yield ">", "Vector3d", center
    if velocity and center and s.release != "fortress":
        yield "<", "Odometry", first(s.get("odometry_topic"), f"{above}/odometry")


@system("velocity-control", "velocity_control/VelocityControl.cc", "topic link_name:names")
def _(s: Sdf) -> Iterator[Row]:
    yield ">", "Twist", first(s.get("topic"), f"/model/{s.model}/cmd_vel")
    for link in s.parameters.get("link_name", []):
        yield ">", "Twist", valid(f"/model/{s.model}/link/{link}/cmd_vel")


@system("odometry-publisher", "odometry_publisher/OdometryPublisher.cc", "odom_topic odom_covariance_topic tf_topic")
def _(s: Sdf) -> Iterator[Row]:
    above = f"/model/{s.model}"
    yield "<", "Odometry", valid(s.get("odom_topic", f"{above}/odometry"))
    covariance = s.get("odom_covariance_topic", f"{above}/odometry_with_covariance")
    yield "<", "OdometryWithCovariance", valid(covariance)
    yield "<", "Pose_V", valid(s.get("tf_topic", f"{above}/pose"))


@system("drive-to-pose-controller", "drive_to_pose_controller/DriveToPoseController.cc", "")
def _(s: Sdf) -> Iterator[Row]:
    yield ">", "Pose_V", raw(f"/model/{s.model}/cmd_pose")
    yield "<", "Pose", raw(f"/model/{s.model}/reached_pose")


@system("trajectory-follower", "trajectory_follower/TrajectoryFollower.cc", "topic")
def _(s: Sdf) -> Iterator[Row]:
    yield ">", "Boolean", valid(s.get("topic", f"/model/{s.model}/trajectory_follower/pause"))


@system("free-space-explorer", "free_space_explorer/FreeSpaceExplorer.cc", "start_topic image_topic")
def _(s: Sdf) -> Iterator[Row]:
    yield ">", "Boolean", raw(s.get("start_topic", "start"))
    yield "<", "Image", raw(s.get("image_topic", "scan_image"))


@system(
    "multicopter-velocity-control",
    "multicopter_control/MulticopterVelocityControl.cc",
    "robotNamespace:name commandSubTopic enableSubTopic",
)
def _(s: Sdf) -> Iterator[Row]:
    above = valid(s.get("robotNamespace"))
    command, enable = valid(s.get("commandSubTopic", "cmd_vel")), valid(s.get("enableSubTopic", "enable"))
    if above and command and enable:
        yield ">", "Twist", raw(f"{above}/{command}")
        yield ">", "Boolean", raw(f"{above}/{enable}")


@system(
    "multicopter-motor-model",
    "multicopter_motor_model/MulticopterMotorModel.cc",
    "robotNamespace:name commandSubTopic",
)
def _(s: Sdf) -> Iterator[Row]:
    yield ">", "Actuators", valid(f"{s.get('robotNamespace', s.model)}/{s.get('commandSubTopic', '')}")


@system("wind-effects", "wind_effects/WindEffects.cc", "")
def _(s: Sdf) -> Iterator[Row]:
    world = valid(s.world)
    if world:
        yield ">", "Wind", raw(f"/world/{world}/wind")
        if s.release in {"ionic", "jetty"}:
            yield "<", "Wind", raw(f"/world/{world}/wind_info")


@system("buoyancy-engine", "buoyancy_engine/BuoyancyEngine.cc", "namespace:name")
def _(s: Sdf) -> Iterator[Row]:
    above = f"/model/{s.get('namespace')}" if s.has("namespace") else ""
    yield ">", "Double", valid(f"{above}/buoyancy_engine/")
    yield "<", "Double", valid(f"{above}/buoyancy_engine/current_volume")


@system("hydrodynamics", "hydrodynamics/Hydrodynamics.cc", "namespace:name")
def _(s: Sdf) -> Iterator[Row]:
    yield (
        ">",
        "Vector3d",
        valid(f"/model/{s.get('namespace')}/ocean_current" if s.has("namespace") else "/ocean_current"),
    )


@system("thruster", "thruster/Thruster.cc", "namespace:name joint_name:name! topic use_angvel_cmd:bool")
def _(s: Sdf) -> Iterator[Row]:
    above, own = s.get("namespace", s.model), valid(s.get("topic"))
    spun = s.release != "fortress" and s.true("use_angvel_cmd")
    joint = f"/model/{above}/joint/{s.get('joint_name')}"
    yield ">", "Double", valid(f"{above}/{own}" if own else f"{joint}/{'cmd_vel' if spun else 'cmd_thrust'}")
    if s.release != "fortress":
        start = f"{above}/{own}" if own else joint
        yield "<", "Double", valid(f"{start}/{'force' if spun else 'ang_vel'}")
        yield ">", "Boolean", valid(f"{start}/enable_deadband")


@system("spacecraft-thruster-model", "spacecraft_thruster_model/SpacecraftThrusterModel.cc", "topic sub_topic")
def _(s: Sdf) -> Iterator[Row]:
    own = s.get("topic", s.model)
    yield ">", "Actuators", valid(f"{own}/{s.get('sub_topic')}" if s.has("sub_topic") else own)


@system("joint-state-publisher", "joint_state_publisher/JointStatePublisher.cc", "topic")
def _(s: Sdf) -> Iterator[Row]:
    yield "<", "Model", first(s.get("topic"), s.scoped(world=True) + "/joint_state")


def _of_joint(s: Sdf, end: str) -> Iterator[Row]:
    new = s.release != "fortress"
    actuators = new and s.true("use_actuator_msg") and s.has("actuator_number")
    topic = "/actuators" if actuators else f"/model/{s.model}/joint/{s.get('joint_name')}/{end}"
    if new and s.has("sub_topic"):
        topic = f"/model/{s.model}/{s.get('sub_topic')}"
    if valid(topic) or (new and not s.has("sub_topic")):  # with the last, it asks only where there is no topic
        yield ">", "Actuators" if actuators else "Double", valid(s.get("topic", topic))


_JOINT = "joint_name:name! topic sub_topic use_actuator_msg:bool actuator_number:int"


@system(
    "joint-position-controller", "joint_position_controller/JointPositionController.cc", f"{_JOINT} joint_index:int"
)
def _(s: Sdf) -> Iterator[Row]:
    yield from _of_joint(s, f"{s.get('joint_index', '0')}/cmd_pos")


@system("joint-controller", "joint_controller/JointController.cc", _JOINT)
def _(s: Sdf) -> Iterator[Row]:
    yield from _of_joint(s, "cmd_vel")


@system("joint-trajectory-controller", "joint_traj_control/JointTrajectoryController.cc", "topic")
def _(s: Sdf) -> Iterator[Row]:
    topic = valid(s.get("topic") or f"/model/{s.model}/joint_trajectory")
    if topic:
        yield ">", "JointTrajectory", topic
        yield "<", "Float", after(topic, "_progress")


@system("apply-joint-force", "apply_joint_force/ApplyJointForce.cc", "joint_name:name!")
def _(s: Sdf) -> Iterator[Row]:
    yield ">", "Double", valid(f"/model/{s.model}/joint/{s.get('joint_name')}/cmd_force")


@system(
    "detachable-joint",
    "detachable_joint/DetachableJoint.cc",
    "child_model:name! detach_topic topic attach_topic output_topic",
)
def _(s: Sdf) -> Iterator[Row]:
    asked = s.get("detach_topic") if s.has("detach_topic") else s.get("topic")
    detach = first(asked, f"/model/{s.model}/detachable_joint/detach")
    attach = first(s.get("attach_topic"), f"/model/{s.model}/detachable_joint/attach")
    yield ">", "Empty", detach
    if detach:
        yield ">", "Empty", attach
    if detach and attach:
        yield "<", "StringMsg", first(s.get("output_topic"), f"/model/{s.get('child_model')}/detachable_joint/state")


@system("elevator", "elevator/Elevator.cc", "cmd_topic state_topic")
def _(s: Sdf) -> Iterator[Row]:
    yield ">", "Int32", raw(s.get("cmd_topic", f"/model/{s.model}/cmd"))
    yield "<", "Int32", raw(s.get("state_topic", f"/model/{s.model}/state"))


@system("pose-publisher", "pose_publisher/PosePublisher.cc", "topic static_publisher:bool use_pose_vector_msg:bool")
def _(s: Sdf) -> Iterator[Row]:
    topic = raw(s.get("topic")) if s.release not in {"fortress", "garden"} else None
    usual = valid(s.loaded("/pose")) or "/pose" if s.release == "fortress" else s.configured() + "/pose"
    topic, message = topic or usual, "Pose_V" if s.true("use_pose_vector_msg") else "Pose"
    yield "<", message, raw(topic)
    if s.true("static_publisher"):
        yield "<", message, raw(f"{topic}_static")


@system("kinetic-energy-monitor", "kinetic_energy_monitor/KineticEnergyMonitor.cc", "topic")
def _(s: Sdf) -> Iterator[Row]:
    yield "<", "Double", raw(s.get("topic", f"/model/{s.model}/kinetic_energy"))


@system(
    "linear-battery",
    "battery_plugin/LinearBatteryPlugin.cc",
    "battery_name:name! enable_recharge:bool charging_time:int recharge_by_topic:bool",
)
def _(s: Sdf) -> Iterator[Row]:
    above = f"/model/{s.model}/battery/{s.get('battery_name')}"
    if s.true("enable_recharge") and not s.has("charging_time"):
        return
    yield "<", "BatteryState", valid(f"{above}/state")
    if s.true("enable_recharge") and s.has("recharge_by_topic"):
        yield ">", "Boolean", valid(f"{above}/recharge/start")
        yield ">", "Boolean", valid(f"{above}/recharge/stop")


@system("apply-link-wrench", "apply_link_wrench/ApplyLinkWrench.cc", "topic topic_persistent topic_clear")
def _(s: Sdf) -> Iterator[Row]:
    yield ">", "EntityWrench", raw(s.get("topic", f"/world/{s.world}/wrench"))
    yield ">", "EntityWrench", raw(s.get("topic_persistent", f"/world/{s.world}/wrench/persistent"))
    yield ">", "Entity", raw(s.get("topic_clear", f"/world/{s.world}/wrench/clear"))


@system("logical-audio-sensor", "logical_audio_sensor_plugin/LogicalAudioSensorPlugin.cc", "")
def _(s: Sdf) -> Iterator[Row]:
    above = s.loaded("/sensor/mic_7") if s.release == "fortress" else s.configured("/sensor/mic_7")
    yield "<", "Double", raw(above + "/detection")


@system("optical-tactile-plugin", "optical_tactile_plugin/OpticalTactilePlugin.cc", "namespace:name")
def _(s: Sdf) -> Iterator[Row]:
    yield "<", "Image", raw(f"/{s.get('namespace', 'optical_tactile_sensor')}/normal_forces")


@system("touch-plugin", "touch_plugin/TouchPlugin.cc", "namespace:name")
def _(s: Sdf) -> Iterator[Row]:
    own = s.get("namespace")
    if s.release in {"fortress", "garden"}:
        above = f"/{valid(own)}" if valid(own) else None
    else:
        above = valid(s.scoped(world=False) + "/touch" if own is None else f"/{own}")
    if above:
        yield "<", "Boolean", after(above, "/touched")


@system("performer-detector", "performer_detector/PerformerDetector.cc", "topic")
def _(s: Sdf) -> Iterator[Row]:
    yield "<", "Pose", raw(s.get("topic", f"/model/{s.model}/performer_detector/status"))


@system("breadcrumbs", "breadcrumbs/Breadcrumbs.cc", "topic breadcrumb:breadcrumb!")
def _(s: Sdf) -> Iterator[Row]:
    topic = first(s.get("topic"), f"/model/{s.model}/breadcrumbs/{s.get('breadcrumb')}/deploy")
    yield ">", "Empty", topic
    yield "<", "Int32", raw((topic or "") + "/remaining")  # it does not ask whether there is a topic


@system("log-video-recorder", "log_video_recorder/LogVideoRecorder.cc", "")
def _(s: Sdf) -> Iterator[Row]:
    yield "<", "StringMsg", raw("/log_video_recorder/status")


WITHOUT: dict[str, str] = {
    **dict.fromkeys(
        (
            "acoustic-comms", "advanced-lift-drag", "air-pressure", "air-speed", "altimeter", "buoyancy",
            "collada-world-exporter", "contact", "cpu-lidar", "dvl", "entity-semantics", "environmental-sensor",
            "follow-actor", "force-torque", "gz-ros2-control", "ign-ros2-control", "imu", "label", "lens-flare",
            "lift-drag", "lighter-than-air-dynamics", "log-playback", "logical-camera", "lookup-wheel-slip",
            "magnetometer", "model-photo-shoot", "navsat", "perfect-comms", "physics", "python-system-loader",
            "rf-comms", "sensors", "shader-param", "thermal", "thermal-sensor", "websocket-server", "wheel-slip",
        ),
        "no topic of its own",
    ),
    "camera-video-recorder": "its statistics have a message for the simulator alone",
    "comms-endpoint": "its messages are those of robots to each other, which a broker passes on",
    "environment-preload": "its topics are for the GUI",
    "led-plugin": "no release has it",
    "log-record": "its topics are for the log",
    "particle-emitter": "its message is for the simulator alone",
    "particle-emitter2": "its message is for the simulator alone",
    "scene-broadcaster": "its topics are the scene for the GUI",
    "triggered-publisher": "its topics and messages are the author's",
    "user-commands": "its topics are requests of the GUI",
}  # fmt: skip
"""Systems with no topic for the bridge, and why."""


@dataclass(frozen=True)
class SensorSdf(Sdf):
    """A sensor: its name, and the kind and name of what holds it."""

    holder: tuple[str, str] = ("link", "base")
    name: str = "s"

    def scoped_sensor(self) -> str:
        """`src/Util.cc`: scopedName of the sensor."""
        parts = [f"model/{name}" for name in self.models]
        return "/".join([f"world/{self.world}", *parts, "/".join(self.holder), f"sensor/{self.name}"])

    def topic(self, suffix: str) -> str | None:
        """`src/Sensor.cc` of sdformat and of gz-sensors (SetTopic), with the default of the system in gz-sim."""
        own = self.get("topic")
        return self.loaded_with(valid(own if own not in {None, "", "__default__"} else self.scoped_sensor() + suffix))

    @staticmethod
    def loaded_with(topic: str | None) -> str | None:
        """The topic of a sensor that can offer its service `set_rate`, else none (Load)."""
        return topic if after(topic, "/set_rate") else None


@dataclass(frozen=True)
class SensorEntry:
    """A sensor's source, what it publishes, and the first release that has it."""

    source: str
    rows: Callable[[SensorSdf], Iterator[Row]]
    since: str = "fortress"


def _one(message: str, suffix: str) -> Callable[[SensorSdf], Iterator[Row]]:
    def rows(s: SensorSdf) -> Iterator[Row]:
        yield "<", message, s.topic(suffix)

    return rows


def _info(topic: str | None) -> str | None:
    """`CameraSensor.cc`: AdvertiseInfo."""
    parts = [part for part in (topic or "").split("/")[:-1] if part]
    return raw("/" + "/".join([*parts, "camera_info"])) if topic else None


def _camera(s: SensorSdf) -> Iterator[Row]:
    topic, info = s.topic("/image"), s.get("camera_info_topic")
    yield "<", "Image", topic
    yield "<", "CameraInfo", raw(info) if info not in {None, "", "__default__"} and topic else _info(topic)


def _depth_camera(s: SensorSdf) -> Iterator[Row]:
    topic = s.topic("/depth_image")
    yield from (("<", "Image", topic), ("<", "CameraInfo", _info(topic)))
    yield "<", "PointCloudPacked", after(topic, "/points")


def _rgbd_camera(s: SensorSdf) -> Iterator[Row]:
    topic = s.topic("")
    yield from (("<", "Image", after(topic, "/image")), ("<", "Image", after(topic, "/depth_image")))
    yield from (("<", "PointCloudPacked", after(topic, "/points")), ("<", "CameraInfo", after(topic, "/camera_info")))


def _image(s: SensorSdf) -> Iterator[Row]:
    topic = s.topic("/image")
    yield from (("<", "Image", topic), ("<", "CameraInfo", _info(topic)))


def _segmentation(s: SensorSdf) -> Iterator[Row]:
    topic = s.topic("/segmentation")
    yield from (("<", "Image", after(topic, "/colored_map")), ("<", "Image", after(topic, "/labels_map")))
    yield "<", "CameraInfo", after(topic, "/camera_info")


def _with_trigger(
    rows: Callable[[SensorSdf], Iterator[Row]], suffix: str, *without: str
) -> Callable[..., Iterator[Row]]:
    """The same with what the sensor waits for in all releases but those `without` (Load)."""

    def both(s: SensorSdf) -> Iterator[Row]:
        waits, own = s.release not in without and s.true("triggered"), s.get("trigger_topic")
        if waits and s.release == "fortress" and not own:
            return
        made = list(rows(s))
        yield from made
        if waits and made and all(topic for _, _, topic in made):
            yield ">", "Boolean", raw(own) if own else valid(f"{s.topic(suffix)}/trigger")

    return both


_OLD = ("fortress", "garden")
_FLAT = ("2d", "visible_2d", "visible_box_2d", "full_2d", "full_box_2d")


def _boxes(s: SensorSdf) -> Iterator[Row]:
    topic, type_ = s.topic("/boundingbox"), s.get("box_type") or "2d"
    if type_ in {*_FLAT, "3d"}:
        yield "<", "Image", after(topic, "_image")
        yield "<", "AnnotatedAxisAligned2DBox_V" if type_ in _FLAT else "AnnotatedOriented3DBox_V", topic
        yield "<", "CameraInfo", _info(topic)


def _lidar(s: SensorSdf) -> Iterator[Row]:
    topic = s.topic("/scan")
    yield "<", "LaserScan", topic
    yield "<", "PointCloudPacked", valid(f"{topic}/points") if topic else None


def _contact(s: SensorSdf) -> Iterator[Row]:
    own = s.get("contact_topic", "__default_topic__")
    yield "<", "Contacts", raw(own if own != "__default_topic__" else s.scoped_sensor() + "/contact")


def _air_speed(s: SensorSdf) -> Iterator[Row]:
    yield "<", "AirSpeedSensor" if s.release == "garden" else "AirSpeed", s.topic("/air_speed")


def _logical(s: SensorSdf) -> Iterator[Row]:
    topic = s.topic("/logical_camera")
    if s.get("topic") in {"", "__default__"}:  # the system asks for the element, and the sensor for its text
        scoped = "::".join((*s.models, s.holder[1], s.name))
        topic = "/logical_camera" if raw(f"/{scoped}/set_rate") else None
    yield "<", "LogicalCameraImage", topic
    if s.release in {"ionic", "jetty"}:
        yield "<", "LogicalCameraSensor", after(topic, "/frustum")


def _environment(s: SensorSdf) -> Iterator[Row]:
    own = s.get("topic")  # it goes on where it can offer no service
    topic = valid(own if own not in {None, "", "__default__"} else s.scoped_sensor() + "/environmental_sensor/humidity")
    yield "<", "Vector3d" if s.get("output_format") == "vector3" else "Double", topic


SENSORS: dict[str, SensorEntry] = {
    "camera": SensorEntry("CameraSensor.cc", _with_trigger(_camera, "/image")),
    "depth_camera": SensorEntry("DepthCameraSensor.cc", _with_trigger(_depth_camera, "/depth_image", "garden")),
    "rgbd_camera": SensorEntry("RgbdCameraSensor.cc", _with_trigger(_rgbd_camera, "", *_OLD)),
    "thermal_camera": SensorEntry("ThermalCameraSensor.cc", _with_trigger(_image, "/image", *_OLD)),
    "segmentation_camera": SensorEntry(
        "SegmentationCameraSensor.cc", _with_trigger(_segmentation, "/segmentation", *_OLD)
    ),
    "boundingbox_camera": SensorEntry("BoundingBoxCameraSensor.cc", _with_trigger(_boxes, "/boundingbox", "fortress")),
    "wideanglecamera": SensorEntry("WideAngleCameraSensor.cc", _with_trigger(_image, "/image", *_OLD), "garden"),
    "gpu_lidar": SensorEntry("Lidar.cc, GpuLidarSensor.cc", _lidar),
    "imu": SensorEntry("ImuSensor.cc", _one("IMU", "/imu")),
    "navsat": SensorEntry("NavSatSensor.cc", _one("NavSat", "/navsat")),
    "magnetometer": SensorEntry("MagnetometerSensor.cc", _one("Magnetometer", "/magnetometer")),
    "altimeter": SensorEntry("AltimeterSensor.cc", _one("Altimeter", "/altimeter")),
    "air_pressure": SensorEntry("AirPressureSensor.cc", _one("FluidPressure", "/air_pressure")),
    "air_speed": SensorEntry("AirSpeedSensor.cc", _air_speed, "garden"),
    "contact": SensorEntry("gz-sim, contact/Contact.cc", _contact),
    "force_torque": SensorEntry("ForceTorqueSensor.cc", _one("Wrench", "/forcetorque")),
    "logical_camera": SensorEntry("LogicalCameraSensor.cc", _logical),
    "environmental_sensor": SensorEntry(
        "gz-sim, environmental_sensor_system/EnvironmentalSensorSystem.cc", _environment, "garden"
    ),
    "dvl": SensorEntry("DopplerVelocityLog.cc", _one("DVLVelocityTracking", "/dvl/velocity"), "harmonic"),
}
WITHOUT_SENSORS: dict[str, str] = {"lidar": "no release has it"}
"""Sensors with no topic for the bridge, and why."""
