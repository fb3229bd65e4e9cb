"""Two kinds of firmware: that of a hand with its light beam, and that of newer sensors, whose answers may have any
length.
"""

from typing import Final

from msgspec import field

from handeye.core.mutable_records import MutableRecord
from handeye.ports.microbus import Command, Status
from handeye.systems.sigma.firmware.device import Crystal, Device
from handeye.systems.sigma.protocol import DEVICES, Op, Timing

_FINGERS: Final = DEVICES["HAND"]


class HandMemory(MutableRecord, kw_only=True, tag="hand"):
    """The state of a hand microcomputer."""

    devices: list[int] = field(default_factory=lambda: [0] * len(DEVICES))
    until: int | None = None  # ps: time at which the fingers have finished moving
    cut: bool = False  # True: the beam is broken, according to its pin


class Hand(Device):
    """The firmware of a hand microcomputer."""

    memory: HandMemory

    def __init__(self, crystal: Crystal, timing: Timing) -> None:
        super().__init__(crystal)
        self.memory, self.timing = HandMemory(), timing

    @property
    def status(self) -> Status:
        return Status.FREE if self.memory.until is None else Status.BUSY

    @property
    def due(self) -> int | None:
        return self.memory.until

    def elapse(self, at: int) -> None:
        self.memory.until = None

    def execute(self, command: Command, at: int) -> bytes:
        match command.op:
            case Op.BEAM:
                return bytes((self.memory.cut,))
            case Op.ACTUATE if command.detail < len(DEVICES):
                self.memory.devices[command.detail] = command.value
                if command.detail == _FINGERS:
                    self.memory.until = at + self.crystal.micros(self.timing.hand)
        return b""


class SensorMemory(MutableRecord, kw_only=True, tag="sensor"):
    """The state of a sensor."""

    reading: bytes = b""


class Sensor(Device):
    """The firmware of a newer kind of sensor, whose answer may have any length."""

    memory: SensorMemory

    def __init__(self, crystal: Crystal, reading: bytes) -> None:
        super().__init__(crystal)
        self.memory = SensorMemory(reading=reading)

    @property
    def status(self) -> Status:
        return Status.FREE

    def execute(self, command: Command, at: int) -> bytes:
        return self.memory.reading if command.op == Op.SENSE else b""
