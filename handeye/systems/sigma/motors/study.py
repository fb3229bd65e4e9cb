"""Studies a move of one axis: the force that the move requires, and whether the rotor follows the pulses."""

import math
from typing import Final, Literal

import numpy as np
from numpy.typing import NDArray

from handeye.core.errors import BadArgument
from handeye.core.plain_text import counted
from handeye.core.record import Record
from handeye.systems.sigma.motors.pulses import (
    CLOCK_HZ,
    CURVES,
    SHORT,
    Pulses,
    Train,
    constant,
    profile,
    stopped,
)
from handeye.systems.sigma.motors.rotor import POLE, Drive, by_balance, by_sine, wanted
from handeye.systems.sigma.protocol import LONGEST_MOVE, STEP_MM

_ROWS: Final = 12  # rows of the table
_HEAVIEST: Final = 1000.0  # kg


class Moment(Record, frozen=True, kw_only=True):
    """The state of a move at one moment."""

    time: float  # s
    speed: float  # steps/s
    force: float  # N: required force
    pull_out: float  # N: available force (pull-out force)


class AxisStudy(Record, frozen=True, kw_only=True):
    """The results of a move."""

    mass: float  # kg
    load: float  # N
    curve: int
    steps: int  # pulses that were sent
    kind: Literal["short", "medium", "long", "constant"]
    interrupted: Literal["", "stop", "cut"]
    seconds: float
    top: float  # steps/s
    moments: tuple[Moment, ...]
    margin: float  # least ratio of the pull-out force to the required force
    tightest: float  # time of the least ratio, s
    starts: bool  # the rotor can follow the jump to start/stop speed by itself
    lag: float  # steps: greatest lag in the sine model; the rotor slips at 2
    lost: int  # poles lost in the sine model
    kept: bool  # True: the rotor never left its pole
    lost_by_balance: int


def study(
    *,
    mass: float,
    steps: int,
    curve: int = 0,
    slow: float | None = None,
    load: float = 0.0,
    stop_after: float | None = None,
    cut: bool = False,
) -> AxisStudy:
    """Simulate a move with the sine model and with the balance model.

    Args:
        mass: mass that the motor moves (kg).
        slow: constant speed (mm/s), or None for the profile that belongs to the length of the move.
        load: force against the motion (N).
        stop_after: time after which an emergency stop begins (s); None: no stop.
        cut: stop by sending no more pulses, instead of by the steepest ramp.
    """
    _check(mass, steps, curve, slow, load)
    shape = CURVES[curve]
    train = profile(steps, shape) if slow is None else constant(steps, slow / STEP_MM, shape)
    pulses: Pulses = train.pulses
    interrupted: Literal["", "stop", "cut"] = ""
    if stop_after is not None:
        if not 0 < stop_after < pulses.seconds:
            raise BadArgument(
                f"the move takes {1000 * pulses.seconds:.1f} ms; the stop must be within that time, not after "
                f"{1000 * stop_after:g} ms"
            )
        pulses = stopped(train, shape, round(stop_after * CLOCK_HZ), cut=cut)
        interrupted = "cut" if cut else "stop"
        if not len(pulses):
            raise BadArgument(
                f"a stop after {1000 * stop_after:g} ms is too early: no pulse is sent within that time"
            )
    drive = Drive(mass=mass, load=load)
    sine, balance = by_sine(pulses, drive), by_balance(pulses, drive)
    return AxisStudy(
        mass=mass,
        load=load,
        curve=curve,
        steps=len(pulses),
        kind=_kind(train, slow),
        interrupted=interrupted,
        seconds=pulses.seconds,
        top=CLOCK_HZ / int(pulses.dividers.min()),
        moments=_moments(pulses, drive),
        margin=balance.margin,
        tightest=balance.tightest,
        starts=drive.starts,
        lag=sine.lag,
        lost=sine.lost,
        kept=sine.kept,
        lost_by_balance=balance.lost,
    )


