"""The names of the releases of Gazebo."""

from typing import Literal

ReleaseName = Literal["fortress", "garden", "harmonic", "ionic", "jetty"]
"""The releases of Gazebo, oldest first."""
