"""The arm of a task with planned programs. The arm takes a command in each servo period. The hand, the screwdriver and
the camera belong to the arm.
"""

from collections.abc import Mapping
from functools import cached_property
from typing import Any, ClassVar

import numpy as np

from handeye import tasks
from handeye.core.mutable_records import copied
from handeye.env.arm_commands import ArmCommands
from handeye.env.controls import ControlledMachine, Controls, Values
from handeye.env.jobs import Job
from handeye.env.policies import ArmFacts
from handeye.env.spaces import (
    ActionKind,
    Component,
    Observation,
    ObservationSpace,
    components,
    observation,
    observation_space,
)
from handeye.env.television import Television
from handeye.runs.runner import Runner
from handeye.tasks.interface import Task


class ControlledArm(ControlledMachine):
    """The arm of a job."""

    actions: ClassVar[tuple[ActionKind, ...]] = ("hand", "torques")

    def __init__(self, job: Job) -> None:
        super().__init__(job)
        self.period = self.work.arm.servo.period

    @cached_property
    def work(self) -> Task:
        """The task of the job."""
        return tasks.task(self.job.task)

    @property
    def sees(self) -> bool:
        return self.work.eye is not None

    def components(self, action: ActionKind, *, pictures: bool) -> tuple[Component, ...]:
        return components(action, self.work.arm, pictures=pictures)

    def observations(self, *, pictures: bool) -> ObservationSpace:
        return observation_space(self.work.arm, pictures=pictures)

    def begin(self, runner: Runner, action: ActionKind, *, pictures: bool) -> Controls:
        return ArmControls(runner, action, pictures=pictures)


class ArmControls(Controls):
    """The arm of an episode."""

    def __init__(self, runner: Runner, action: ActionKind, *, pictures: bool) -> None:
        self._runner = runner
        drive, camera = runner.context.drive, runner.arm_cell.devices.camera
        self._commands = ArmCommands(drive, action)
        self._television: Television | None = None
        if pictures and camera is not None:
            self._television = Television(drive, camera, runner.context.state.camera_ready)
        if runner.next is not None:
            runner.arm_cell.begin_stage(runner.next.stage + 1)

    def act(self, values: Values) -> None:
        if self._television is not None:
            self._television.command(values)
        self._commands.act(values)
        if self._television is not None:
            self._television.expose()

    def stop(self) -> None:
        self._commands.stop()

    def seen(self) -> Observation:
        seen = observation(self._runner.arm_cell.devices.sense(), self._commands.torque)
        return seen if self._television is None else seen | self._television.seen()

    @property
    def known(self) -> Mapping[str, Any]:
        drive = self._runner.context.state.drive
        links = np.ones(len(drive.q)) if drive.links is None else drive.links.copy()
        return {"friction": drive.friction.copy(), "links": links}

    def facts(self, common: Mapping[str, Any]) -> ArmFacts:
        arm, memory = self._runner.context.drive.arm, copied(self._runner.context.state)
        return ArmFacts(**common, **self.known, arm=arm, memory=memory)
