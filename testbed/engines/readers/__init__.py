"""Other programs' readers of URDF and SDF: whether they accept a file, their messages on it, and what they keep of it.

They are asked whether something changes for them, such as carriers, and whether a profile says what they do.
"""

from typing import TYPE_CHECKING

from twinform.lazy import lazy_attributes

if TYPE_CHECKING:
    from testbed.engines.readers.answers import Kept
    from testbed.engines.readers.library import READERS, Reader, Reading
    from testbed.engines.readers.loaders import LOADERS, USUAL, Loader, Verdict
else:
    # the process of a reader may be of another Python, which has nothing that profiles need
    __getattr__ = lazy_attributes(
        __name__,
        {
            "testbed.engines.readers.answers": "Kept",
            "testbed.engines.readers.library": "READERS Reader Reading",
            "testbed.engines.readers.loaders": "LOADERS USUAL Loader Verdict",
        },
    )

__all__ = ["LOADERS", "READERS", "USUAL", "Kept", "Loader", "Reader", "Reading", "Verdict"]
