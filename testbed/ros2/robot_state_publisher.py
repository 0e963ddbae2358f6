"""The robot_state_publisher of ROS 1, which Debian has: the frames that it publishes of a URDF."""

import json
import os
import shutil
import socket
import subprocess
import time
import xmlrpc.client
from collections.abc import Generator, Mapping
from contextlib import contextmanager
from pathlib import Path

PROGRAM = Path("/usr/lib/robot_state_publisher/robot_state_publisher")
_PYTHON = "/usr/bin/python3"
_LISTENER = Path(__file__).with_name("tf_listener.py")
MISSING = "robot_state_publisher, rosmaster and rospy of ROS 1 are not installed"

Frame = tuple[str, tuple[float, float, float], tuple[float, float, float, float]]
"""A frame in another: the name of that one, where it is in m, and how it is turned as a quaternion, w first."""


def available() -> bool:
    """Whether it is here, with what listens to it."""
    return PROGRAM.is_file() and shutil.which("rosmaster") is not None and Path(_PYTHON).is_file() and _has_rospy()


def _has_rospy() -> bool:
    probe = "import rospy, sensor_msgs.msg, tf2_msgs.msg"
    return subprocess.run([_PYTHON, "-c", probe], capture_output=True, check=False).returncode == 0


def frames(urdf: str, positions: Mapping[str, float], count: int, home: Path) -> dict[str, Frame]:
    """The frames of a robot, by their names, with its joints at these positions."""
    with _core(home) as environment:
        with xmlrpc.client.ServerProxy(environment["ROS_MASTER_URI"]) as master:
            master.setParam("/test", "/robot_description", urdf)
        with _running([str(PROGRAM)], environment):
            words = [_PYTHON, str(_LISTENER), json.dumps(positions), str(count)]
            done = subprocess.run(words, env=environment, capture_output=True, text=True, check=True)
    return {name: (above, tuple(at), tuple(turned)) for name, (above, at, turned) in json.loads(done.stdout).items()}


@contextmanager
def _core(home: Path) -> Generator[dict[str, str]]:
    """A master of its own, on this machine alone."""
    with socket.create_server(("127.0.0.1", 0)) as free:
        port = free.getsockname()[1]
    kept = {name: os.environ[name] for name in ("PATH", "LANG") if name in os.environ}
    environment = {**kept, "ROS_MASTER_URI": f"http://127.0.0.1:{port}", "ROS_IP": "127.0.0.1", "HOME": str(home)}
    with _running(["rosmaster", "--core", "-p", str(port)], environment):
        _wait_for(port)
        yield environment


@contextmanager
def _running(words: list[str], environment: dict[str, str]) -> Generator[None]:
    process = subprocess.Popen(words, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        yield
    finally:
        process.terminate()
        process.wait()


def _wait_for(port: int) -> None:
    end = time.monotonic() + 20
    while True:
        try:
            socket.create_connection(("127.0.0.1", port)).close()
        except ConnectionRefusedError:
            assert time.monotonic() < end, "rosmaster does not answer"
            time.sleep(0.02)
        else:
            return
