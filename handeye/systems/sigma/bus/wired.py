"""Simulates the bus behind its interface: the lines at the central computer, all microcomputers, and the
machine.

There are no time steps. Waves, polls, samples and pulses are computed in closed form, and time advances from
event to event.
"""

from collections.abc import Callable, Sequence
from typing import Any, Final, Literal

from msgspec import field

from handeye.core.distributions import random_numbers
from handeye.core.errors import BadFile, Refused
from handeye.core.mutable_records import MutableRecord, put_back
from handeye.ports.microbus import PAGE, Command, MicrobusPort, NoAnswer, Status, StrayAnswer
from handeye.systems.sigma.bus.events import (
    AnswerEnded,
    AnyBusEvent,
    ByteHeard,
    ByteSpoken,
    CommandSent,
    FrameTaken,
    InterruptLine,
    StatusLines,
)
from handeye.systems.sigma.bus.faults import BusDefect, check_place
from handeye.systems.sigma.bus.layout import SUPERSIGMA, Layout, Place
from handeye.systems.sigma.bus.microcomputer import Microcomputer, NodeMemory, Taken
from handeye.systems.sigma.bus.plant import IdealMachine, IdealMemory, Level, Plant
from handeye.systems.sigma.bus.wires import Sending, Wires
from handeye.systems.sigma.firmware.device import PS, Crystal
from handeye.systems.sigma.firmware.force import CONVERTER_N, Force
from handeye.systems.sigma.firmware.hand import Hand
from handeye.systems.sigma.firmware.motor import Motor, Pin
from handeye.systems.sigma.gantries.memory import GantryMemory
from handeye.systems.sigma.protocol import Timing, name_of

_REMEMBERED: Final = 400  # microseconds for which old waves are kept
_COMPUTER: Final = Crystal()  # the clock of the central computer; the errors of all others refer to it
_HALF_STEP: Final = CONVERTER_N / 2 + 1e-9  # N by which a reading may differ from a force
_PER_MILLE: Final = 1_000  # ppm


class Question(MutableRecord, kw_only=True):
    """A question whose answer the central computer awaits. Times are in ps."""

    number: int
    wanted: int
    got: bytes = b""
    phase: Literal["low", "sample", "high", "guard", "over"] = "low"
    since: int = 0  # time at which the phase began
    failed: Literal["", "no answer", "stray byte"] = ""


class BusMemory(MutableRecord, kw_only=True):
    """The complete state of a bus and its machine."""

    now: int = 0  # microseconds
    taken_until: int = 0  # microseconds: time until which a command takes the lines
    sent: tuple[Sending, ...] = ()  # the last commands that were sent
    question: Question | None = None
    nodes: dict[int, NodeMemory] = field(default_factory=dict)
    plant: IdealMemory | GantryMemory = field(default_factory=IdealMemory)


