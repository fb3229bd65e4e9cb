"""What hangs on the pins of the microcomputers: a machine, and an ideal one, whose rotors follow each pulse."""

from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import Final, Generic, TypeVar

from msgspec import field

from handeye.core.mutable_records import MutableRecord
from handeye.systems.sigma.firmware.motor import Motor, Pin
from handeye.systems.sigma.protocol import AXES, NUMBERS

TRAVEL: Final = {"X": 16_000, "Y": 10_667, "Z": 5_333}  # steps from switch to switch
Kept = TypeVar("Kept", bound=MutableRecord)


class Plant(ABC, Generic[Kept]):
    """The machine as its pins show it. Numbers are those of microcomputers, times picoseconds."""

    memory: Kept

    @abstractmethod
    def next_pin(self, number: int, motor: Motor) -> tuple[int, Pin, bool] | None:
        """When a switch of the rail changes next if the motor goes on as it does, which, and to what level."""

    @abstractmethod
    def forces(self, number: int) -> Sequence[float]:
        """What a wrist feels now, N along x, y and z."""

    @abstractmethod
    def beam(self, number: int) -> bool:
        """Whether something is in the light beam of a hand."""

    @abstractmethod
    def actuate(self, number: int, devices: Sequence[int]) -> None:
        """The outputs of a hand microcomputer have changed."""


class IdealMemory(MutableRecord, kw_only=True):
    """An ideal machine."""

    starts: dict[int, int] = field(
        default_factory=dict
    )  # steps of each motor past its low switch at power-on
    lengths: dict[int, int] = field(default_factory=dict)  # steps from switch to switch
    forces: dict[int, tuple[float, ...]] = field(default_factory=dict)  # N, of wrists that feel some
    cut: dict[int, bool] = field(default_factory=dict)  # beams
    devices: dict[int, tuple[int, ...]] = field(default_factory=dict)


class IdealMachine(Plant[IdealMemory]):
    """Rotors are where the pulses say; nothing pushes and nothing is in the way, unless it is set so."""

    def __init__(self) -> None:
        self.memory = IdealMemory(
            starts={NUMBERS[axis]: TRAVEL[axis[0]] // 4 for axis in AXES},
            lengths={NUMBERS[axis]: TRAVEL[axis[0]] for axis in AXES},
        )

    def place(self, number: int, motor: Motor, at: int) -> int:
        """True steps of a motor past its low switch."""
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
