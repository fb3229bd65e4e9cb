"""Defines the part of the gantries' state that their scene does not contain."""

from msgspec import field

from handeye.core.mutable_records import MutableRecord
from handeye.systems.sigma.protocol import AXES


class GantryMemory(MutableRecord, kw_only=True, tag="gantries"):
    """The state of the gantries. Lists have one value per axis, in the order of the machine."""

    slipped: list[int] = field(default_factory=lambda: [0] * len(AXES))
    """For each rotor, the number of poles by which it has slipped forward; negative if it has slipped backward."""
    holds: list[float] = field(default_factory=lambda: [1.0] * len(AXES))
    """For each rotor, the force with which a pole holds the rotor, as a fraction of the pull-out force."""
    peaks: list[float] = field(default_factory=lambda: [0.0] * len(AXES))
    """The greatest forces on the wrists (N) since the forces were last read."""
    levels: bytes = b""  # levels of comparators and switches at the last step
    missed: list[int] = field(default_factory=lambda: [0] * len(AXES))
    """Pulses that a faulty microcomputer has counted, but not sent to its driver; forward minus backward."""
    gaps: list[float] = field(default_factory=lambda: [1.0, 1.0])
    """Commanded opening of the fingers of each hand, as a fraction of the full opening. Used only for a hand whose
    fingers are slow because of a fault.
    """
    grips: list[bool] = field(default_factory=lambda: [False, False])  # closed or closing hands

    @classmethod
    def of(cls, axes: int, hands: int) -> "GantryMemory":
        """Return the state of a machine when its power comes on. `axes` and `hands` are the numbers of its axes and
        hands.
        """
        return cls(
            slipped=[0] * axes, holds=[1.0] * axes, peaks=[0.0] * axes, missed=[0] * axes,
            gaps=[1.0] * hands, grips=[False] * hands,
        )  # fmt: skip
