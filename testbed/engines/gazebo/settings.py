"""How a model is simulated: steps of time, what drives its joints, and what it stands on."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path


@dataclass(frozen=True, slots=True)
class Settings:
    """How long and how a simulation runs; without steps, a file is only loaded.

    Joints are named as in their model, or with its name before them (`rover::wheel`).
    """

    steps: int = 0
    dt: float = 0.001
    """The length of a step, in s."""
    every: int = 0
    """A moment is kept after so many steps each; 0 keeps only the first and the last."""
    start: float = 0.0
    """The rate of every degree of freedom at the start, in rad/s or m/s; only DART sets it."""
    ground: float | None = None
    """The height in m of a plane under the models, with the default friction of SDF; None for no plane."""
    velocities: Mapping[str, float] = field(default_factory=dict[str, float])
    """The velocity that is commanded before each step, in rad/s or m/s, by joint."""
    forces: Mapping[str, float] = field(default_factory=dict[str, float])
    """The force that is applied in each step, in N m or N, by joint."""
    period: float = 0.0
    """Forces swing as a sine of this period in s, from 0 on; 0 for forces that stay."""
    folders: tuple[Path, ...] = ()
    """Where files that are included as `model://NAME`, or by a relative path, are looked up."""
    seconds: int = 20
    """How long the engine may take for a file, in s of the clock."""

    def arguments(self) -> Iterator[str]:
        """As options of the program."""
        yield from ("--steps", str(self.steps), "--dt", repr(self.dt), "--every", str(self.every))
        yield from ("--start", repr(self.start), "--seconds", str(self.seconds), "--period", repr(self.period))
        if self.ground is not None:
            yield from ("--ground", repr(self.ground))
        for option, values in (("--velocity", self.velocities), ("--force", self.forces)):
            for joint, value in values.items():
                yield from (option, f"{joint}={value!r}")
