"""The machine on the test bench, and what a technician can do to it by hand. The machine is ideal except for a planted
fault.

Rotors follow each pulse, unless the fault weakens their motors. For weakened motors, a balance of forces decides
whether the rotors follow. A wrist senses loads, the swing of its hand when a motor starts, and the push of the fingers
when they close on a block.
"""

import math
from collections.abc import Sequence
from typing import Any, Final

from handeye.systems.sigma.bus.faults import BusDefect
from handeye.systems.sigma.bus.plant import IdealMachine, Level
from handeye.systems.sigma.bus.wired import WiredBus
from handeye.systems.sigma.diagnosis.faults import BENCH, OFFSET_N, MachineFault, MachineKind, Planted
from handeye.systems.sigma.firmware.device import PS
from handeye.systems.sigma.firmware.force import CONVERTER_N
from handeye.systems.sigma.firmware.motor import Motor, Pin
from handeye.systems.sigma.motors.rotor import MASSES, POLE, STEP, Drive, by_balance
from handeye.systems.sigma.protocol import AXES, COMPONENTS, DEVICES, NUMBERS

BLOCK_N: Final = 6.0  # N: sideways push on the wrist when the fingers close on a block off the middle
HARD_STOP: Final = 853  # steps from a switch to the end stop
_HAND_KG: Final = 1.2
_WRIST: Final = 20_000.0  # N/m
_LEFT: Final = 0.05  # fraction of the inertial force that a sound accelerometer does not correct
SWAPPED: Final[tuple[MachineKind, ...]] = (
    "pulses",
    "multiplexer",
    "converter",
)  # these faults are on the card of a microcomputer
_SCAN: Final = 1000 * PS
_CLOSES: Final = 100_000 * PS  # ps after which fingers touch a block; a sound hand is done after 150 ms
_SLOW: Final = 4  # factor by which slow fingers take longer
DIM: Final = 0.6  # light of a dim lamp, as a fraction of that of a sound lamp
CUT: Final = 0.5  # fraction of the light below which the photodiode sees none
_SPRING: Final = 1000.0  # N/m of the spring balance
HALF: Final = 0.5  # fraction of the pull-out force that is left with one phase
SAG: Final = 0.4  # fraction of the pull-out force that a sagging supply leaves
MANY: Final = 3  # number of moving motors at which the supply sags
_START_N: Final = Drive(mass=1.0).start_force
_TOP_N: Final = Drive(mass=1.0).top_force
_CLOCKS: Final = 0.005  # greatest clock error, as a fraction
_AXIS: Final = {NUMBERS[axis]: axis for axis in AXES}
_SIDEWAYS: Final = COMPONENTS.index("Y")


