"""Each leg of a relay hands over a small record to the next leg. The record is in SI units, and is independent of the
languages.

Each system writes and reads the record in its own way (`handeye/runs/legs.py`). The record says where the hand is,
what the hand holds, and which places the programs have found. The record contains only what sensors and programs know.
"""

from typing import Final, Literal

import numpy as np
from msgspec import field

from handeye.arm.kinematics import forward
from handeye.arm.model import ArmModel
from handeye.core.diagnostics import quoted
from handeye.core.errors import Refused
from handeye.core.mutable_records import MutableRecord
from handeye.core.plain_text import counted
from handeye.core.pose import Array, hand
from handeye.core.record import Record
from handeye.ports.workcell import Sensed
from handeye.program.world_model import rounded_place
from handeye.vision.calibration import Calibration

MOVED: Final = 3e-3
"""Greatest distance (m) of the hand from the place that the record gives. Our choice: while the brakes are set, the
hand sinks by less than this distance.
"""
TURNED: Final = 0.02  # rad by which the hand may be turned. Our choice.
GAP_CHANGED: Final = 1e-3
"""If the gap between the fingers has changed by at most this distance (m), we assume that the hand still holds the
same part. Our choice: if a part turns until it lies flat against the fingers, the gap becomes up to .55 mm wider or
narrower.
"""
MOST_NAMES: Final = 200

Kind = Literal["place", "difference", "height"]
"""A place of the hand or of a part (x, y, z, O, A, T), a difference between two places (x, y, z), or a height (z)."""
SIZES: Final[dict[Kind, int]] = {"place": 6, "difference": 3, "height": 1}
"""For each kind of value, how many numbers it has."""
UNITS: Final = ("m", "rad", "N")


class HandOver(Record, frozen=True, kw_only=True):
    """The record that is handed over between two legs."""

    units: tuple[str, ...] = UNITS  # of lengths, angles and forces
    hand: tuple[float, ...]  # x, y, z in W and O, A, T, by the potentiometers
    gap: float  # of the fingers, as sensed
    held: str = ""  # the part that the hand holds, as its program calls it; empty: none
    load: float = 0.0  # weight of what the hand holds, as the program knows it
    named: dict[Kind, dict[str, tuple[float, ...]]] = field(default_factory=dict)
    """The values that programs have found, by kind and name. Each value is a tuple of numbers."""

    def check(self) -> None:
        """Raise Refused unless the record is in SI units and all its values are finite numbers."""
        if self.units != UNITS:
            raise Refused(
                f"the hand-over record is in {', '.join(self.units)}; it must be in {', '.join(UNITS)}"
            )
        if len(self.hand) != SIZES["place"] or not np.isfinite([*self.hand, self.gap, self.load]).all():
            raise Refused(
                "the hand-over record must give the hand as six finite numbers, the gap as one finite number, and "
                "the load as one finite number"
            )
        if sum(map(len, self.named.values())) > MOST_NAMES:
            raise Refused(f"the hand-over record has more than {MOST_NAMES} names")
        for kind, values in self.named.items():
            for name, numbers in values.items():
                if len(numbers) != SIZES[kind] or not np.isfinite(numbers).all():
                    raise Refused(
                        f"the {kind} {quoted(name)} of the hand-over record must have "
                        f"{counted(SIZES[kind], 'finite number')}, not {len(numbers)}"
                    )

    def value(self, name: str, kind: Kind) -> Array:
        """Return the numbers of the value `name` in SI units. Raises Refused if the value is missing, or if it is not
        of the kind `kind`.
        """
        found = self.named.get(kind, {}).get(name)
        if found is not None:
            return np.array(found)
        other = next((other for other, values in self.named.items() if name in values), None)
        if other is None:
            raise Refused(f"the hand-over record has no {kind} {quoted(name)}")
        raise Refused(f"{quoted(name)} is a {other} in the hand-over record, but the leg needs a {kind}")

    def height(self, name: str) -> float:
        """Return the height (m) of the value `name`. The value may be a height or a place. Raises Refused as `value`
        does.
        """
        if name in self.named.get("place", {}) and name not in self.named.get("height", {}):
            return float(self.value(name, "place")[2])
        return float(self.value(name, "height")[0])

    def check_hand(self, sensed: Sensed, arm: ArmModel) -> None:
        """Raise Refused unless the sensors show that the hand and the fingers are as the record says."""
        self.check()
        X_WT, told = forward(arm, sensed.q), hand(*self.hand)
        off = float(np.linalg.norm(X_WT[:3, 3] - told[:3, 3]))
        if off > MOVED:
            raise Refused(
                f"the hand is {off * 1e3:.1f} mm from its place in the hand-over record; at most {MOVED * 1e3:g} mm "
                "are allowed"
            )
        cosine = (float(np.trace(X_WT[:3, :3].T @ told[:3, :3])) - 1) / 2
        turned = float(np.arccos(np.clip(cosine, -1.0, 1.0)))
        if turned > TURNED:
            raise Refused(
                f"the hand is turned by {np.degrees(turned):.1f} degrees from its pose in the hand-over record; at "
                f"most {np.degrees(TURNED):.1f} degrees are allowed"
            )
        if self.held and abs(sensed.gap - self.gap) > GAP_CHANGED:
            raise Refused(
                f"the hand-over record says that the hand holds {self.held} with a gap of {self.gap * 1e3:.1f} mm, "
                f"but the gap is {sensed.gap * 1e3:.1f} mm"
            )


def place_now(sensed: Sensed, arm: ArmModel) -> tuple[float, ...]:
    """Return the place of the hand, as the potentiometers measure it."""
    return rounded_place(forward(arm, sensed.q))


class StationMemory(MutableRecord, kw_only=True):
    """The measurements that the station made of its own devices before the first leg, and the state of its camera.
    This memory belongs to the devices and not to a program, so every leg may use it. Joint arrays have shape (n,).
    """

    friction: Array  # Coulomb friction (N m, N); 0 if unknown
    links: Array | None = None  # measured weights of the links, divided by the weights in the model
    weights: Array | None = None  # later estimate, see `arm.torque_balance`
    calibration: Calibration | None = None  # of the camera; None if no program takes pictures
    lens: float | None = None  # focal length of the lens in place (m); None: unknown
    camera_ready: float = 0.0  # time (s) at which the camera's mechanism is ready
