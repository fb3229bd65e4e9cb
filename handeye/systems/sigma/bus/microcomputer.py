"""A microcomputer on the bus. It polls the strobe with its own clock and takes five bytes. If the bytes are addressed
to this microcomputer, it executes the command.
"""

from collections.abc import Sequence
from typing import NamedTuple

from handeye.core.mutable_records import MutableRecord
from handeye.ports.microbus import COMMAND_BYTES, Command, Status
from handeye.systems.sigma.bus.layout import Place
from handeye.systems.sigma.bus.wires import Sending, Speech, Wires
from handeye.systems.sigma.firmware.device import Crystal, Device
from handeye.systems.sigma.firmware.force import Force, ForceMemory
from handeye.systems.sigma.firmware.hand import Hand, HandMemory, Sensor, SensorMemory
from handeye.systems.sigma.firmware.motor import Motor, MotorMemory
from handeye.systems.sigma.protocol import Timing


class NodeMemory(MutableRecord, kw_only=True):
    """The state of a microcomputer. Times are in ps."""

    device: MotorMemory | ForceMemory | HandMemory | SensorMemory
    listens: int | None = None  # time since which it polls the strobe
    noticed: int | None = None  # time at which it saw the strobe of the command that it is taking
    working: int | None = None  # time until which it executes a command
    speech: Speech | None = None  # its answer, as soon as the answer is known


class Taken(NamedTuple):
    """Five bytes that a receiver took. Times are in ps."""

    frame: bytes
    sampled: tuple[int, ...]  # ps
    noticed: int
    checked: int


class Microcomputer:
    """One microcomputer with its receiver, its firmware and its status lines."""

    def __init__(
        self, place: Place, timing: Timing, *, answers_to: int, ppm: int, phase: int, dead: bool
    ) -> None:
        self.place, self.timing = place, timing
        self.answers_to, self.dead = answers_to, dead
        self.crystal = Crystal(ppm)
        self.device = self._firmware()
        first = 0 if self.device.by_interrupt else phase
        self.memory = NodeMemory(device=self._device_memory(), listens=None if dead else first)

    def _firmware(self) -> Device:
        match self.place.kind:
            case "motor":
                return Motor(self.crystal)
            case "force":
                return Force(self.crystal)
            case "hand":
                return Hand(self.crystal, self.timing)
            case "sensor":
                return Sensor(self.crystal, bytes(range(1, self.place.length + 1)))

    def _device_memory(self) -> MotorMemory | ForceMemory | HandMemory | SensorMemory:
        memory = self.device.memory
        assert isinstance(memory, MotorMemory | ForceMemory | HandMemory | SensorMemory)
        return memory

    def bind(self, memory: NodeMemory) -> None:
        """Continue from a state."""
        self.memory, self.device.memory = memory, memory.device

    @property
    def status(self) -> Status:
        """The levels of the status lines."""
        if self.dead:
            return Status.FREE
        if self.memory.working is not None or self.memory.speech is not None:
            return Status.BUSY
        return self.device.status

    @property
    def due(self) -> int | None:
        """Time of the next action of the receiver or the firmware (ps), or None if there is no next action."""
        if self.dead:
            return None
        memory = self.memory
        checked = None if memory.noticed is None else self._checked(memory.noticed)
        times = [
            time for time in (checked, memory.working, self._silent, self.device.due) if time is not None
        ]
        return min(times) if times else None

    @property
    def _silent(self) -> int | None:
        """Time at which the present answer ends (ps), or None if no answer is being sent."""
        speech = self.memory.speech
        return None if speech is None else speech.lows(self.timing)[-1][1]

    def _checked(self, noticed: int) -> int:
        last = (COMMAND_BYTES - 1) * self.timing.slot
        return noticed + self.crystal.micros(self.timing.sample + last + self.timing.check)

    # -- receiving ---------------------------------------------------------------------------------------

    def listen(self, at: int, sent: Sequence[Sending], wires: Wires, *, quiet: bool) -> list["Taken"]:
        """Look for a strobe if the microcomputer is free to take a command. Returns the commands for other
        microcomputers that this microcomputer took from the lines and then dropped.

        If a line is faulty, or if an answer is on the lines (`quiet` is False), no commands are returned. This
        microcomputer then receives each command byte by byte, even a command for another microcomputer.
        """
        memory, passed = self.memory, list[Taken]()
        if not self._takes():
            memory.listens = None
            return passed
        if memory.listens is None:
            memory.listens = at
        segment = self.place.segment
        if wires.cut_off[segment]:
            return passed
        for sending in sent:
            falls, rises = wires.strobe(sending)
            while rises > memory.listens and (seen := self._sees(memory.listens, falls, rises)) is not None:
                sampled = self._sampled(seen)
                whole = quiet and wires.whole(sending, segment, sampled[0], sampled[-1])
                if not whole or sending.frame[0] == self.answers_to:
                    memory.listens, memory.noticed = None, seen
                    return passed
                passed.append(Taken(sending.frame, sampled, seen, self._checked(seen)))
                memory.listens = self._checked(seen)
        return passed

    def _takes(self) -> bool:
        """Return True if the microcomputer is free to look for a strobe."""
        memory = self.memory
        if self.dead or memory.noticed is not None or memory.working is not None or memory.speech is not None:
            return False
        return self.device.by_interrupt or self.device.status is not Status.BUSY

    def _sees(self, listens: int, falls: int, rises: int) -> int | None:
        if self.device.by_interrupt:  # the interrupt is triggered by an edge
            return falls + self.crystal.micros(self.timing.interrupt) if falls >= listens else None
        seen = self.crystal.after(listens, self.timing.poll, max(falls, listens))
        return seen if seen < rises else None

    def _sampled(self, noticed: int) -> tuple[int, ...]:
        first, slot = (
            noticed + self.crystal.micros(self.timing.sample),
            self.crystal.micros(self.timing.slot),
        )
        return tuple(range(first, first + COMMAND_BYTES * slot, slot))

    def receive(
        self, at: int, sent: Sequence[Sending], speeches: Sequence[Speech], wires: Wires
    ) -> Taken | None:
        """Return the five bytes that the microcomputer has taken. It returns them at the moment when it compares the
        number in the bytes with its own number, and None at all other times.
        """
        noticed = self.memory.noticed
        if noticed is None or self._checked(noticed) != at:
            return None
        self.memory.noticed = None
        sampled, segment = self._sampled(noticed), self.place.segment
        frame = bytes(wires.data(segment, time, sent, speeches) for time in sampled)
        return Taken(frame, sampled, noticed, at)

    def act(self, command: Command, at: int) -> None:
        """Execute a command addressed to this microcomputer."""
        answer = self.device.take(command, at)
        if not answer:
            self.memory.working = at + self.crystal.micros(self.timing.act)
            return
        begin = at + self.crystal.micros(self.timing.prepare)
        self.memory.speech = Speech(
            number=self.place.number,
            segment=self.place.segment,
            frame=answer,
            begin=begin,
            ppm=self.crystal.ppm,
        )

    def elapse(self, at: int) -> None:
        """Perform all actions that are due, except receiving."""
        memory = self.memory
        if self.device.due == at:
            self.device.elapse(at)
        if memory.working == at:
            memory.working = None
        if self._silent == at:
            memory.speech = None
