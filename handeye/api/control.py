"""Control of the arm by the caller's own code, servo period by servo period."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import ArrayLike

from handeye.core.errors import BadArgument, Refused
from handeye.core.plain_text import counted
from handeye.execution.servo import Halted
from handeye.ports.workcell import Sensed
from handeye.program.events import CommandedPeriod
from handeye.runs.parts import name_of
from handeye.runs.runner import Runner

HOUR: Final = 3600.0  # s; a controller commands the arm for at most this time at once


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Command:
    """The command of a controller for one servo period. If `torque` is None, the brakes are set. If the command of
    another device is None, the device keeps its last command.

    >>> handeye.Command(torque=[0.0] * 6, gap=0.02).gap
    0.02
    """

    torque: ArrayLike | None = None
    """Torque of each joint, shape (n,), in N m, or in N if the joint is prismatic. The drive of a joint does not give
    more than its greatest torque (`effort` of the joint). None sets the brakes.
    """
    gap: float | None = None  # goal of the opening between the finger tips, m
    grip: float | None = None  # greatest force of each finger, N
    driver: float | None = None  # speed of the screwdriver, rad/s; positive drives a screw in
    magnet: bool | None = None  # the magnet of the screwdriver's bit is on


Controller = Callable[[Sensed], Command | None]
"""A function that takes the readings at the end of a servo period and returns the command for the next period. If it
returns None, the control ends.
"""


def take_control(runner: Runner, controller: Controller, seconds: float) -> str:
    """Hand the arm over to a controller for at most `seconds` of simulated time. Returns the reason why the control
    ended, as a text. If the controller or the simulation fails, the run returns to its state before the control.

    Raises:
        InvalidInput: the run cannot be controlled now, an argument cannot be used, or the controller returned
            something that is not a command.
    """
    period, name = runner.context.drive.period, _named(controller)
    most = _periods(seconds, period)
    if runner.trouble is not None:
        raise Refused(f"the arm cannot be controlled, because the run cannot continue: {runner.trouble}")
    if runner.context.state.undoing is not None:
        raise Refused("the arm cannot be controlled while it is undoing steps")
    try:
        done = runner.control(name, _checked(name, controller, runner), most)
    except Halted:
        runner.rollback()
        return (
            f"the panic button stopped the controller {name}; the run is back in its state before the control"
        )
    except BaseException:  # in code of the caller, or in the simulation
        runner.rollback()
        raise
    end = "ended" if done < most else "used all its time"
    return f"the controller {name} {end} after {done * period:.2f} s"


def _named(controller: object) -> str:
    if not callable(controller):
        raise BadArgument(f"a controller must be a function that receives the readings, not {controller!r}")
    return name_of(controller)


def _periods(seconds: object, period: float) -> int:
    """Return how many whole servo periods fit into `seconds`. Raises BadArgument unless this time is between one
    period and one hour.
    """
    if not isinstance(seconds, int | float) or isinstance(seconds, bool) or not period <= seconds <= HOUR:
        raise BadArgument(
            f"`seconds` must be a number from one servo period ({period:.4f} s) to {HOUR:.0f} s, not {seconds!r}"
        )
    return int(seconds / period + 1e-6)


def _checked(name: str, controller: Controller, runner: Runner) -> Callable[[Sensed], CommandedPeriod | None]:
    """Wrap a controller. Each command is checked. If `gap`, `grip`, `driver` or `magnet` is None, it gets its previous
    value; a `torque` of None stays None, because it sets the brakes.
    """
    joints, last = len(runner.context.arm.joints), runner.context.drive.state

    def command(sensed: Sensed) -> CommandedPeriod | None:
        given = controller(sensed)
        if given is None:
            return None
        if not isinstance(given, Command):
            raise BadArgument(f"the controller {name} must return a handeye.Command or None, not {given!r}")
        return CommandedPeriod(
            torque=_torque(name, given, joints),
            gap=_number(name, "gap", given.gap, last.gap),
            grip=_number(name, "grip", given.grip, last.grip),
            driver=_number(name, "driver", given.driver, last.tool),
            magnet=last.magnet if given.magnet is None else bool(given.magnet),
        )

    return command


def _torque(name: str, given: Command, joints: int) -> tuple[float, ...] | None:
    if given.torque is None:
        return None
    try:
        torque = np.asarray(given.torque, dtype=np.float64)
    except (TypeError, ValueError):
        torque = np.empty(0)
    if torque.shape != (joints,) or not np.isfinite(torque).all():
        raise BadArgument(
            f"the controller {name} must give {counted(joints, 'finite torque')}, not {given.torque!r}"
        )
    return tuple(torque.tolist())


def _number(name: str, field: str, given: object, before: float) -> float:
    """Return the command to a device, or the previous command if the given command is None. Raises BadArgument if the
    command is not finite.
    """
    try:
        number = float(before if given is None else given)  # type: ignore[arg-type]  # of any type: it comes from a user's function
    except (TypeError, ValueError):
        number = math.nan
    if not math.isfinite(number):
        raise BadArgument(f"the controller {name} must give a finite number as `{field}`, not {given!r}")
    return number
