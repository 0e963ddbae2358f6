"""Rules about frames and what they are relative to. The frame graph finds them."""

from twinform.diagnostics.rule import Rule, Severity

DANGLING_FRAME = Rule(
    name="dangling-frame",
    severity=Severity.ERROR,
    finds="A name of a frame (`relative_to`, `attached_to`, `expressed_in`, `placement_frame`) that nothing has.",
    matters="The pose cannot be computed, so every reader refuses the model.",
    example="`<pose relative_to='elbow'>` in a model without a link, joint, frame or nested model called `elbow`.",
    better="Name a frame of the same model, or one of a nested model as `model::frame`.",
    references="SDF: pose frame semantics; libsdformat: POSE_RELATIVE_TO_INVALID, FRAME_ATTACHED_TO_INVALID",
)
FRAME_CYCLE = Rule(
    name="frame-cycle",
    severity=Severity.ERROR,
    unsound=True,
    finds="Frames that are given relative to each other in a circle.",
    matters="None of their poses can be computed, so every reader refuses the model.",
    example="A link with its pose relative to a joint whose own pose is relative to that link, as it is by default.",
    better="Give one of them relative to a frame outside the circle, such as the joint relative to its parent link.",
    references="libsdformat: POSE_RELATIVE_TO_CYCLE, FRAME_ATTACHED_TO_CYCLE",
)
AMBIGUOUS_FRAME = Rule(
    name="ambiguous-frame",
    severity=Severity.ERROR,
    finds="A reference to a name that two things of the model have.",
    matters="Each reader picks another one of them, or refuses the model.",
    example="`attached_to='arm'` in a model with a link and a joint called `arm`.",
    better="Rename one of the two.",
    references="libsdformat: FRAME_ATTACHED_TO_INVALID, POSE_RELATIVE_TO_INVALID",
)
UNKNOWN_CANONICAL_LINK = Rule(
    name="unknown-canonical-link",
    severity=Severity.ERROR,
    finds="A `canonical_link` that names no link of the model.",
    matters="The model's own frame moves with that link; without it the model cannot be placed.",
    example="`<model name='m' canonical_link='base'>` where the link is called `base_link`.",
    better="Name a link of the model, or one of a nested model as `model::link`; a frame will not do.",
    references="libsdformat: MODEL_CANONICAL_LINK_INVALID",
)
ANGLE_IN_DEGREES = Rule(
    name="angle-in-degrees",
    severity=Severity.WARNING,
    finds="A roll, pitch or yaw of more than two turns, where radians are read.",
    matters="The part gets a quite different angle: 90 radians are 14 turns and 117 degrees.",
    example="`<origin xyz='0 0 0' rpy='0 0 90'/>`, `<pose>0 0 0 0 0 90</pose>`",
    better="Write radians, 1.570796 for 90 degrees, or in SDF from 1.9 on `<pose degrees='true'>`.",
)
UNNORMALIZED_QUATERNION = Rule(
    name="unnormalised-quaternion",
    severity=Severity.WARNING,
    finds="A quaternion whose length is not 1.",
    matters="Only those of length 1 are rotations. We and some readers divide by the length; others take the numbers "
    "as they are, and the part is somewhere else or of another size.",
    example="`<pose rotation_format='quat_xyzw'>0 0 0 0 0 1 1</pose>`",
    better="Divide all four numbers by their length: `0 0 0.707107 0.707107`. The order is x, y, z, w.",
)
