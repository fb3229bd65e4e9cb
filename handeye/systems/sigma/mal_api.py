"""Executes MAL programs from Python, on perfect motors or on the two gantries with physics."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Final, Literal, get_args

import numpy as np

from handeye.core.diagnostics import quoted
from handeye.core.errors import BadArgument, NoSuchName, Refused
from handeye.core.pose import Array
from handeye.core.variation import WorldSpec
from handeye.program.events import SystemEvent
from handeye.systems.sigma.bus.faults import defect
from handeye.systems.sigma.bus.wired import WiredBus
from handeye.systems.sigma.machine.perfect import PerfectMotors
from handeye.systems.sigma.mal.compiler import program_of
from handeye.systems.sigma.mal.happenings import Printed
from handeye.systems.sigma.mal.interleavings import interleavings, told_orders
from handeye.systems.sigma.mal.virtual_machine import VirtualMachine
from handeye.systems.sigma.protocol import AXES, NUMBERS, STEP_MM

if TYPE_CHECKING:  # programs run on perfect motors without a simulator
    from handeye.cell.photograph import Photograph
    from handeye.systems.sigma.gantries.machine import Gantries

Arm = Literal["none", "gantries"]
_NAME: Final = "program.mal"
_LONGEST: Final = 3_600.0  # s


class Mal:
    """A program in MAL, and the machine on which it runs.

    >>> program = handeye.Mal('10 ORIGIN X1\\n20 MOVE X1 TO 50\\n30 PRINT "AT", POS(X1)')
    >>> program.run()
    ['AT            49.9875']
    >>> program.tasks, program.stopped
    ({}, '')
    """

    def __init__(
        self, text: str, *, arm: Arm = "none", seed: int | None = None, faults: Sequence[str] = ()
    ) -> None:
        """Compile a program and begin it, without executing any statement yet.

        Args:
            text: the numbered lines of the program.
            arm: `none`, with perfect motors, or `gantries`, the two arms with physics over an empty board.
            seed: seed of the errors of the gantries; None: no errors.
            faults: faults of the gantries and their bus, such as `no-reflex` or `phase.X1`.

        Raises:
            InvalidInput: the program has mistakes, or `arm` or `faults` has an unknown name.
        """
        if arm not in get_args(Arm):
            raise NoSuchName(f"there is no arm {quoted(str(arm))}; choose `none` or `gantries`")
        if arm == "none" and (faults or seed is not None):
            raise BadArgument('seed and faults apply only to arm="gantries": perfect motors have no errors')
        self.text = text
        self._program = program_of(_NAME, text)
        self._events: list[SystemEvent] = []
        self._machine: PerfectMotors | WiredBus = PerfectMotors()
        self._gantries: Gantries | None = None
        self._rows: list[tuple[float, Array, Array]] = []
        if arm == "gantries":
            self._machine, self._gantries = _gantries(seed, faults)
            self._gantries.bench.after_step.append(self._look)
        self._vm = VirtualMachine(self._program, self._machine, self._events.append)
        self._vm.begin()

    def _look(self) -> None:
        assert self._gantries is not None
        self._rows.append((self._gantries.bench.now, self._gantries.places * STEP_MM, self._gantries.felt))

    def run(self, until: int | None = None) -> list[str]:
        """Execute statements until the program ends or stops, or until the line with the number `until` is the next to
        be executed.

        Returns:
            the lines that were printed.

        Raises:
            NoSuchName: the program has no line of that number.
        """
        if until is not None and until not in (numbers := [line.number for line in self._program.lines]):
            near = ", ".join(
                str(number) for number in sorted(numbers, key=lambda each: abs(each - until))[:3]
            )
            raise NoSuchName(f"the program has no line {until}; the nearest are {near}")
        first, begun = len(self._events), self.time
        while self._vm.turn and (self.line != until or len(self._events) == first):
            if self.time - begun > _LONGEST:
                raise Refused(f"the program is still running after {_LONGEST:g} s of simulated time")
            self._vm.statement()
            self._vm.settle()
        return [event.text for event in self._events[first:] if isinstance(event, Printed)]

    @property
    def line(self) -> int | None:
        """Number of the line that is executed next; None if no line can be executed."""
        turn = self._vm.turn
        return self._program.line_of(self._vm.memory.tasks[turn].pc).number if turn else None

    @property
    def time(self) -> float:
        """Seconds since the program began."""
        return self._vm.time

    @property
    def stopped(self) -> str:
        """The reason why the program has stopped; empty if it runs or has ended."""
        fault = self._vm.memory.fault
        return "" if fault is None else fault.told

    @property
    def tasks(self) -> dict[str, str]:
        """For each unfinished task, the line that the task has reached, and what the task waits for."""
        found = {}
        for name, task in self._vm.memory.tasks.items():
            waits = self._vm.waits_for(name)
            line = self._program.line_of(task.pc)
            found[name] = f"{line.number} {line.text}" + (f", waiting for {waits}" if waits else "")
        return found

    @property
    def flags(self) -> tuple[str, ...]:
        """The flags that are set."""
        return self._vm.memory.flags

    @property
    def doubtful(self) -> tuple[str, ...]:
        """Axes whose counts may be wrong."""
        return self._vm.memory.doubtful

    @property
    def believed(self) -> dict[str, float]:
        """The position (mm) at which the program believes each axis to be. The belief can be wrong."""
        return {axis: round(count * STEP_MM, 4) for axis, count in self._vm.memory.counts.items()}

    @property
    def account(self) -> list[str]:
        """What has happened so far, with one sentence for each event."""
        from handeye.core.units import MILLIMETRES

        return [f"{event.time:6.2f} s  {event.sentence(MILLIMETRES)}" for event in self._events]

    def status(self, axis: str) -> str:
        """Return the state of a motor: `free` or `busy`. After an abort, return the reason for the abort (`rail` or
        `force`).
        """
        if axis not in AXES:
            raise NoSuchName(f"there is no axis {quoted(axis)}; the axes are {', '.join(AXES)}")
        return self._machine.status(NUMBERS[axis]).name.lower()

    def interleavings(self, most: int = 50_000) -> list[str]:
        """Try every order in which the tasks may run, however long each task takes. Returns the lines of the report
        that `handeye sigma check --interleavings` prints.

        Args:
            most: number of states after which the search ends.

        Raises:
            BadArgument: `most` is less than 1.
        """
        if most < 1:
            raise BadArgument(f"the number of states must be at least 1, not {most}")
        return [*told_orders("the program", self._program, interleavings(self._program, most))]

    @property
    def history(self) -> Mapping[str, Array]:
        """The true motion of the gantries, one row for each millisecond: `time` (s), `place` (mm) and `force` on the
        wrists (N). `place` and `force` have the columns X1, Y1, Z1, X2, Y2, Z2.
        """
        self._physics()
        times, places, forces = zip(*self._rows, strict=True) if self._rows else ((), (), ())
        shape = (len(times), len(AXES))
        return {
            "time": np.array(times),
            "place": np.array(places).reshape(shape),
            "force": np.array(forces).reshape(shape),
        }

    def photograph(self, *, width: int = 640, height: int = 480) -> "Photograph":
        """Return a photograph of the gantries, as red, green and blue values of shape (height, width, 3).

        Raises InvalidInput if the motors are perfect, OpenGL is missing, or the size is impossible.
        """
        from handeye.cell.photograph import check_size, photograph
        from handeye.systems.sigma.gantries.machine import CAMERA

        bench = self._physics().bench
        check_size(width, height)
        return photograph(bench.model, bench.data, camera=CAMERA, width=width, height=height)

    def _physics(self) -> "Gantries":
        if self._gantries is None:
            raise Refused('with perfect motors there are no pictures and no forces; use arm="gantries"')
        return self._gantries

    def __repr__(self) -> str:
        state = self.stopped or (f"at line {self.line}" if self._vm.turn else "ended")
        return f"<Mal program, {self.time:.2f} s, {state}>"


def _gantries(seed: int | None, faults: Sequence[str]) -> "tuple[WiredBus, Gantries]":
    from handeye.systems.sigma.gantries.faults import every_fault, gantries_of
    from handeye.systems.sigma.gantries.machine import scene
    from handeye.systems.sigma.gantries.world import GantryWorld

    world = GantryWorld(None if seed is None else WorldSpec(seed=seed))
    planted = [every_fault()[name] for name in faults if name in every_fault()]
    defects = [each for fault in planted for each in fault.bus]
    defects += [defect(name) for name in faults if name not in every_fault()]
    gantries = gantries_of(scene(world), world, planted)
    spread = 0.0 if seed is None else world.clock_spread
    return WiredBus(plant=gantries, defects=defects, seed=seed or 0, clock_spread=spread), gantries
