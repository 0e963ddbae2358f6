"""Lumped links: masses summed with the links that are fixed to them, as some engines do."""

from collections.abc import Iterable, Mapping
from dataclasses import replace

import numpy as np

from twinform.testing.oracles.robot import EngineBody, EngineRobot, Sample


def lumped(robot: EngineRobot) -> EngineRobot:
    """The robot with one body for each group of links that are fixed to each other, named after the first of them."""
    samples = tuple(_lumped(sample, robot.welds) for sample in robot.samples)
    return replace(robot, samples=samples, lumped=True)


def _lumped(sample: Sample, welds: Mapping[str, str]) -> Sample:
    groups: dict[str, list[EngineBody]] = {}
    for link, body in sample.bodies.items():
        groups.setdefault(_first(link, welds), []).append(body)
    return replace(sample, bodies={name: _together(bodies) for name, bodies in groups.items()})


def _first(link: str, welds: Mapping[str, str]) -> str:
    while link in welds:
        link = welds[link]
    return link


def _together(bodies: Iterable[EngineBody]) -> EngineBody:
    parts = list(bodies)
    mass = sum(body.mass for body in parts)
    center = np.sum([body.mass * body.center for body in parts], axis=0) / mass
    inertia = np.zeros((3, 3))
    for body in parts:
        arm = body.center - center
        inertia += body.inertia + body.mass * (arm @ arm * np.eye(3) - np.outer(arm, arm))
    return EngineBody(mass, center, inertia)
