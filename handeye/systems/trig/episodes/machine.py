"""The Purbrick arm in an episode. Every 10 ms, an action moves the set-points of the arm's axes and hand."""

from collections.abc import Mapping
from copy import deepcopy
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from handeye.core.pose import Array
from handeye.core.units import MILLIMETRE
from handeye.env.controls import ControlledMachine, Controls, Values
from handeye.env.policies import Facts
from handeye.env.spaces import (
    ActionKind,
    Component,
    Observation,
    ObservationSpace,
    clock,
    numbers,
    together,
)
from handeye.machines.purbrick import PURBRICK
from handeye.runs.runner import Runner
from handeye.systems.trig.jobs.benches import TaughtJob
from handeye.systems.trig.language.axes_arm import ArmMemory
from handeye.systems.trig.language.place import is_named
from handeye.systems.trig.language.program import TrigProgram
from handeye.systems.trig.run.job import job_of

_AXES: Final = (*PURBRICK.axes, PURBRICK.hand)
MOVES: Final = tuple(f"{'turn' if spec.kind == 'revolute' else 'move'}.{spec.name}" for spec in _AXES)
"""Names of the components of an action that move the axes: one component for each axis, in the order of the axes. The
last one moves the hand.
"""
_LOWER: Final = np.array([*(spec.lower for spec in PURBRICK.axes), PURBRICK.limits.closed])
_UPPER: Final = np.array([spec.upper for spec in _AXES])


@dataclass(frozen=True, slots=True, kw_only=True)
class TaughtFacts(Facts):
    """The facts about the taught program that a policy may know."""

    taught: Mapping[str, Array]  # the positions by name, with the errors of teaching: six numbers, m and rad
    places: Array  # of the blocks on the pallet, computed from the positions: x and y, shape (blocks, 2), m
    program: TrigProgram
    arm: ArmMemory  # the commanded place and opening at the beginning


class ControlledPurbrick(ControlledMachine):
    """The arm of a taught job."""

    period = PURBRICK.period

    def components(self, action: ActionKind, *, pictures: bool) -> tuple[Component, ...]:
        moves = tuple(
            Component(
                name=name, scale=spec.speed * self.period, signed=True,
                unit="rad" if spec.kind == "revolute" else "m",
            )
            for name, spec in zip(MOVES, _AXES, strict=True)
        )  # fmt: skip
        return (*moves, Component(name="done", scale=1.0, unit=""))

    def observations(self, *, pictures: bool) -> ObservationSpace:
        return together(
            {
                "q": numbers(len(PURBRICK.axes)),
                "gap": numbers(1),
                "goal": numbers(len(_AXES)),
                "force": numbers(PURBRICK.force.width),
                "clock": clock(),
            }
        )

    def begin(self, runner: Runner, action: ActionKind, *, pictures: bool) -> Controls:
        return PurbrickControls(job_of(runner).job)


class PurbrickControls(Controls):
    """The arm of an episode. Its set-points are the values that the program commanded last."""

    def __init__(self, job: TaughtJob) -> None:
        self._job, memory = job, job.arm.memory
        self._goal = np.array([*memory.told, memory.opening])

    def act(self, values: Values) -> None:
        moved = np.array([values[name] for name in MOVES])
        self._goal = np.clip(self._goal + moved, _LOWER, _UPPER)
        self._pass()

    def stop(self) -> None:
        for _ in range(round(PURBRICK.limits.settling / PURBRICK.period)):
            self._pass()

    def seen(self) -> Observation:
        read = self._job.axes.read()
        return {
            "q": read.q[:-1].copy(),
            "gap": read.q[-1:].copy(),
            "goal": self._goal.copy(),
            "force": np.array([read.channels[part] for part in PURBRICK.force.parts]),
            "clock": np.array([read.time]),
        }

    @property
    def known(self) -> Mapping[str, Any]:
        positions = self._job.session.program.positions.items()
        taught = {name: np.array(each.init) for name, each in positions if is_named(name)}
        return {"taught": taught, "places": np.array(self._job.goals) * MILLIMETRE}

    def facts(self, common: Mapping[str, Any]) -> TaughtFacts:
        program = deepcopy(self._job.session.program)
        return TaughtFacts(**common, **self.known, program=program, arm=self._job.arm.memory)

    def _pass(self) -> None:
        self._job.axes.put(self._goal)
        self._job.bench.advance(PURBRICK.period)
