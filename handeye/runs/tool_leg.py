"""The common part of all legs that command the arm by tool axes (`handeye/execution/tool_axes.py`)."""

from collections.abc import Sequence
from typing import Any, Final

import numpy as np
from msgspec import field

from handeye.arm.model import ArmModel
from handeye.cell.compiled_arm import CompiledArm
from handeye.cell.simulated import SimulatedCell
from handeye.core.errors import BadFile, Refused
from handeye.core.mutable_records import MutableRecord
from handeye.core.record import Record
from handeye.execution.drive import ArmDrive
from handeye.execution.hand_actions import SHUT
from handeye.execution.state import DriveState
from handeye.execution.tool_axes import ToolAxes
from handeye.ports.axes import Channel
from handeye.program.events import AnyEvent
from handeye.program.system_state import SystemState
from handeye.program.world_model import rounded_place
from handeye.runs.hand_over import HandOver, Kind, StationMemory, place_now
from handeye.runs.legs import Lack, LegSystem, RunningLeg
from handeye.runs.system import ExecutedStep, RunCallbacks
from handeye.touch.senses import EMPTY_GAP

_SIZE: Final = 7  # axes of the tool


class ToolMemory(MutableRecord, kw_only=True):
    """The state of the arm between two steps of a program that moves the arm by tool axes."""

    drive: DriveState
    goal: tuple[float, ...] = ()  # set-points x, y, z (m), O, A, T (rad); empty: the arm was not taken over
    station: StationMemory = field(default_factory=lambda: StationMemory(friction=np.zeros(0)))


class ToolArm:
    """The arm of a cell, for a program that moves the tool axes of this arm. Before and after each leg of this
    program, other programs of a relay may move the arm.
    """

    def __init__(self, cell: SimulatedCell, arm: ArmModel, around: RunCallbacks) -> None:
        self.cell, self.arm = cell, arm
        self.memory = ToolMemory(drive=DriveState.holding(cell.devices.sense(), arm))
        self.drive = ArmDrive(cell=cell.devices, arm=arm, state=self.memory.drive, arithmetic=CompiledArm)
        self.drive.halt, self.drive.watch = around.halt, around.watch
        self.axes = ToolAxes(self.drive)

    @property
    def time(self) -> float:
        """Time on the clock of the cell (s), rounded to the period of this clock."""
        period = self.arm.servo.period
        return round(round(self.drive.sensed.time / period) * period, 6)

    def take_over(self, record: HandOver, station: StationMemory) -> None:
        """Hold the arm where it stands. If the record names a part, hold this part too."""
        memory, drive = self.memory, self.memory.drive
        drive.friction, drive.links, drive.weights = station.friction, station.links, station.weights
        drive.hold_anew(self.cell.devices.sense(), self.arm)
        drive.load = record.load
        if record.held:
            drive.gap = SHUT
        memory.station = station
        self.axes = ToolAxes(self.drive)
        self.axes.tare()
        self.rest()

    def rest(self) -> None:
        """Note the set-points after a step."""
        self.memory.goal = tuple(map(float, self.axes.goal))

    def resume(self) -> None:
        """Go on from a restored memory. Raises BadFile if the memory does not fit the arm."""
        goal = self.memory.goal
        if len(goal) not in (0, _SIZE - 1) or not np.isfinite(goal).all():
            raise BadFile("the state of the run does not fit this arm")
        self.axes = ToolAxes(self.drive)
        if goal:
            self.axes.resume(np.array(goal))

    def stop(self) -> None:
        """Set the brakes."""
        self.drive.state.tool = 0.0
        self.drive.stop()
        self.axes.release()

    @property
    def station(self) -> StationMemory:
        """The memory of the station: the measurements of its own devices, and the state of its camera. The program
        returns this memory unchanged: only the program of 1973 improves the weights in it and uses the camera.
        """
        return self.memory.station

    def hand_over(
        self, record: HandOver | None, held: str, load: float, places: dict[str, np.ndarray]
    ) -> HandOver:
        """Set the brakes, and return the record for the next leg.

        Args:
            held: the name of the part in the hand, if the fingers hold anything.
            places: the places that the program hands over. Each value is a pose `X_WT` of the hand; each key is its
                name.
        """
        self.stop()
        sensed = self.drive.sensed
        holds = bool(held) and sensed.gap > EMPTY_GAP
        named: dict[Kind, dict[str, tuple[float, ...]]] = {
            kind: {**values} for kind, values in ({} if record is None else record.named).items()
        }
        named["place"] = {
            **named.get("place", {}),
            **{name: rounded_place(X) for name, X in places.items()},
        }
        return HandOver(
            hand=place_now(sensed, self.arm),
            gap=round(sensed.gap, 6),
            held=held if holds else "",
            load=load if holds else 0.0,
            named=named,
        )


class ToolLeg(RunningLeg):
    """A program that commands the arm by tool axes. The whole program is one leg."""

    tool: ToolArm

    @property
    def cell(self) -> SimulatedCell:
        return self.tool.cell

    @property
    def joints(self) -> tuple[str, ...]:
        return tuple(joint.name for joint in self.tool.arm.joints)

    @property
    def channels(self) -> tuple[Channel, ...]:
        return ()

    @property
    def time(self) -> float:
        return self.tool.time

    @property
    def station(self) -> StationMemory:
        return self.tool.station

    def begin(self) -> Sequence[AnyEvent]:
        raise Refused(
            "the first leg of a relay must be a program of the system of 1973, because only this system measures "
            "the joints of the arm"
        )

    def stand_at(self, stage: str) -> None:
        """Do nothing: the program begins when it takes the arm over."""


class ToolLegs(LegSystem):
    """Legs of a system that moves the tool of the arm. A program is one leg."""

    language: str  # its name in sentences

    def steps(self, plan: Any, stage: str) -> range:
        return range(len(self.listing(plan).steps))

    def executed(self, plan: Record, state: SystemState) -> Sequence[ExecutedStep]:
        return ()

    def lacks(self, plan: Any, stage: str, earlier: Sequence[str]) -> Sequence[Lack]:
        return [Lack(1, f"a program in {self.language} can do only one leg")] if earlier else []