def _check(mass: float, steps: int, curve: int, slow: float | None, load: float) -> None:
    if not 0 < mass <= _HEAVIEST:
        raise BadArgument(f"a moved mass must be above 0 and at most {_HEAVIEST:g} kg, not {mass:g}")
    if not 1 <= steps <= LONGEST_MOVE:
        raise BadArgument(f"a move must have 1 to {LONGEST_MOVE} steps, not {steps}")
    if not 0 <= curve < len(CURVES):
        raise BadArgument(f"there is no curve {curve}; the curves are 0 to {len(CURVES) - 1}")
    if slow is not None and not 1 <= slow <= CURVES[1].top * STEP_MM:
        raise BadArgument(
            f"a constant speed must be between 1 and {CURVES[1].top * STEP_MM:g} mm/s, not {slow:g}"
        )
    if not (math.isfinite(load) and load >= 0):
        raise BadArgument(f"a load must be 0 N or more, not {load:g}")


def _kind(train: Train, slow: float | None) -> Literal["short", "medium", "long", "constant"]:
    if slow is not None:
        return "constant"
    if train.steps <= SHORT:
        return "short"
    return "long" if train.peak >= train.top else "medium"


def _moments(pulses: Pulses, drive: Drive) -> tuple[Moment, ...]:
    forces, speeds = wanted(pulses, drive)
    return tuple(
        Moment(time=(n + 1) / 1000, speed=speed, force=force, pull_out=drive.pull_out(speed))
        for n, (force, speed) in enumerate(zip(forces.tolist(), speeds.tolist(), strict=True))
    )


def lines(found: AxisStudy) -> list[str]:
    """Describe the study in words and a table."""
    curve = CURVES[found.curve]
    load = f" against {found.load:g} N" if found.load else ""
    out = [
        f"{found.mass:g} kg{load}, curve {found.curve}: {curve.start:g} to {curve.top:g} steps/s, "
        f"{curve.acceleration:g} steps/s2",
        f"{counted(found.steps, 'step')} ({found.steps * STEP_MM:g} mm), {found.kind}"
        f"{_INTERRUPTED[found.interrupted]}: {1000 * found.seconds:.1f} ms, at most {found.top:.1f} steps/s "
        f"({found.top * STEP_MM:.0f} mm/s)",
        "",
        "      ms   steps/s     mm/s   force N   pull-out N",
    ]
    picked = np.unique(np.linspace(0, len(found.moments) - 1, _ROWS).astype(int))
    out += [
        f"{1000 * m.time:8.0f}{m.speed:10.0f}{m.speed * STEP_MM:9.1f}{m.force:10.1f}{m.pull_out:13.1f}"
        for m in (found.moments[int(n)] for n in picked)
    ]
    return [*out, "", *verdict(found)]


_INTERRUPTED: Final = {"": "", "stop": ", stopped by the steepest ramp", "cut": ", its pulses cut off"}


def verdict(found: AxisStudy) -> list[str]:
    """Say in sentences whether the rotor follows the pulses."""
    out = [
        f"the smallest ratio of the pull-out force to the required force is {found.margin:.2f}, at "
        f"{1000 * found.tightest:.0f} ms"
    ]
    if not found.starts:
        out.append("without damping, the rotor would slip when the speed jumps to the start/stop speed")
    if found.kept:
        out.append(
            f"the rotor follows each pulse, at most {found.lag:.2f} steps behind or ahead; the rotor would slip at "
            "2 steps"
        )
    elif not found.lost:
        out.append(
            f"the rotor slips on its way, by up to {counted(round(found.lag), 'step')}, but happens to end at its goal"
        )
    else:
        where = "behind" if found.lost > 0 else "ahead"
        away = f"{counted(abs(found.lost), 'pole')} ({abs(found.lost) * POLE * STEP_MM:.2f} mm)"
        out.append(f"the rotor slips, and ends {away} {where}; the count does not show the slip")
    return out


def series(found: AxisStudy) -> tuple[NDArray[np.float64], ...]:
    """Return the times (ms), speeds (steps/s), required forces (N) and pull-out forces (N)."""
    rows = [(1000 * m.time, m.speed, m.force, m.pull_out) for m in found.moments]
    return tuple(np.array(rows).T)