class WiredBus(MicrobusPort):
    """A bus with its microcomputers, connected to a machine."""

    def __init__(
        self,
        layout: Layout = SUPERSIGMA,
        *,
        plant: Plant[Any] | None = None,
        timing: Timing | None = None,
        defects: Sequence[BusDefect] = (),
        seed: int = 0,
        clock_spread: float = 0.0,
    ) -> None:
        """Switch the bus on.

        Args:
            defects: injected faults of the bus.
            seed: seed of the random numbers. These are the times at which the microcomputers begin to poll, and the
                errors of their clocks.
            clock_spread: greatest clock error, as a fraction, for example .005.
        """
        layout.check()
        for defect in defects:
            check_place(defect, len(layout.behind), [place.number for place in layout.places])
        self.layout, self.timing = layout, timing or Timing()
        self.plant: Plant[Any] = plant or IdealMachine()
        cut = any(defect.kind == "no-reflex" for defect in defects)
        self._wired = {} if cut else layout.reflexes
        self.wires = Wires(layout, self.timing, defects)
        self.tell: list[
            Callable[[AnyBusEvent], None]
        ] = []  # called with each event, which they cannot change; some events come ahead of their time
        self._defects = tuple(defects)
        self._nodes = {place.number: self._switched_on(place, seed, clock_spread) for place in layout.places}
        self._memory = BusMemory(plant=self.plant.memory)
        self._memory.nodes = {number: node.memory for number, node in self._nodes.items()}
        self._joined = not any(defect.kind == "no-interrupt" for defect in defects)
        self._reckon()

    def _switched_on(self, place: Place, seed: int, spread: float) -> Microcomputer:
        drawn = random_numbers(seed, f"microcomputer {place.number}")
        phase = int(drawn.integers(self.timing.poll * PS))
        ppm = round(float(drawn.uniform(-spread, spread)) * PS)
        mine = {d.kind: d.value for d in self._defects if d.where == place.number}
        return Microcomputer(
            place,
            self.timing,
            answers_to=mine.get("address", place.number),
            ppm=ppm + mine.get("clock", 0) * _PER_MILLE,
            phase=phase,
            dead="dead" in mine,
        )

    def _reckon(self) -> None:
        """Compute the values that are not saved in a state: due times, shown levels, and inputs of the machine."""
        self._due = {number: self._due_of(number, self.now * PS) for number in self._nodes}
        self._shown = {number: self._status(number) for number in self._nodes}
        self._level, self._changed = self._tied(), False
        for number, node in self._nodes.items():
            self._show(number, node)

    # -- the port ----------------------------------------------------------------------------------------

    @property
    def now(self) -> int:
        return self._memory.now

    @property
    def next_event(self) -> int | None:
        due = self._next()
        return None if due is None else max(self.now, -(-due // PS))

    @property
    def free(self) -> bool:
        question = self._memory.question
        return self.now >= self._memory.taken_until and (question is None or question.phase == "over")

    def begin(self, command: Command, answer: int = 0) -> None:
        memory = self._memory
        if not self.free:
            raise Refused(
                "the bus still carries a command or an answer; wait until the bus is free before sending the next "
                "command"
            )
        sending = Sending(
            start=self.now,
            frame=command.frame,
            falls=self.timing.strobe_falls,
            rises=self.wires.strobe_rises,
        )
        memory.sent = (*(s for s in memory.sent if s.start > self.now - _REMEMBERED), sending)
        memory.taken_until = self.now + self.timing.command
        since = memory.taken_until * PS
        memory.question = Question(number=command.number, wanted=answer, since=since) if answer else None
        falls, rises = self.wires.strobe(sending)
        self._say(CommandSent(at=self.now * PS, frame=sending.frame, falls=falls, rises=rises))
        for number, node in self._nodes.items():
            if node.memory.listens is not None:
                self._listen(node, self.now * PS)
                if node.memory.noticed is not None:
                    self._due[number] = self._due_of(number, self.now * PS)

    def answer(self) -> bytes:
        question = self._memory.question
        if question is None or question.phase != "over":
            raise Refused("no question has been answered yet")
        if question.failed == "no answer":
            raise NoAnswer(question.number, len(question.got), question.wanted)
        if question.failed:
            raise StrayAnswer(question.number)
        return question.got

    def page(self, number: int) -> int:
        if not 0 <= number < self.layout.pages:
            raise Refused(
                f"there is no page {number} of status lines; the pages are 0 to {self.layout.pages - 1}"
            )
        first = number * PAGE
        return sum(int(self._shown.get(first + place, 0)) << 2 * place for place in range(PAGE))

    @property
    def interrupt(self) -> bool:
        return self._level

    def wait(self, until: int) -> int:
        if self.plant.longest is not None:
            until = min(until, self.now + self.plant.longest)
        while self.now < until:
            due = self._next()
            moment = until if due is None else min(until, max(self.now, -(-due // PS)))
            if self._pass(moment):
                break
        return self.now

    @property
    def memory(self) -> BusMemory:
        return self._memory

    def remember(self, memory: MutableRecord) -> None:
        if not isinstance(memory, BusMemory) or not self._fits(memory):
            raise BadFile("the state belongs to another bus")
        put_back(self._memory, memory)
        self.plant.memory = self._memory.plant
        self.plant.resumed()
        for number, node in self._nodes.items():
            node.bind(self._memory.nodes[number])
        self._reckon()

    def _fits(self, memory: BusMemory) -> bool:
        mine = {number: type(node.device.memory) for number, node in self._nodes.items()}
        return {number: type(node.device) for number, node in memory.nodes.items()} == mine

    # -- the machine's side ------------------------------------------------------------------------------

    def motor(self, number: int) -> Motor:
        """Return the firmware of a motor. Raises Refused if the microcomputer is not a motor."""
        device = self._nodes[number].device
        if not isinstance(device, Motor):
            raise Refused(f"{name_of(number)} is not a motor")
        return device

    def touched(self, *numbers: int) -> None:
        """Update the microcomputers whose forces, beams or pins the machine has changed."""
        for number in numbers:
            self._due[number] = self._due_of(number, self.now * PS)

    def pin(self, number: int, pin: Pin, level: bool) -> None:
        """Set a pin of a motor now."""
        motor = self.motor(number)
        if getattr(motor.memory, pin) != level:
            motor.pin(pin, level, self.now * PS)
            self._settle(number, self.now * PS)

    # -- events ------------------------------------------------------------------------------------------

    def _next(self) -> int | None:
        times = [due for due in self._due.values() if due is not None]
        if self.now < self._memory.taken_until:
            times.append(self._memory.taken_until * PS)
        if (due := self._computer_due()) is not None:
            times.append(due)
        return min(times) if times else None

    def _pass(self, moment: int) -> bool:
        """Advance to the time `moment`, or to an earlier time at which the interface changes. Returns True if the
        interface changed.
        """
        free, self._changed = self.free, False
        while True:
            due = self._next_below(moment)
            at = moment * PS if due is None else due
            if (seen := self.plant.advance(at)) is not None:
                at, levels = seen
                for level in levels:
                    self._sense(level, at)
            elif due is None:
                break
            else:
                self._events(due)
            if self._changed:
                moment = max(self.now, min(moment, -(-at // PS)))
        self._memory.now = moment
        return self._changed or self.free != free

    def _events(self, due: int) -> None:
        """Handle all events that are due at the time `due`."""
        for number, at in self._due.items():
            if at is not None and at <= due:
                self._serve(number, at)
        if (at := self._computer_due()) is not None and at <= due:
            self._compute(at)

    def _sense(self, level: Level, at: int) -> None:
        """Handle a level that the machine has changed."""
        node = self._nodes[level.number]
        if node.dead:
            return
        if isinstance(node.device, Force):
            self._scan(node, node.device, at)
        elif isinstance(node.device, Motor) and getattr(node.device.memory, level.pin) != level.level:
            node.device.pin(level.pin, level.level, at)
            self._settle(level.number, at)

    def _next_below(self, moment: int) -> int | None:
        times = [due for due in self._due.values() if due is not None]
        if (due := self._computer_due()) is not None:
            times.append(due)
        due = min(times, default=None)
        return due if due is not None and due <= moment * PS else None

    def _due_of(self, number: int, at: int) -> int | None:
        """Return the time of a microcomputer's next action after the time `at`, or None if no action follows."""
        node = self._nodes[number]
        times = [
            time for time in (node.due, self._pin_due(node), self._scan_due(node, at)) if time is not None
        ]
        return min(times) if times else None

    def _pin_due(self, node: Microcomputer) -> int | None:
        if node.dead or not isinstance(node.device, Motor):
            return None
        change = self.plant.next_pin(node.place.number, node.device)
        return change[0] if change else None

    def _scan_due(self, node: Microcomputer, at: int) -> int | None:
        """Return the time of a force microcomputer's next scan, or None if this scan will not change a reading."""
        if node.dead or not self.plant.predicts or not isinstance(node.device, Force):
            return None
        number, device = node.place.number, node.device
        forces = self.plant.forces(number)
        read = all(abs(f - r) <= _HALF_STEP for f, r in zip(forces, device.memory.readings, strict=True))
        if read and all(self.motor(motor).memory.force == level for motor, level in self._reflexes(number)):
            return None
        return device.crystal.after(0, self.timing.scan, at + 1)

    def _reflexes(self, number: int) -> list[tuple[int, bool]]:
        """Return pairs: a motor that a force microcomputer can interrupt, and True if this motor is interrupted now."""
        device = self._nodes[number].device
        assert isinstance(device, Force)
        pairs = ((self._wired.get((number, c)), level) for c, level in enumerate(device.pins))
        return [(motor, level) for motor, level in pairs if motor is not None]

    def _serve(self, number: int, at: int) -> None:
        """Let a microcomputer perform all actions that are due."""
        node, memory = self._nodes[number], self._memory
        if isinstance(node.device, Motor) and self._pin_due(node) == at:
            change = self.plant.next_pin(number, node.device)
            assert change is not None
            node.device.pin(change[1], change[2], at)
        if isinstance(node.device, Force) and self._scan_due(node, at - 1) == at:
            self._scan(node, node.device, at)
        node.elapse(at)
        taken = node.receive(at, memory.sent, self._speeches(), self.wires)
        if taken is not None:
            own = taken.frame[0] == node.answers_to
            if isinstance(node.device, Hand):
                node.device.memory.cut = self.plant.beam(number)
            if isinstance(node.device, Force) and not self.plant.predicts:
                node.device.scan(self.plant.forces(number), self.plant.peaks(number))
            if own:
                node.act(Command.of(taken.frame), at)
            self._say_taken(number, taken, own=own)
            if own:
                self._acted(node)
        self._settle(number, at)

    def _scan(self, node: Microcomputer, device: Force, at: int) -> None:
        number = node.place.number
        device.scan(self.plant.forces(number), self.plant.peaks(number))
        for motor, level in self._reflexes(number):
            if self.motor(motor).memory.force != level:
                self.motor(motor).pin("force", level, at)
                self._settle(motor, at)

    def _acted(self, node: Microcomputer) -> None:
        if isinstance(node.device, Hand):
            self.plant.actuate(node.place.number, node.device.memory.devices)
        speech = node.memory.speech
        if speech is not None:
            turned = self.wires.turned(speech)
            for byte, (start, end) in zip(speech.frame, speech.lows(self.timing), strict=True):
                self._say(ByteSpoken(at=start, number=speech.number, byte=byte, until=end, turned=turned))

    def _settle(self, number: int, at: int) -> None:
        """Update the outputs and the next action of a microcomputer after it has acted."""
        node = self._nodes[number]
        self._listen(node, at)
        self._show(number, node)
        self._due[number] = self._due_of(number, at)
        status = self._status(number)
        if status != self._shown[number]:
            self._shown[number], self._changed = status, True
            self._say(StatusLines(at=at, number=number, status=int(status)))
            level = self._tied()
            if level != self._level:
                self._level = level
                self._say(InterruptLine(at=at, level=level))

    def _show(self, number: int, node: Microcomputer) -> None:
        """Pass the pulses of a motor, or the force thresholds of a wrist, to the machine."""
        if isinstance(node.device, Motor):
            self.plant.driven(number, node.device)
        elif isinstance(node.device, Force):
            self.plant.limited(number, node.device.memory.thresholds)

    def _listen(self, node: Microcomputer, at: int) -> None:
        """Let a microcomputer look for a strobe, which it does only if it is free."""
        for taken in node.listen(at, self._memory.sent, self.wires, quiet=not self._speeches()):
            self._say_taken(node.place.number, taken, own=False)

    def _status(self, number: int) -> Status:
        """Return the status lines of a microcomputer as the central computer receives them."""
        status = int(self._nodes[number].status)
        for defect in self._defects:
            if defect.where == number and defect.kind in ("status-a", "status-b"):
                bit = 0b10 if defect.kind == "status-a" else 0b01
                status = status | bit if defect.value else status & ~bit
        return Status(status)

    def _tied(self) -> bool:
        tied = (self._shown[number] for number, node in self._nodes.items() if node.device.tied)
        return self._joined and any(status.aborted for status in tied)

    def _say_taken(self, number: int, taken: Taken, *, own: bool) -> None:
        if self.tell:
            self._say(
                FrameTaken(
                    at=taken.checked,
                    number=number,
                    frame=taken.frame,
                    sampled=taken.sampled,
                    noticed=taken.noticed,
                    own=own,
                )
            )

    def _say(self, event: AnyBusEvent) -> None:
        for tell in self.tell:
            tell(event)

    # -- the central computer waits for an answer -----------------------------------------------------------

    def _speeches(self) -> list[Any]:
        return [node.memory.speech for node in self._nodes.values() if node.memory.speech is not None]

    def _computer_due(self) -> int | None:
        question, timing = self._memory.question, self.timing
        if question is None:
            return None
        poll = timing.poll
        match question.phase:
            case "low":
                return min(self._low(question) or self._limit(question), self._limit(question))
            case "sample":
                return question.since + _COMPUTER.micros(timing.sample)
            case "high":
                end = next(
                    (end for start, end in self._answers() if start <= question.since < end), question.since
                )
                return _COMPUTER.after(question.since, poll, end)
            case "guard":
                end = question.since + _COMPUTER.micros(timing.answer - timing.answer_low + timing.guard)
                return min(self._low(question) or end, end)
            case "over":
                return None

    def _limit(self, question: Question) -> int:
        return question.since + _COMPUTER.micros(self.timing.time_limit)

    def _answers(self) -> list[tuple[int, int]]:
        return self.wires.answers(self._speeches())

    def _low(self, question: Question) -> int | None:
        """Return the time at which the central computer next sees /ANSWER READY low (ps), or None if it never sees
        this line low.
        """
        for start, end in self._answers():
            seen = _COMPUTER.after(question.since, self.timing.poll, max(start, question.since))
            if seen < end:
                return seen
        return None

    def _compute(self, at: int) -> None:
        question = self._memory.question
        assert question is not None
        match question.phase:
            case "low" if at == self._low(question):
                question.phase = "sample"
            case "low":
                self._over(question, at, "no answer")
            case "sample":
                byte = self.wires.heard(at, self._speeches())
                question.got += bytes((byte,))
                self._say(ByteHeard(at=at, number=question.number, byte=byte))
                question.phase = "high"
            case "high":
                question.phase = "low" if len(question.got) < question.wanted else "guard"
            case "guard":
                self._over(question, at, "stray byte" if at == self._low(question) else "")
        question.since = at

    def _over(self, question: Question, at: int, failed: Literal["", "no answer", "stray byte"]) -> None:
        question.phase, question.failed = "over", failed
        self._say(AnswerEnded(at=at, number=question.number, answer=question.got, failed=failed))
