"""URDF files of the corpus that libsdformat takes, though it does not take SDF that means the same, and why."""

_WEIGHED_TOGETHER = "links with impossible inertia, which it lumps into their parents when it reads URDF itself"
LIBSDFORMAT = {
    "Gepetto+example-robot-data/robots/alex_description/urdf/alex_psyonic_hands.urdf": _WEIGHED_TOGETHER,
    "Gepetto+example-robot-data/robots/hyq_description/robots/hyq_no_sensors.urdf": _WEIGHED_TOGETHER,
}
