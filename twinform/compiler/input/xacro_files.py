"""What a xacro file may read: regular files of some folders, and environment variables of ROS and Gazebo.

The process that expands can open nothing itself. It asks here, in another process, so that nothing of what is decided
lies within its reach.
"""

import os
from collections.abc import Iterable, Iterator, Mapping
from fnmatch import fnmatchcase

from twinform.compiler.input.size_limits import LARGEST
from twinform.compiler.observing import note_look
from twinform.dataclass import dataclass
from twinform.file_access import OutsideError, Readable
from twinform.lazy import lazy_pattern

_MAGIC = lazy_pattern(r"[*?[]")
_MOST_LOOKED_AT = 10_000
"""Entries of folders, for one pattern."""
# a name does not show what is a secret: DBPASS, a connection string or the address of a web hook. So these are listed
# one by one, and no prefix lets in what somebody else has called ROS_SOMETHING.
_USUAL = frozenset({
    "AMENT_CURRENT_PREFIX", "AMENT_PREFIX_PATH", "CMAKE_PREFIX_PATH", "COLCON_CURRENT_PREFIX", "COLCON_PREFIX_PATH",
    "RMW_IMPLEMENTATION", "ROS_AUTOMATIC_DISCOVERY_RANGE", "ROS_DISTRO", "ROS_DOMAIN_ID", "ROS_ETC_DIR", "ROS_HOME",
    "ROS_HOSTNAME", "ROS_IP", "ROS_LOCALHOST_ONLY", "ROS_LOG_DIR", "ROS_MASTER_URI", "ROS_NAMESPACE",
    "ROS_OS_OVERRIDE", "ROS_PACKAGE_PATH", "ROS_PYTHON_VERSION", "ROS_ROOT", "ROS_STATIC_PEERS", "ROS_VERSION",
    "GAZEBO_MASTER_URI", "GAZEBO_MODEL_DATABASE_URI", "GAZEBO_MODEL_PATH", "GAZEBO_PLUGIN_PATH",
    "GAZEBO_RESOURCE_PATH", "GAZEBO_WORLD_LAT", "GAZEBO_WORLD_LON", "GZ_CONFIG_PATH", "GZ_FUEL_CACHE_PATH",
    "GZ_GUI_PLUGIN_PATH", "GZ_IP", "GZ_PARTITION", "GZ_SIM_PHYSICS_ENGINE_PATH", "GZ_SIM_RESOURCE_PATH",
    "GZ_SIM_SYSTEM_PLUGIN_PATH", "GZ_VERSION", "IGNITION_VERSION", "IGN_CONFIG_PATH", "IGN_FUEL_CACHE_PATH",
    "IGN_GAZEBO_RESOURCE_PATH", "IGN_GAZEBO_SYSTEM_PLUGIN_PATH", "IGN_IP", "IGN_PARTITION", "SDF_PATH",
})  # fmt: skip


class DeniedError(Exception):
    """A xacro file has asked for what it must not read; `advice` is what to do if that is meant."""

    def __init__(self, message: str, advice: str = "") -> None:
        super().__init__(message)
        self.advice = advice


@dataclass(frozen=True, slots=True)
class AllowedFiles:
    """The files that a xacro file may read."""

    readable: Readable

    def read(self, path: str) -> bytes:
        """What is in a file.

        Raises:
            DeniedError: it must not be read.
            OSError: it cannot be read.
        """
        try:
            data = self.readable.read(path, LARGEST)
        except OutsideError as error:
            raise _denied(path, error) from error
        if len(data) > LARGEST:
            raise DeniedError(f"cannot read {path!r}: the file is larger than {LARGEST:,} bytes")
        return data

    def match(self, pattern: str) -> list[str]:
        """The files that match a pattern, as the shell has them.

        Raises:
            DeniedError: it leads to where nothing may be read, or to too much.
        """
        parts = [part for place, part in enumerate(pattern.split("/")) if part or not place]
        first = next((place for place, part in enumerate(parts) if _MAGIC.search(part)), len(parts))
        start = "".join(f"{part}/" for part in parts[:first])
        self.require_readable(start or ".")
        if ".." in parts[first:]:
            raise DeniedError(f"the pattern {pattern!r} must not go up behind a wildcard")
        found, left = [start], _MOST_LOOKED_AT
        for part in parts[first:]:
            found, left = self._step(found, part, left)
            if left < 0:
                raise DeniedError(f"the pattern {pattern!r} looks through more than {_MOST_LOOKED_AT:,} files")
        return sorted(path.rstrip("/") for path in found)

    def _step(self, folders: Iterable[str], part: str, left: int) -> tuple[list[str], int]:
        """What is in folders, each with a slash behind it, of the name of one part of a pattern."""
        found: list[str] = []
        for folder in filter(self.readable.allows, folders):
            for name in _entries(folder, part):
                left -= 1
                if left < 0:
                    return found, left
                # what is hidden can be named in a pattern, and is then refused
                if fnmatchcase(name, part) and (not name.startswith(".") or part.startswith(".")):
                    found.append(f"{folder}{name}/")
        return found, left

    def require_readable(self, path: str) -> None:
        """Refuse a file that must not be read.

        Raises:
            DeniedError: it lies outside, or is hidden.
        """
        try:
            self.readable.require(path)
        except OutsideError as error:
            raise _denied(path, error) from error


def _denied(path: str, error: OutsideError) -> DeniedError:
    return DeniedError(f"cannot read {path!r}: it {error.reason}", error.help)


def _entries(folder: str, part: str) -> Iterator[str]:
    if not _MAGIC.search(part):
        note_look(f"{folder}{part}")
        yield from [part] if os.path.lexists(f"{folder}{part}") else []
        return
    try:
        with os.scandir(folder or ".") as entries:
            yield from (entry.name for entry in entries)
    except OSError:  # no folder, or a closed one
        return


def variable(name: str, environment: Mapping[str, str], given: Iterable[str] = ()) -> str | None:
    """The value of an environment variable; None where it is not set. `given` are names, in which `*` may stand.

    Raises:
        DeniedError: it is set, and is none of these.
    """
    value = environment.get(name)
    if value is None or name in _USUAL or any(fnmatchcase(name, each) for each in given):
        return value
    message = f"the environment variable {name!r} is set, but is not given to xacro files, since it may be a secret"
    raise DeniedError(message, f"give it with --env {name}, or as an argument")
