"""Lets a controller, which the calling program supplies, command the arm between two steps of the plan.

The controller knows only the readings of the cell's devices, and acts only through these devices.
"""

from collections.abc import Callable, Sequence

import numpy as np

from handeye.arm.model import constants
from handeye.execution.context import ExecutionContext
from handeye.ports.workcell import Sensed
from handeye.program.events import CommandedPeriod

Controller = Callable[[Sensed], CommandedPeriod | None]
"""A function that takes the readings of a servo period and returns the commands for the next period, or None to end
the control.
"""


def repeated(periods: Sequence[CommandedPeriod]) -> Controller:
    """Return a controller that gives recorded commands again, whatever it reads."""
    commands = iter(periods)
    return lambda _: next(commands, None)


def controlled(run: ExecutionContext, controller: Controller, most: int) -> tuple[CommandedPeriod, ...]:
    """Let a controller command the arm until the controller ends, or until `most` servo periods have passed. Then
    brake until the arm stands still. Returns the commands.

    Earlier steps can no longer be undone: a reversal must begin where the last step ended, and the controller has
    moved the arm away from there. After the controller has ended, the program assumes that an object may touch the
    hand.
    """
    drive, effort, commands = run.drive, constants(run.arm).effort, list[CommandedPeriod]()
    while len(commands) < most and (command := controller(drive.sensed)) is not None:
        commands.append(command)
        _command_devices(run, command)
        if command.torque is None:
            drive.brake(drive.period)
        else:
            drive.exert(np.clip(command.torque, -effort, effort))
    drive.stop()
    state = drive.state
    state.in_air = state.clear = False
    run.state.done.clear()
    return tuple(commands)


def _command_devices(run: ExecutionContext, command: CommandedPeriod) -> None:
    """Set the commands to the fingers and the screwdriver for the next servo period."""
    state = run.drive.state
    state.gap, state.grip, state.magnet = command.gap, command.grip, command.magnet
    if state.tool != command.driver:
        state.tool, state.current, state.starting, state.lately = command.driver, 0.0, [], []
