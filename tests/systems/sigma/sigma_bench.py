"""A bus with its log, as tests of SUPERSIGMA have it."""

from collections.abc import Sequence
from typing import Any

from handeye.systems.sigma.bus.events import AnyBusEvent, CommandSent, FrameTaken, StatusLines
from handeye.systems.sigma.bus.faults import defect
from handeye.systems.sigma.bus.layout import SUPERSIGMA, Layout
from handeye.systems.sigma.bus.plant import IdealMachine
from handeye.systems.sigma.bus.wired import WiredBus
from handeye.systems.sigma.protocol import number_of

LONG = 60_000_000  # microseconds


class LoggedBus(WiredBus):
    """A wired bus over an ideal machine, that keeps what happens on it."""

    def __init__(self, *faults: str, layout: Layout = SUPERSIGMA, **options: Any) -> None:
        self.machine = IdealMachine()
        super().__init__(layout, plant=self.machine, defects=[defect(f) for f in faults], **options)
        self.log: list[AnyBusEvent] = []
        self.tell.append(self.log.append)

    def sent(self) -> list[CommandSent]:
        return [event for event in self.log if isinstance(event, CommandSent)]

    def taken(self, *names: str) -> list[FrameTaken]:
        """Frames that were taken, by all or by some."""
        numbers = {number_of(name) for name in names}
        return [e for e in self.log if isinstance(e, FrameTaken) and (not names or e.number in numbers)]

    def statuses(self, name: str) -> list[str]:
        """Levels of lines A and B of a microcomputer, as they changed."""
        number = number_of(name)
        changes = [e for e in self.log if isinstance(e, StatusLines) and e.number == number]
        return [f"{e.status >> 1}-{e.status & 1}" for e in changes]

    def pass_to(self, microseconds: int) -> None:
        """Let time pass until then, whatever changes."""
        while self.now < microseconds:
            self.wait(microseconds)

    def settled(self, *names: str | int) -> None:
        """Wait until bus and microcomputers are free."""
        while not self.free:
            self.wait(self.now + LONG)
        for name in names:
            self.wait_free(number_of(name), LONG)

    def true_place(self, name: str) -> int:
        """Steps of a motor past its low switch."""
        number = number_of(name)
        return self.machine.place(number, self.motor(number), self.now * 1_000_000)


def frames(bus: LoggedBus) -> Sequence[str]:
    """Bytes of each command, in hexadecimal."""
    return [event.frame.hex(" ") for event in bus.sent()]
