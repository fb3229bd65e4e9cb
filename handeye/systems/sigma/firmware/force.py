"""Firmware of a wrist, which scans the three components of force. Each component has a signal line to the motor
microcomputer of its axis. This line is active while the component exceeds its threshold.
"""

from collections.abc import Sequence
from typing import Final

from msgspec import field

from handeye.core.mutable_records import MutableRecord
from handeye.ports.microbus import Command, Status
from handeye.systems.sigma.firmware.device import Crystal, Device
from handeye.systems.sigma.protocol import COMPONENTS, FORCE_STEP_N, STANDARD, Op

STANDARD_N: Final = 4.0
CONVERTER_N: Final = 0.05  # N: step of the converter
RELEASED: Final = 0.8
"""Fraction of a threshold. After the force has exceeded the threshold, the microcomputer keeps its signal on until the
force has fallen below this fraction of the threshold. So a swinging wrist does not trip the threshold twice.
"""
_LARGEST: Final = 0x7FFF  # greatest value of an answer


class ForceMemory(MutableRecord, kw_only=True, tag="force"):
    """The state of a force microcomputer, with values for x, y and z (N)."""

    thresholds: list[float] = field(default_factory=lambda: [STANDARD_N] * len(COMPONENTS))
    readings: list[float] = field(default_factory=lambda: [0.0] * len(COMPONENTS))
    peaks: list[float] = field(default_factory=lambda: [0.0] * len(COMPONENTS))
    """The greatest magnitude of each reading since this peak was last queried."""
    over: list[bool] = field(default_factory=lambda: [False] * len(COMPONENTS))
    """True for components whose last reading was above the threshold."""


class Force(Device):
    """The firmware of a force microcomputer. A force microcomputer always shows that it is busy, but takes commands
    nevertheless.
    """

    memory: ForceMemory
    by_interrupt = True

    def __init__(self, crystal: Crystal) -> None:
        super().__init__(crystal)
        self.memory = ForceMemory()

    @property
    def status(self) -> Status:
        return Status.BUSY

    def scan(self, forces: Sequence[float], peaks: Sequence[float]) -> None:
        """Read all components of force (N), and their greatest values since the last scan."""
        self.memory.readings = [_converted(force) for force in forces]
        self.memory.over = [*self.pins]
        self.memory.peaks = [*map(max, self.memory.peaks, map(_converted, peaks))]

    @property
    def pins(self) -> tuple[bool, ...]:
        """For each component of force, True if the sensor interrupts the motor of the component's axis. The
        interruption begins when the force exceeds the threshold, and ends when the force is well below the threshold.
        """
        memory = self.memory
        each = zip(memory.readings, memory.thresholds, memory.over, strict=True)
        return tuple(
            abs(reading) > (threshold * RELEASED if over else threshold) for reading, threshold, over in each
        )

    def execute(self, command: Command, at: int) -> bytes:
        if command.detail >= len(COMPONENTS):
            return b""
        match command.op:
            case Op.FORCE:
                return _answer(self.memory.readings[command.detail])
            case Op.PEAK_FORCE:
                peak, self.memory.peaks[command.detail] = self.memory.peaks[command.detail], 0.0
                return _answer(peak)
            case Op.THRESHOLD:
                newtons = STANDARD_N if command.value == STANDARD else command.value * FORCE_STEP_N
                self.memory.thresholds[command.detail] = newtons
        return b""


def _converted(force: float) -> float:
    return round(force / CONVERTER_N) * CONVERTER_N


def _answer(force: float) -> bytes:
    return max(-_LARGEST, min(round(force / FORCE_STEP_N), _LARGEST)).to_bytes(2, "big", signed=True)
