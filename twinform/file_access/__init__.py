"""File access: which files the files of a stranger may lead to, and the one reader that opens them."""

from twinform.file_access.readable import OutsideError, Readable
from twinform.file_access.regular_files import STREAMS, read_regular, read_up_to

__all__ = ["STREAMS", "OutsideError", "Readable", "read_regular", "read_up_to"]
