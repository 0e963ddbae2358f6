"""Models in MuJoCo: what it reads from a URDF and from our MJCF, compared in its own terms and with Drake's."""
