"""Gazebo's own physics: what DART, Bullet and TPE make of a file in gz-physics 5, and how it moves there."""

from testbed.engines.gazebo.library import MISSING, PhysicsEngine, available, simulate
from testbed.engines.gazebo.results import (
    Console,
    InsideJoint,
    Joint,
    Link,
    LinkState,
    Moment,
    Outcome,
    Simulation,
)
from testbed.engines.gazebo.settings import Settings

__all__ = [
    "MISSING",
    "Console",
    "InsideJoint",
    "Joint",
    "Link",
    "LinkState",
    "Moment",
    "Outcome",
    "PhysicsEngine",
    "Settings",
    "Simulation",
    "available",
    "simulate",
]
