"""A relay during a run. Each step is a step of the leg that has the arm."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import msgspec

from handeye.cell.simulated import SimulatedCell
from handeye.core.entries import entry_named
from handeye.core.errors import BadFile, Refused
from handeye.core.mutable_records import put_back
from handeye.execution.state import ReversalOrder, Shot
from handeye.planfile.store import written_digest
from handeye.ports.axes import Channel
from handeye.program.events import (
    AnyEvent,
    Choice,
    OperatorAnswered,
    OperatorCalled,
    RunFinished,
    RunStarted,
    StageFinished,
    StageStarted,
    StepFinished,
    StepStarted,
    UndoEnded,
    UndoOrdered,
)
from handeye.program.system_state import SystemState
from handeye.runs.legs import RunningLeg
from handeye.runs.setup import Setup
from handeye.runs.system import RunCallbacks, RunningSystem, Settable
from handeye.runs.systems import system_named
from handeye.systems.relay import ENTRY
from handeye.systems.relay.executed import (
    LegStep,
    check_order,
    executed,
    fits,
    last_leg,
    memories,
    own_legs,
    own_order,
)
from handeye.systems.relay.happenings import LegFinished, LegStarted, of_leg
from handeye.systems.relay.plan import Leg, RelayPlan, legs, listing
from handeye.systems.relay.state import RelayCore
from handeye.tasks import task
from handeye.vision.marks import Mark


class RunningRelay(RunningSystem):
    """A relay that is executed: its programs, and the cell that they have in common."""

    def __init__(self, setup: Setup, around: RunCallbacks, state: RelayCore) -> None:
        """Build the cell and all programs. `state` is the empty state of the relay."""
        assert isinstance(setup.plan, RelayPlan)
        self._setup, self._around, self._plan = setup, around, setup.plan
        self._legs, self._listing = legs(self._plan), listing(self._plan)
        work = task(setup.task)
        self._arm = work.arm
        self._cell = work.cell(setup.world, around.parts.camera or setup.camera)
        self._state = state
        mine = replace(around, emit=self._retell)
        self._held: list[AnyEvent] | None = (
            None  # events of a leg that is taking the arm over; None: emit immediately
        )
        self._programs: dict[str, RunningLeg] = {}
        for leg in self._legs:
            if leg.file not in self._programs:
                own = msgspec.structs.replace(setup, system=leg.system.system, plan=leg.plan)
                self._programs[leg.file] = leg.system.build(own, mine, self._cell)
        self._keep_memories()

    # -- knowing ------------------------------------------------------------------------------------------

    @property
    def state(self) -> RelayCore:
        return self._state

    @property
    def cell(self) -> SimulatedCell:
        return self._cell

    @property
    def arm_cell(self) -> SimulatedCell:
        return self._cell

    @property
    def joints(self) -> tuple[str, ...]:
        return tuple(joint.name for joint in self._arm.joints)

    @property
    def channels(self) -> tuple[Channel, ...]:
        known = {channel.name: channel for each in self._programs.values() for channel in each.channels}
        return tuple(known.values())

    @property
    def time(self) -> float:
        return self._running.time

    @property
    def trouble(self) -> str | None:
        return self._running.trouble

    @property
    def switched_on(self) -> float:
        return self._programs[self._legs[0].file].switched_on

    @property
    def unkept(self) -> str | None:
        return self._programs[self._legs[0].file].unkept

    @property
    def shots(self) -> Mapping[str, Shot]:
        return self._running.shots

    def marks(self, picture: str) -> Sequence[Mark]:
        return self._running.marks(picture)

    @property
    def just_found(self) -> tuple[str, Sequence[Mark]]:
        return self._running.just_found

    @property
    def leg(self) -> Leg:
        """The leg that has the arm, or the last leg that had the arm."""
        return self._legs[self._state.leg]

    @property
    def legs(self) -> tuple[tuple[str, str], ...]:
        return tuple((leg.system.system, leg.stage) for leg in self._legs)

    @property
    def _running(self) -> RunningLeg:
        return self._programs[self.leg.file]

    @property
    def shown(self) -> Mapping[str, Any]:
        record = self._state.record
        return {
            "leg": self.leg.stage,
            "system": entry_named(self.leg.system.system).title,
            "record": None if record is None else msgspec.to_builtins(record),
            "program": self._running.shown,
        }

    # -- going on -----------------------------------------------------------------------------------------

    def begin(self) -> Sequence[AnyEvent]:
        begun, *others = self._running.begin()
        assert isinstance(begun, RunStarted)
        kind, plan = system_named(ENTRY.name), self._plan
        data = kind.encode(plan)
        arm, digest = kind.machine(plan)
        started = msgspec.structs.replace(
            begun,
            system=ENTRY.name,
            program=plan.name,
            steps=len(self._listing.steps),
            plan=kind.digest(plan, data),
            content=written_digest(data),
            arm=arm,
            arm_digest=digest,
        )
        self._state.station = self._running.station
        self._running.stand_at(self.leg.stage)
        self._keep_memories()
        self._state.entered = True
        self._mirror()
        return [started, *others, self._taken_over()]

    def step(self) -> None:
        state = self._state
        assert state.at is not None
        if not state.entered and not self._enter(state.at):
            return
        self._cell.begin_stage(state.leg + 1)
        undoing = self._undoing
        self._running.step()
        if undoing and not self._undoing and self._goes_further_back:
            self._take_back()
            self._go_back()
            return
        self._state.undoing = self._state.undoing if self._undoing else None
        self._go_on(undoing=undoing)

    def halt(self) -> None:
        self._running.halt()

    def answer(self, choice: Choice) -> None:
        if self._state.refused:
            self._answer_refusal(choice)
            return
        self._running.answer(choice)
        self._state.undoing = self._state.undoing if self._undoing else None
        self._go_on()

    def _go_on(self, *, undoing: bool = False) -> None:
        """Update the relay after a step of the program that has the arm. If the leg of this program has ended, hand
        the arm over to the next leg. If `undoing` is True, the last step was an undo, which may have gone back into an
        earlier leg of the same program.
        """
        self._mirror(undoing=undoing)
        if undoing or self._running.state.stopped is not None or self._running.state.stage is not None:
            return
        if self._running.state.at not in self.leg.steps:
            self._leave()

    def _mirror(self, *, undoing: bool = False) -> None:
        """Update the state of the relay from the state of the program that has the arm."""
        state, own = self._state, self._running.state
        if undoing:
            place = own.at if own.at is not None else own.onward
            same = (leg.index for leg in self._legs if leg.file == self.leg.file and place in leg.steps)
            state.leg = next(same, state.leg)
            del state.records[state.leg :]
        state.stopped = own.stopped
        ended = own.at is None and (own.stopped is not None or self._turned)
        state.at = None if ended else self.leg.number(own.at)
        state.onward = None if own.onward is None and own.stopped is None else self.leg.number(own.onward)
        state.stage = None if own.stage is None else state.leg

    @property
    def _undoing(self) -> bool:
        return getattr(self._running.state, "undoing", None) is not None

    @property
    def _turned(self) -> bool:
        """True if the arm has undone the program's last steps, and the program has not gone on since."""
        return self._running.state.onward is not None

    # -- handing over -------------------------------------------------------------------------------------

    def _leave(self) -> None:
        """Set the brakes, and make the record for the next leg."""
        state = self._state
        state.records.append(self._running.leave(state.record))
        state.station = self._running.station
        before = self.leg
        self._around.emit(
            LegFinished(time=self.time, stage=before.stage, system=before.system.system, program=before.file)
        )
        if before.onward is not None:
            state.leg, state.entered = state.leg + 1, False
            own = self._running.state
            goes_on = self.leg.file == before.file and own.at in self.leg.steps
            state.at = self.leg.number(own.at) if goes_on else self.leg.first
            state.stage = None

    def _enter(self, number: int) -> bool:
        """Let the program of the leg take the arm over. Returns False if the program has refused."""
        state = self._state
        assert state.record is not None
        assert state.station is not None
        self._held = []
        try:
            state.record.check_hand(self._cell.devices.sense(), self._arm)
            if self._legs[state.leg - 1].file != self.leg.file:
                self._running.take_over(self.leg.stage, state.record, state.station)
        except Refused as refused:
            self._held = None
            self._refuse(str(refused), number)
            return False
        self._running.stand_at(self.leg.stage)
        state.entered, state.refused = True, False
        held, self._held = self._held, None
        for event in (self._taken_over(), *held):
            self._around.emit(event)
        return True

    def _taken_over(self) -> LegStarted:
        record = self._state.record
        named = {name for values in ({} if record is None else record.named).values() for name in values}
        return LegStarted(
            time=self.time,
            stage=self.leg.stage,
            system=self.leg.system.system,
            program=self.leg.file,
            held="" if record is None else record.held,
            gap=round(self._cell.devices.sense().gap, 6),
            named=tuple(sorted(named)),
        )

    def _refuse(self, why: str, number: int) -> None:
        """Call the operator, because a leg cannot begin."""
        state, step = self._state, self._listing.steps[number]
        if state.stage is None:
            state.stage = state.leg
            self._around.emit(StageStarted(time=self.time, stage=self.leg.stage))
        self._around.emit(
            StepStarted(time=self.time, step=number, file=step.file, line=step.line, text=step.text)
        )
        self._around.emit(StepFinished(time=self.time, step=number, hand=None, planned=None, gap=None))
        state.stopped = OperatorCalled(time=self.time, message=why)
        state.at, state.onward, state.refused = None, number, True
        self._around.emit(state.stopped)

    def _answer_refusal(self, choice: Choice) -> None:
        """Follow the operator's answer to a refusal: try again, or leave the leg out."""
        state = self._state
        state.at = self.leg.onward if choice == "skip" else state.onward
        state.stopped, state.onward, state.refused = None, None, False
        self._around.emit(OperatorAnswered(time=self.time, choice=choice, step=state.at))
        if choice == "skip":
            self._around.emit(StageFinished(time=self.time, stage=self.leg.stage, status="skipped"))
            state.stage = None
            if self.leg.onward is not None:
                assert state.record is not None
                state.records.append(state.record)
                state.leg += 1

    def settables(self) -> Mapping[str, Settable]:
        return self._running.settables()

    def set_value(self, what: str, name: str, value: tuple[float, ...]) -> None:
        self._running.set_value(what, name, value)

    # -- undoing ------------------------------------------------------------------------------------------

    @property
    def executed(self) -> Sequence[LegStep]:
        return executed(self._plan, self._state)

    def reverse(self, undoing: ReversalOrder) -> None:
        check_order(self._plan, self._state, undoing)
        self._state.undoing = undoing
        self._around.emit(
            UndoOrdered(time=self.time, left=undoing.left, halts=undoing.halts, asked_by=undoing.asked_by)
        )
        self._state.leg, self._state.entered = last_leg(self._state), True
        self._go_back()

    def _go_back(self) -> None:
        """Let the program that has the arm undo its steps. If that program has no steps to undo, give the arm back to
        the program before it. Repeat this until a program has steps to undo.
        """
        assert self._state.undoing is not None
        while (order := own_order(self._plan, self._state, self._state.undoing)) is None:
            self._take_back()
        self._running.reverse(order)
        self._mirror(undoing=True)

    def _take_back(self) -> None:
        """Give the arm back to the program that had the arm before."""
        state = self._state
        self._running.leave(state.record)
        station = self._running.station
        state.leg = own_legs(self._plan, state)[0].index - 1
        del state.records[state.leg :]
        self._running.take_back(station)

    @property
    def _goes_further_back(self) -> bool:
        """True if steps of earlier programs remain to be undone."""
        order = self._state.undoing
        return order is not None and len(self.executed) > order.left

    # -- ending -------------------------------------------------------------------------------------------

    def finish(self) -> bool:
        state = self._state
        if state.stage is not None:
            self._around.emit(StageFinished(time=self.time, stage=self.leg.stage, status="stopped"))
        completed = state.at is None and state.stopped is None
        self._around.emit(RunFinished(time=self.time, completed=completed))
        return completed

    def restore(self, state: SystemState) -> None:
        if not isinstance(state, RelayCore) or not fits(self._plan, state):
            raise BadFile("the state of the run does not fit this relay")
        put_back(self._state, state)
        for file, memory in memories(self._plan, state).items():
            self._programs[file].restore(memory)
        self._keep_memories()

    def _keep_memories(self) -> None:
        """Let the state hold the programs' own memories, not copies: a program changes its memory in place."""
        for program in self._plan.programs:
            getattr(self._state, program.system)[program.file] = self._programs[program.file].state

    # -- events -------------------------------------------------------------------------------------------

    def _retell(self, event: AnyEvent) -> None:
        """Emit an event of a program. In the emitted event, the step numbers and stages of the relay replace the
        program's own. An order to undo steps gives one `UndoOrdered` and one `UndoEnded`, even if several programs
        execute it.
        """
        if isinstance(event, UndoOrdered):
            if self._state.undoing is not None:
                return
            own = self.leg.system.executed(self.leg.plan, self._running.state)
            event = msgspec.structs.replace(event, left=event.left + len(self.executed) - len(own))
        if isinstance(event, UndoEnded) and self._goes_further_back:
            return
        if isinstance(event, StageStarted | StageFinished):
            if isinstance(event, StageStarted) and self._state.stage == self._state.leg:
                return  # begun when the leg refused to take the arm over
            event = msgspec.structs.replace(event, stage=self._stage(event.stage))
        elif "step" in event.__struct_fields__:
            number = event.step  # type: ignore[union-attr]
            leg = next(
                (leg for leg in self._legs if leg.file == self.leg.file and number in leg.steps), self.leg
            )
            event = msgspec.structs.replace(event, step=leg.number(number))
        elif "stage" in event.__struct_fields__:
            event = msgspec.structs.replace(event, stage=self._stage(event.stage))  # type: ignore[union-attr]
        event = of_leg(event)
        if self._held is None:
            self._around.emit(event)
        else:
            self._held.append(event)

    def _stage(self, name: str) -> str:
        """Return the name that a stage has in the relay. `name` is the stage's name in the program."""
        return name if name in self._listing.stages else self.leg.stage
