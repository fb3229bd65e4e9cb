"""Defines the state of the gantries that is not in their scene."""

from msgspec import field

from handeye.core.mutable_records import MutableRecord
from handeye.systems.sigma.protocol import AXES


class GantryMemory(MutableRecord, kw_only=True, tag="gantries"):
    """The state of two gantries. Lists have one value per axis, in the order of `AXES`."""

    slipped: list[int] = field(default_factory=lambda: [0] * len(AXES))
    """Number of poles that rotors have slipped forward; negative if backward."""
    holds: list[float] = field(default_factory=lambda: [1.0] * len(AXES))
    """Fraction of the pull-out force with which the pole of each rotor holds the rotor."""
    peaks: list[float] = field(default_factory=lambda: [0.0] * len(AXES))
    """The greatest forces on the wrists since they were last read (N)."""
    levels: bytes = b""  # of comparators and switches at the last step
    missed: list[int] = field(default_factory=lambda: [0] * len(AXES))
    """Pulses that a faulty microcomputer has counted, but not sent to its driver; forward less backward."""
    gaps: list[float] = field(default_factory=lambda: [1.0, 1.0])
    """How far the fingers of each hand may be open, as a fraction, if a fault makes them slow."""
    grips: list[bool] = field(default_factory=lambda: [False, False])  # hands are closed, or close
