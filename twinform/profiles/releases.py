"""Releases of consumers: by which names they are known, which versions they read, and which rows hold for them."""

from collections.abc import Sequence

from pydantic import BaseModel, ConfigDict

from twinform.diagnostics.did_you_mean import did_you_mean
from twinform.request_options import UrdfVersion


class UnknownReleaseError(LookupError):
    """A consumer has no such release; the message names those that it has."""


class Release(BaseModel):
    """A release of a consumer."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    name: str
    also: tuple[str, ...] = ()
    """Other names for it: distributions that ship it, or the versions of what is in it."""

    seen: str = ""
    """The version that was tested; empty where rows for this release were read in a `source`."""

    source: str = ""
    """What was read about it: a repository and its tag, or a page."""

    sdf: str = ""
    """The newest version of SDF that it reads; empty where that does not matter."""

    urdf: UrdfVersion | None = None
    """The newest version of URDF that it reads; None where it does not look at the version."""

    @property
    def names(self) -> tuple[str, ...]:
        """All names, the usual one first."""
        return (self.name, *self.also)

    def as_shipped(self) -> "Release":
        """The release of something else that is built on this one, by the names of the distributions that ship both."""
        return self.model_copy(update={"name": self.also[0], "also": self.also[1:], "seen": "", "source": ""})


def find_release(releases: Sequence[Release], name: str) -> Release:
    """The release that has a name.

    Raises:
        UnknownReleaseError: none has it.
    """
    found = next((each for each in releases if name in each.names), None)
    if found is None:
        known = [name for each in releases for name in each.names]
        raise UnknownReleaseError(did_you_mean(name, known) or f"there are {', '.join(known)}")
    return found


def is_between(releases: Sequence[Release], release: str, since: str, until: str) -> bool:
    """Whether a release is neither before the first nor after the last one; an empty name is no bound.

    Raises:
        UnknownReleaseError: there is no release of one of the names.
    """

    def place(name: str) -> int:
        return releases.index(find_release(releases, name))

    return (not since or place(since) <= place(release)) and (not until or place(release) <= place(until))
