"""Arm 1 of the two gantries in an episode. Like the program of the job, an action sends commands over the bus.

Commands and questions take time on the bus. A period begins with the commands and ends with the questions, so that all
answers have arrived at the end of the period.
"""

from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from typing import Final

import numpy as np

from handeye.env.controls import ControlledMachine, Controls, MachineStopped, Values
from handeye.env.spaces import (
    SWITCHED,
    ActionKind,
    Component,
    Observation,
    ObservationSpace,
    clock,
    codes,
    numbers,
    switches,
    together,
)
from handeye.ports.microbus import BusFault, Command, MicrobusPort, Status
from handeye.runs.runner import Runner
from handeye.systems.sigma import protocol
from handeye.systems.sigma.bus.plant import TRAVEL
from handeye.systems.sigma.chess.heights import ToldHeight
from handeye.systems.sigma.protocol import ANSWERS, NUMBERS, STEP_MM, Op
from handeye.systems.sigma.run.running import RunningMal

ARM: Final = 1
AXES: Final = ("X1", "Y1", "Z1")
WAYS: Final = ("x", "y", "z")  # the axes, in the names of components
HAND: Final = "HAND1"
RAILS: Final = tuple(TRAVEL[axis[0]] * STEP_MM for axis in AXES)  # mm: from end to end
PERIOD_US: Final = 20_000  # microseconds: length of a step. The program of the job sends 19 commands a second
HEIGHT: Final = 100.0  # mm: greatest height that can be reported; no piece is higher than 93.5 mm
LINES: Final = 3  # on which pieces stand at first
_ASKING: Final = 4_000  # microseconds at the end of a period: the seven questions together take 1.9 ms
_LONGEST: Final = 20_000_000  # microseconds: longer than any motion of an axis
_FARTHEST: Final = (protocol.LONGEST_MOVE // 2 + 1) * STEP_MM  # mm: the greatest count; it has 16 bits


class ControlledGantry(ControlledMachine):
    """Arm 1. Arm 2 stands still, as in the program of the job."""

    period = PERIOD_US / 1e6

    def components(self, action: ActionKind, *, pictures: bool) -> tuple[Component, ...]:
        def switch(name: str) -> Component:
            return Component(name=name, scale=1.0, unit="")

        return (
            *(switch(f"origin.{way}") for way in WAYS),
            *(switch(f"set.{way}") for way in WAYS),
            *(
                Component(name=f"goal.{way}", scale=rail, unit="mm")
                for way, rail in zip(WAYS, RAILS, strict=True)
            ),
            switch("close"),
            switch("report"),
            Component(name="report.height", scale=HEIGHT, unit="mm"),
            Component(name="report.at", scale=RAILS[0], unit="mm"),
            Component(name="report.line", scale=float(LINES), unit=""),
            switch("done"),
        )

    def observations(self, *, pictures: bool) -> ObservationSpace:
        return together(
            {
                "status": codes(len(AXES) + 1, max(Status)),
                "count": numbers(len(AXES), _FARTHEST),
                "stopped": numbers(len(AXES), _FARTHEST),
                "beam": switches(1),
                "clock": clock(),
            }
        )

    def begin(self, runner: Runner, action: ActionKind, *, pictures: bool) -> Controls:
        assert isinstance(runner.system, RunningMal)
        return GantryControls(runner.system.machine, runner.system.type_out, lambda: runner.time)


class GantryControls(Controls):
    """Arm 1 in an episode."""

    def __init__(self, bus: MicrobusPort, type_out: Callable[[str], None], time: Callable[[], float]) -> None:
        """Ask for the first readings.

        Args:
            type_out: prints a line on the console.
            time: returns the time since the program began, s.
        """
        self._bus, self._type_out, self._time = bus, type_out, time
        self._closed = self._beam = False
        self._counts, self._stopped = [0] * len(AXES), [0] * len(AXES)  # steps
        self._statuses = self._shown()
        self._unasked = {*AXES}  # axes that have moved since they were asked for their counts
        with suppress(MachineStopped):  # the first action raises it again
            self._pass(())

    def act(self, values: Values) -> None:
        if values["report"] > SWITCHED:
            line = min(max(round(values["report.line"]), 1), LINES)
            told = ToldHeight(height=values["report.height"], x=values["report.at"], line=line)
            self._type_out(told.text)
        self._pass([*self._moves(values), *self._fingers(values)])

    def stop(self) -> None:
        """Give no more commands, and wait until the axes stand still."""
        last = self._bus.now + _LONGEST
        while Status.BUSY in self._shown() and self._bus.now < last:
            self._pass(())
        self._pass(())

    def seen(self) -> Observation:
        return {
            "status": np.array(self._statuses, dtype=np.int8),
            "count": np.array(self._counts) * STEP_MM,
            "stopped": np.array(self._stopped) * STEP_MM,
            "beam": np.array([self._beam], dtype=np.int8),
            "clock": np.array([self._time()]),
        }

    def _moves(self, values: Values) -> Iterator[Command]:
        """Yield the commands to the axes. An axis that is busy gets none."""
        for index, (axis, way) in enumerate(zip(AXES, WAYS, strict=True)):
            if self._busy(axis) or axis in self._unasked:
                continue
            steps = round(values[f"goal.{way}"] / STEP_MM) - self._counts[index]
            if values[f"origin.{way}"] > SWITCHED:
                yield protocol.origin(axis)
            elif values[f"set.{way}"] > SWITCHED and steps:
                yield protocol.move(axis, steps)

    def _fingers(self, values: Values) -> Iterator[Command]:
        """Yield the command to the hand if the action changes the hand."""
        closed = values["close"] > SWITCHED
        if closed != self._closed and not self._busy(HAND):
            self._closed = closed
            yield protocol.actuate(ARM, "HAND", int(closed))

    def _pass(self, commands: Sequence[Command]) -> None:
        """Let a period pass, which begins with commands and ends with questions."""
        end = self._bus.now + PERIOD_US
        try:
            for command in commands:
                self._bus.send(command)
                self._unasked |= {name for name in AXES if NUMBERS[name] == command.number}
            self._wait(end - _ASKING)
            self._ask()
        except BusFault as fault:
            raise MachineStopped(str(fault)) from None
        self._wait(end)

    def _ask(self) -> None:
        """Read the status lines, and ask every microcomputer that can answer. If an axis was stopped, the question for
        the axis's count clears the status of the axis.
        """
        self._statuses = self._shown()
        for index, axis in enumerate(AXES):
            if axis in self._unasked and not self._busy(axis):
                self._counts[index] = protocol.signed(self._answer(protocol.position(axis)))
                self._stopped[index] = protocol.signed(self._answer(protocol.position(axis, at_abort=True)))
                self._unasked.remove(axis)
        if not self._busy(HAND):
            self._beam = bool(self._answer(protocol.beam(ARM))[0])

    def _answer(self, question: Command) -> bytes:
        return self._bus.ask(question, ANSWERS[Op(question.op)])

    def _shown(self) -> list[Status]:
        """Return the status of each axis and of the hand."""
        return [self._bus.status(NUMBERS[name]) for name in (*AXES, HAND)]

    def _busy(self, name: str) -> bool:
        return self._bus.status(NUMBERS[name]) is Status.BUSY

    def _wait(self, until: int) -> None:
        while self._bus.now < until:
            self._bus.wait(until)
