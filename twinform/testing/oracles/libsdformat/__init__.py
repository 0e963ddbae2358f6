"""libsdformat 12, the reference parser of SDF: its messages on files, and the robot that it sees in one."""

from twinform.testing.oracles.libsdformat.library import MISSING, LibsdformatReading, available, judge

__all__ = ["MISSING", "LibsdformatReading", "available", "judge"]