class Machine(IdealMachine):
    """The machine that is connected to the pins of the microcomputers."""

    predicts = False

    def __init__(self, faults: Sequence[MachineFault] = ()) -> None:
        super().__init__()
        self.faults = {(fault.kind, fault.number): fault for fault in faults}
        self.loads: dict[tuple[int, int], float] = {}  # N: loads on the components of the wrists
        self.pulls: dict[int, float] = {}  # N against the motion of an axis, from a spring balance
        self.light: dict[int, float] = {}  # fraction of the light that passes the object in a beam
        self.blocks: set[int] = set()  # hands that have a block between the fingers
        self._swings: dict[int, float] = {}  # N: force of the swinging hand on its wrist, by motor
        self._pushed: set[int] = set()  # hands whose fingers press on a block
        self._trains: dict[
            int, tuple[Any, int, int, int]
        ] = {}  # for each moving motor: train, began, pulses, sense
        self._most: dict[
            int, int
        ] = {}  # greatest number of motors that moved at the same time during each train
        self._due: list[tuple[int, int, bool | None]] = []  # ps, number, whether fingers press from then on
        self.now = 0  # ps

    def switch_off(self) -> None:
        """Reset everything that is lost when the power is switched off. The slides stay where they are."""
        for kept in (self._swings, self._pushed, self._trains, self._most, self._due, self.memory.devices):
            kept.clear()
        self.now = 0

    def fault(self, kind: MachineKind, number: int = 0) -> MachineFault | None:
        """Return the planted fault if it is of this kind and at this microcomputer, or else None."""
        return self.faults.get((kind, number))

    # -- rotors --------------------------------------------------------------------------------------------

    def _every(self, number: int) -> int:
        """Return the interval at which pulses are lost: if it is n, every n-th pulse is lost. If no pulses are lost,
        return 0.
        """
        fault = self.fault("pulses", number)
        return 0 if fault is None else fault.which

    def place(self, number: int, motor: Motor, at: int) -> int:
        made = motor.sent(at) - motor.memory.pulses
        every = self._every(number)
        lost = (abs(made) // every if every else 0) * motor.memory.sense
        return super().place(number, motor, at) - lost

    def next_pin(self, number: int, motor: Motor) -> tuple[int, Pin, bool] | None:
        known = motor.memory
        if number not in self.memory.starts or known.train is None:
            return None
        here, length = self.memory.starts[number] + known.pulses, self.memory.lengths[number]
        if known.sense < 0:
            crossings: list[tuple[int, Pin, bool]] = [(here, "low", True), (here - length + 1, "high", False)]
        else:
            crossings = [(1 - here, "low", False), (length - here, "high", True)]
        stuck, every = self.fault("switch", number), self._every(number)
        found = []
        for steps, pin, level in crossings:
            if getattr(known, pin) == level or (stuck is not None and pin == ("low", "high")[stuck.which]):
                continue
            pulse = steps + (steps - 1) // (every - 1) if every and steps > 0 else steps
            if (when := motor.when(pulse)) is not None:
                found.append((when, pin, level))
        return min(found) if found else None

    def driven(self, number: int, motor: Motor) -> None:
        if number not in _AXIS:
            return
        memory, known = motor.memory, self._trains.get(number)
        if known is not None and (memory.train, memory.began) != known[:2]:
            self._ended(number, motor, *known)
            known = None
        if known is None and memory.train is not None:
            self._trains[number] = memory.train, memory.began, memory.pulses, memory.sense
            moving = len(self._trains)
            for each in self._trains:
                self._most[each] = max(self._most.get(each, 0), moving)
            jump = memory.train.start * STEP  # m/s
            self._swing(number, jump * math.sqrt(_WRIST * _HAND_KG) * memory.sense)

    def _ended(self, number: int, motor: Motor, train: Any, began: int, pulses: int, sense: int) -> None:
        """Handle the end of a pulse train: subtract the lost steps from the position of the motor."""
        del self._trains[number]
        made, most, every = abs(motor.memory.pulses - pulses), self._most.pop(number), self._every(number)
        lost = made // every if every else 0
        lost += self._slipped(number, train, most, complete=made == len(train.pulses))
        start = self.memory.starts[number] - sense * lost
        there, length = start + motor.memory.pulses, self.memory.lengths[number]
        self.memory.starts[number] = start + min(max(there, -HARD_STOP), length + HARD_STOP) - there
        self._swing(number, 0.0)

    def _slipped(self, number: int, train: Any, most: int, *, complete: bool) -> int:
        """Return the number of steps by which a rotor lags behind after a pulse train."""
        share = HALF if self.fault("phase", number) else 1.0
        share *= SAG if self.fault("supply") and most >= MANY else 1.0
        load, least = self.pulls.get(number, 0.0), _START_N * share
        if load > least:  # the rotor falls back until the balance pulls no more than the motor holds
            return math.ceil((load - least) / _SPRING / STEP / POLE) * POLE
        if share == 1.0 or not complete:
            return 0
        drive = Drive(mass=MASSES[_AXIS[number][0]], start_force=least, top_force=_TOP_N * share)
        return by_balance(train.pulses, drive).lost * POLE

    # -- wrists, beams and hands -----------------------------------------------------------------------------

    def _swing(self, number: int, force: float) -> None:
        self._swings[number] = force
        wrist = NUMBERS[f"FORCE{_AXIS[number][1]}"]
        self._due.append((-(-(self.now + 1) // _SCAN) * _SCAN, wrist, None))

    def forces(self, number: int) -> Sequence[float]:
        felt = [self._felt(number, component) for component in range(len(COMPONENTS))]
        if (stuck := self.fault("multiplexer", number)) is not None:
            felt = [felt[stuck.which]] * len(felt)
        if (bit := self.fault("converter", number)) is not None:
            raw = [round(force / CONVERTER_N) for force in felt]
            raw = [each | 1 << bit.which if bit.level else each & ~(1 << bit.which) for each in raw]
            felt = [each * CONVERTER_N for each in raw]
        return felt

    def _felt(self, number: int, component: int) -> float:
        arm = 1 if number == NUMBERS["FORCE1"] else 2
        axis = NUMBERS[f"{COMPONENTS[component]}{arm}"]
        gauge = self.fault("gauge", number)
        dead = gauge is not None and gauge.which == component and not gauge.level
        force = 0.0 if dead else self.loads.get((number, component), 0.0)
        pressed = NUMBERS[f"HAND{arm}"] in self._pushed and component == _SIDEWAYS
        force += BLOCK_N if pressed and not dead else 0.0
        force += OFFSET_N if gauge is not None and gauge.which == component and gauge.level else 0.0
        alone = self.fault("accelerometer", number)
        left = 1.0 if alone is not None and alone.which == component else _LEFT
        return force + (0.0 if dead else self._swings.get(axis, 0.0) * left)

    def beam(self, number: int) -> bool:
        if (stuck := self.fault("beam", number)) is not None:
            return bool(stuck.level)
        lamp = DIM if self.fault("lamp", number) else 1.0
        return lamp * self.light.get(number, 1.0) < CUT

    def actuate(self, number: int, devices: Sequence[int]) -> None:
        before = self.memory.devices.get(number, (0,))[DEVICES["HAND"]]
        super().actuate(number, devices)
        if devices[DEVICES["HAND"]] != before and number in self.blocks:
            takes = _CLOSES * (_SLOW if self.fault("fingers", number) else 1)
            wrist = number - 1  # the force microcomputer of the same arm
            self._due.append((self.now + takes, wrist, bool(devices[DEVICES["HAND"]])))

    def advance(self, at: int) -> tuple[int, list[Level]] | None:
        self.now = max(self.now, at)
        if not self._due or min(self._due)[0] > at:
            return None
        first = min(self._due, key=lambda each: each[0])
        self._due.remove(first)
        when, wrist, pressed = first
        if pressed is not None:
            (self._pushed.add if pressed else self._pushed.discard)(wrist + 1)
        return when, [Level(wrist)]


class Bench:
    """A machine with a planted fault, and the means of a technician: the bus, the technician's own hands, weights, and
    spare microcomputers.
    """

    layout = BENCH

    def __init__(self, planted: Planted | None = None, seed: int = 0) -> None:
        self._seed = seed
        self._defects: list[BusDefect] = [] if planted is None else [*planted.bus]
        self.machine = Machine(() if planted is None else planted.machine)
        self._switch_on()

    bus: WiredBus

    def _switch_on(self) -> None:
        self.bus = WiredBus(
            BENCH, plant=self.machine, defects=self._defects, seed=self._seed, clock_spread=_CLOCKS
        )
        for number in _AXIS:
            here, length = self.machine.memory.starts[number], self.machine.memory.lengths[number]
            levels: dict[Pin, bool] = {"low": here <= 0, "high": here >= length}
            if (stuck := self.machine.fault("switch", number)) is not None:
                levels["high" if stuck.which else "low"] = bool(stuck.level)
            for pin, level in levels.items():
                self.bus.pin(number, pin, level)

    def swap(self, number: int) -> None:
        """Replace a microcomputer by a sound one, and switch the machine off and on."""
        at = self.bus.now * PS
        for axis in _AXIS:
            self.machine.memory.starts[axis] = self.machine.place(axis, self.bus.motor(axis), at)
        kinds = ("dead", "clock", "address")
        self._defects = [d for d in self._defects if not (d.where == number and d.kind in kinds)]
        for kind in SWAPPED:
            self.machine.faults.pop((kind, number), None)
        self.machine.switch_off()
        self._switch_on()

    def press(self, arm: int, component: str, newtons: float) -> None:
        """Press on a hand with a known force (N). `component` is the force component of the wrist in whose direction
        the force acts. A force of 0 releases the hand.
        """
        self.machine.loads[NUMBERS[f"FORCE{arm}"], COMPONENTS.index(component)] = newtons

    def pull(self, axis: str, newtons: float) -> None:
        """Let a spring balance pull back the slide of an axis with a force (N). A force
        of 0 removes the balance."""
        self.machine.pulls[NUMBERS[axis]] = newtons

    def shade(self, arm: int, passes: float) -> None:
        """Hold an object in the light beam of a hand. `passes` is the fraction of light that passes: 0 for a
        rod, .7 for a grey filter, 1 for no object."""
        self.machine.light[NUMBERS[f"HAND{arm}"]] = passes

    def block(self, arm: int, *, there: bool) -> None:
        """If `there` is True, fix a block between the fingers of a hand, but not midway between them. If `there` is
        False, take the block away.
        """
        (self.machine.blocks.add if there else self.machine.blocks.discard)(NUMBERS[f"HAND{arm}"])
