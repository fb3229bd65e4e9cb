"""Defines the interface of a machine to the pins of the microcomputers. Also defines an ideal machine, whose rotors
follow each pulse.
"""

from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import Final, Generic, NamedTuple, TypeVar

from msgspec import field

from handeye.core.mutable_records import MutableRecord
from handeye.systems.sigma.firmware.motor import Motor, Pin
from handeye.systems.sigma.protocol import AXES, NUMBERS

TRAVEL: Final = {"X": 16_000, "Y": 10_667, "Z": 5_333}  # steps from switch to switch
Kept = TypeVar("Kept", bound=MutableRecord)


class Level(NamedTuple):
    """A change, made by the machine, in the level of a microcomputer's pin."""

    number: int  # number of a motor, or of the force microcomputer that has to scan its wrist
    pin: Pin = "force"
    level: bool = True


class Plant(ABC, Generic[Kept]):
    """The machine as the microcomputers see it at their pins. Numbers identify microcomputers; times are in
    picoseconds.

    There are two kinds of machines. A machine of the first kind has constant forces and can predict its levels:
    `next_pin` returns the next level. A machine of the second kind is simulated step by step and cannot predict its
    levels: `advance` returns the levels that have changed.
    """

    memory: Kept
    predicts = True  # its forces stay as they are until they are set
    longest: int | None = (
        None  # microseconds that may pass at once, so that a person can interrupt; None: any time
    )

    def resumed(self) -> None:
        """The bus calls this method after the state was restored. Afterwards, the bus calls `driven` and `limited` for
        all microcomputers.
        """

    def advance(self, at: int) -> tuple[int, list[Level]] | None:
        """Advance to the time `at`, or to an earlier time at which levels change. Returns the time reached and the
        changed levels.
        """
        return None

    def driven(self, number: int, motor: Motor) -> None:
        """The bus calls this method when a motor may have begun or ended a pulse train."""

    def limited(self, number: int, thresholds: Sequence[float]) -> None:
        """The bus calls this method when a force microcomputer has executed a command that may have changed its
        thresholds (N).
        """

    @abstractmethod
    def next_pin(self, number: int, motor: Motor) -> tuple[int, Pin, bool] | None:
        """If the motor continues, a switch of the rail may change. Return the time of the next change, the pin of the
        switch, and the new level; return None if no switch will change.
        """

    @abstractmethod
    def forces(self, number: int) -> Sequence[float]:
        """Return the present force on a wrist along x, y and z (N)."""

    def peaks(self, number: int) -> Sequence[float]:
        """Return the greatest forces on a wrist since the last query (N)."""
        return tuple(map(abs, self.forces(number)))

    @abstractmethod
    def beam(self, number: int) -> bool:
        """Return True if an object is in the light beam of a hand."""

    @abstractmethod
    def actuate(self, number: int, devices: Sequence[int]) -> None:
        """The bus calls this method when the outputs of a hand microcomputer have changed."""


class IdealMemory(MutableRecord, kw_only=True, tag="ideal"):
    """The state of an ideal machine."""

    starts: dict[int, int] = field(
        default_factory=dict
    )  # steps of each motor past its low switch at power-on
    lengths: dict[int, int] = field(default_factory=dict)  # steps from switch to switch
    forces: dict[int, tuple[float, ...]] = field(default_factory=dict)  # N: forces on wrists that feel any
    cut: dict[int, bool] = field(default_factory=dict)  # beams
    devices: dict[int, tuple[int, ...]] = field(default_factory=dict)


class IdealMachine(Plant[IdealMemory]):
    """An ideal machine. The rotors of this machine are where the pulses put them. There are no forces or obstacles,
    unless a caller sets some.
    """

    def __init__(self) -> None:
        self.memory = IdealMemory(
            starts={NUMBERS[axis]: TRAVEL[axis[0]] // 4 for axis in AXES},
            lengths={NUMBERS[axis]: TRAVEL[axis[0]] for axis in AXES},
        )

    def place(self, number: int, motor: Motor, at: int) -> int:
        """Return the true position of a motor (steps from its low switch)."""
        return self.memory.starts.get(number, 0) + motor.sent(at)

    def next_pin(self, number: int, motor: Motor) -> tuple[int, Pin, bool] | None:
        known = motor.memory
        if number not in self.memory.starts or known.train is None:
            return None
        here, length = self.memory.starts[number] + known.pulses, self.memory.lengths[number]
        if known.sense < 0:
            crossings: list[tuple[int, Pin, bool]] = [(here, "low", True), (here - length + 1, "high", False)]
        else:
            crossings = [(1 - here, "low", False), (length - here, "high", True)]
        found = [
            (when, pin, level)
            for pulse, pin, level in crossings
            if getattr(known, pin) != level and (when := motor.when(pulse)) is not None
        ]
        return min(found) if found else None

    def forces(self, number: int) -> Sequence[float]:
        return self.memory.forces.get(number, (0.0, 0.0, 0.0))

    def beam(self, number: int) -> bool:
        return self.memory.cut.get(number, False)

    def actuate(self, number: int, devices: Sequence[int]) -> None:
        self.memory.devices[number] = tuple(devices)
