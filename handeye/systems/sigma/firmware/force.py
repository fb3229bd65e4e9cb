"""Firmware of a wrist: it scans three components, and raises a pin of a motor while one is above its threshold."""

from collections.abc import Sequence
from typing import Final

from msgspec import field

from handeye.core.mutable_records import MutableRecord
from handeye.ports.microbus import Command, Status
from handeye.systems.sigma.firmware.device import Crystal, Device
from handeye.systems.sigma.protocol import COMPONENTS, FORCE_STEP_N, STANDARD, Op

STANDARD_N: Final = 4.0
CONVERTER_N: Final = 0.05  # step of the converter
_LARGEST: Final = 0x7FFF  # of an answer


class ForceMemory(MutableRecord, kw_only=True, tag="force"):
    """What a force microcomputer remembers: x, y and z, N."""

    thresholds: list[float] = field(default_factory=lambda: [STANDARD_N] * len(COMPONENTS))
    readings: list[float] = field(default_factory=lambda: [0.0] * len(COMPONENTS))


class Force(Device):
    """The firmware of a force microcomputer, which is always busy and takes commands all the same."""

    memory: ForceMemory
    by_interrupt = True

    def __init__(self, crystal: Crystal) -> None:
        super().__init__(crystal)
        self.memory = ForceMemory()

    @property
    def status(self) -> Status:
        return Status.BUSY

    def scan(self, forces: Sequence[float]) -> None:
        """Read all components, N."""
        self.memory.readings = [round(force / CONVERTER_N) * CONVERTER_N for force in forces]

    @property
    def pins(self) -> tuple[bool, ...]:
        """For each component, whether its motor is interrupted."""
        pairs = zip(self.memory.readings, self.memory.thresholds, strict=True)
        return tuple(abs(reading) > threshold for reading, threshold in pairs)

    def execute(self, command: Command, at: int) -> bytes:
        if command.detail >= len(COMPONENTS):
            return b""
        match command.op:
            case Op.FORCE:
                value = round(self.memory.readings[command.detail] / FORCE_STEP_N)
                return max(-_LARGEST, min(value, _LARGEST)).to_bytes(2, "big", signed=True)
            case Op.THRESHOLD:
                newtons = STANDARD_N if command.value == STANDARD else command.value * FORCE_STEP_N
                self.memory.thresholds[command.detail] = newtons
        return b""
