"""Camera sensors as cameras of MJCF, with their field of view and resolution.

A camera of SDF looks along x with z up, and one of MJCF along -z with y up. SDF states the horizontal field of view,
and MJCF the vertical one.
"""

import math

from twinform.ir import Element, Pose, Sensor
from twinform.ir.transform import Transform
from twinform.passes.carriers.old_names import source_name
from twinform.passes.legalise.to_mjcf.elements import Value, make_element, placement
from twinform.passes.legalise.to_mjcf.kept_mjcf import kept_elements, with_kept
from twinform.passes.legalise.to_mjcf.said_parts import child_count, child_number, child_vector
from twinform.passes.legalise.to_mjcf.writing_context import Body, MjcfContext

OPTICAL = Transform.from_pose(Pose.unchecked(quat_xyzw=(0.5, -0.5, -0.5, 0.5)))
"""The axes of a camera of MJCF in those of SDF."""
FIELD_OF_VIEW, WIDTH, HEIGHT = 1.047, 320, 240
"""What a camera of SDF has where nothing is written: rad and pixels."""
_OUTPUTS = {
    "depth": "depth", "depth_camera": "depth", "rgbd": "rgb depth", "rgbd_camera": "rgb depth",
    "segmentation": "segmentation", "segmentation_camera": "segmentation",
}  # fmt: skip
_EULER = 6
"""How many numbers a pose has whose orientation is not a quaternion."""


def camera_element(
    context: MjcfContext, sensor: Sensor, camera: Element, body: Body, place: Transform
) -> Element | None:
    """The camera of a `<camera>` in a sensor at a place in its body; None where no plane image is as wide."""
    wish = context.wish("camera", body.scope, _name(sensor, camera))
    name = context.name("camera", wish, sensor.location)
    context.note_made_name("camera", sensor, name, f"{body.link.name}_camera")
    view = child_number(camera, "horizontal_fov", default=FIELD_OF_VIEW)
    if not 0 < view < math.pi:
        return None
    width = child_count(camera, "image", "width", default=WIDTH)
    height = child_count(camera, "image", "height", default=HEIGHT)
    if width <= 0 or height <= 0:
        return None
    attributes: list[tuple[str, Value]] = [
        ("name", name),
        *placement(_place(context, camera, body, place).compose(OPTICAL)),
        ("fovy", vertical_view(view, width, height)),
        ("resolution", _resolution(context, sensor, width, height)),
        ("output", _OUTPUTS.get(sensor.type or "")),
    ]
    return with_kept(make_element("camera", attributes, source=sensor.source), sensor)


def _resolution(context: MjcfContext, sensor: Sensor, width: int, height: int) -> tuple[int, int] | None:
    """The resolution; None for a camera of MJCF whose file states none, or one that SDF cannot have."""
    kept = any(each.name == "camera" and each.get("resolution") for each in kept_elements(sensor))
    is_usual = context.is_of_mjcf and (width, height) == (WIDTH, HEIGHT)
    return None if kept or is_usual else (width, height)


def vertical_view(horizontal: float, width: int, height: int) -> float:
    """The vertical field of view in degrees, of a horizontal one in rad and a picture of square pixels."""
    return math.degrees(2 * math.atan(math.tan(horizontal / 2) * height / width))


def _name(sensor: Sensor, camera: Element) -> str:
    """The name of the sensor, and with it that of the camera where a sensor has several."""
    own = camera.get("name") if sensor.type == "multicamera" else None
    return f"{sensor.name}_{own}" if own else source_name(sensor) or "camera"


def _place(context: MjcfContext, camera: Element, body: Body, sensor: Transform) -> Transform:
    """The place of a camera in its body: it has a pose in its sensor, unless that names another frame."""
    written = camera.find("pose")
    numbers = child_vector(written)
    if written is None or numbers is None or len(numbers) not in {_EULER, _EULER + 1}:
        return sensor
    x, y, z, *turn = numbers
    pose = Pose.unchecked(xyz=(x, y, z), relative_to=written.get("relative_to") or None)
    if len(numbers) > _EULER:
        pose = pose.copy(quat_xyzw=tuple(turn))
    else:
        pose = pose.copy(rpy=tuple(turn), degrees=written.get("degrees") in {"true", "1"})
    return context.resolve(pose, body) if pose.relative_to else sensor.compose(Transform.from_pose(pose))
