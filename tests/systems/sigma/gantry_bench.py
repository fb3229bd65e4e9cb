"""Programs and commands on the two gantries with physics, for tests."""

from mal_bench import Ran, go_on

from handeye.core.variation import WorldSpec
from handeye.program.events import SystemEvent
from handeye.systems.sigma.bus.wired import WiredBus
from handeye.systems.sigma.gantries.faults import every_fault, gantries_of
from handeye.systems.sigma.gantries.machine import Gantries, scene
from handeye.systems.sigma.gantries.world import GantryWorld
from handeye.systems.sigma.mal.compiler import program_of
from handeye.systems.sigma.mal.virtual_machine import VirtualMachine
from handeye.systems.sigma.protocol import AXES, NUMBERS

LONG = 20_000_000  # microseconds


class Machine:
    """The gantries in a world, without errors by default, and their bus."""

    def __init__(
        self, seed: int | None = None, *faults: str, compensated: bool = True, block: str = ""
    ) -> None:
        self.world = GantryWorld(None if seed is None else WorldSpec(seed=seed))
        spec = scene(self.world)
        if block:  # its x, y and height, mm
            x, y, high = (float(word) / 1000 for word in block.split())
            spec.worldbody.add_geom(type=6, size=[0.01, 0.01, high / 2], pos=[x, y, high / 2])
        planted = [every_fault()[name] for name in faults]
        defects = [each for fault in planted for each in fault.bus]
        self.gantries = (
            gantries_of(spec, self.world, planted)
            if planted
            else Gantries(spec, self.world, compensated=compensated)
        )
        self.bus = WiredBus(plant=self.gantries, defects=defects, seed=seed or 0)

    def run(self, text: str) -> Ran:
        """A program carried out, as far as it goes."""
        events: list[SystemEvent] = []
        vm = VirtualMachine(program_of("test.mal", text), self.bus, events.append)
        vm.begin()
        return go_on(Ran(vm, events))

    def rest(self, seconds: float = 0.1) -> None:
        """Let time pass."""
        end = self.bus.now + round(seconds * 1e6)
        while self.bus.now < end:
            self.bus.wait(end)

    def place(self, axis: str) -> float:
        """Where an axis truly is, steps from its low switch."""
        return float(self.gantries.places[AXES.index(axis)])

    def count(self, axis: str) -> int:
        """The count of its microcomputer."""
        return self.bus.motor(NUMBERS[axis]).count(self.bus.now * 1_000_000)
