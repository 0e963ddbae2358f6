"""Other programs' readers of URDF and SDF: whether they accept a file, and their messages on it.

They are asked whether something changes for them: a file with carriers has to be for each what it is without them.
"""

from twinform.testing.oracles.readers.library import READERS, Reader, Reading

__all__ = ["READERS", "Reader", "Reading"]
