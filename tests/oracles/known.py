"""URDF files of the corpus that libsdformat takes, though it does not take SDF that means the same, and why."""

_WEIGHED_TOGETHER = "links with impossible inertia that no other link of the body they are lumped into can make up for"
LIBSDFORMAT = {
    "Gepetto+example-robot-data/robots/alex_description/urdf/alex_psyonic_hands.urdf": _WEIGHED_TOGETHER,
}
