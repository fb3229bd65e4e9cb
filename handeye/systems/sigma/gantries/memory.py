"""What the gantries remember besides their scene; pure, for states of runs."""

from msgspec import field

from handeye.core.mutable_records import MutableRecord
from handeye.systems.sigma.protocol import AXES


class GantryMemory(MutableRecord, kw_only=True, tag="gantries"):
    """Two gantries. Lists have a value for each axis, in the order of `AXES`."""

    slipped: list[int] = field(default_factory=lambda: [0] * len(AXES))
    """Poles that rotors have lost, forward; backward if negative."""
    peaks: list[float] = field(default_factory=lambda: [0.0] * len(AXES))
    """The greatest forces on the wrists since they were read last, N."""
    levels: bytes = b""  # of comparators and switches at the last step
    grips: list[bool] = field(default_factory=lambda: [False, False])  # hands are closed, or close
