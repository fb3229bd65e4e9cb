"""Simulates the rotor of a stepping motor. The pulses pull the rotor along like a spring whose greatest force is the
pull-out force. Beyond that force, the rotor slips.

There are two models. The reference is the sine model, force = pull-out x sin(2 pi lag / 4 steps), which is integrated
in steps of .1 ms. The balance model, in steps of 1 ms, is a quick check. The balance model tests whether the force
that the pulses require is available. A rotor that can no longer follow its pulses coasts until a pole catches it. In
both models the rotor slips by whole poles of 4 steps. Units are SI, except for steps.
"""

import math
from dataclasses import dataclass
from typing import Final, Literal

import numpy as np
from numpy.typing import NDArray

from handeye.systems.sigma.motors.pulses import CLOCK_HZ, CURVES, Pulses
from handeye.systems.sigma.protocol import STEP_MM

STEP: Final = STEP_MM / 1000  # m
POLE: Final = 4  # steps
MASSES: Final = {"X": 12.0, "Y": 8.0, "Z": 2.5}  # kg that each axis moves
FRICTION: Final = 0.5  # N s/m for each kg
_FINE: Final = 1e-4  # s: step of the sine model
_COARSE: Final = 1e-3  # s: step of the balance model
_JUMP: Final = 1.1 * CURVES[0].start  # steps/s: a jump of speed within a millisecond that is always allowed
_SMOOTH: Final = 5  # ms
_NOTHING: Final = 1e-9  # N
_SETTLE: Final = 0.1  # s that are simulated after the last pulse
_FULL: Final = 2 * math.pi / POLE  # rad in the sine for each step of lag


@dataclass(frozen=True, slots=True, kw_only=True)
class Drive:
    """A motor with the mass that it moves, and its load."""

    mass: float  # kg
    friction: float = FRICTION  # N s/m for each kg
    load: float = 0.0  # N against the motion
    start_force: float = 200.0  # pull-out force at start/stop speed, N
    top_force: float = 20.0  # pull-out force at the greatest speed, N
    damping: float = 0.1  # damping ratio of the rotor in its field at start/stop speed

    def pull_out(self, speed: float) -> float:
        """Return the greatest force (N) at a speed (steps/s)."""
        first, last = CURVES[1].start, CURVES[1].top
        share = min(max((abs(speed) - first) / (last - first), 0.0), 1.0)
        return self.start_force + (self.top_force - self.start_force) * share

    @property
    def damper(self) -> float:
        """Damping between rotor and field (N s/m)."""
        return 2 * self.damping * math.sqrt(self.start_force * _FULL / STEP * self.mass)

    @property
    def starts(self) -> bool:
        """True if a rotor at rest can follow the jump to the start/stop speed. The rotor can follow if its pole can
        absorb the energy of the jump.
        """
        return _holds(self, CURVES[0].start, self.start_force)


@dataclass(frozen=True, slots=True, kw_only=True)
class Followed:
    """How well a rotor followed its pulses."""

    lost: int  # poles by which the rotor is behind at the end; negative: ahead
    lag: float  # greatest lag, steps
    margin: float  # least ratio of the pull-out force to the required force; below 1 the rotor cannot follow
    tightest: float  # time of the least ratio, s
    rotor: NDArray[np.float64]  # steps that the rotor has made after each `period`
    period: float  # s

    @property
    def kept(self) -> bool:
        """True if the rotor never left its pole."""
        return self.lost == 0 and self.lag < POLE


def commanded(
    pulses: Pulses, period: float, settle: float = _SETTLE
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the commanded position (steps) and the commanded speed (steps/s), each averaged over periods of `period`
    seconds. The last period ends `settle` seconds after the last pulse.
    """
    count = math.ceil((pulses.seconds + settle) / period)
    ticks = np.arange(count + 1) * (period * CLOCK_HZ)
    done = np.searchsorted(pulses.ticks, ticks, side="right")
    before = np.concatenate(([0], np.cumsum(pulses.ticks)))
    under = done * ticks - before[done]  # step-ticks that are behind each moment
    places = np.interp(ticks, np.concatenate(([0], pulses.ticks)), np.arange(len(pulses) + 1))
    return np.diff(under) / (period * CLOCK_HZ), np.diff(places) / period


def wanted(pulses: Pulses, drive: Drive) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the force (N) that a train requires in each millisecond, and the speed at that time (steps/s).

    The jumps to and from the start/stop speed are not included. Changes of speed are averaged over some
    milliseconds, so that the rounding of the counter's dividers does not count as acceleration.
    """
    count = max(1, math.ceil(pulses.seconds / _COARSE))
    edges = np.minimum(np.arange(count + 1) * _COARSE, pulses.seconds)
    places = np.interp(edges * CLOCK_HZ, np.concatenate(([0], pulses.ticks)), np.arange(len(pulses) + 1))
    speeds = np.diff(places) / np.maximum(np.diff(edges), 1e-9)
    smooth = np.convolve(np.pad(speeds, _SMOOTH // 2, mode="edge"), np.ones(_SMOOTH) / _SMOOTH, mode="valid")
    change = np.gradient(smooth) / _COARSE if count > 1 else np.zeros(1)
    return drive.mass * (change + drive.friction * speeds) * STEP + drive.load, speeds


class Balance:
    """A rotor in the balance model, with steps of one millisecond.

    The rotor is `caught` as long as its pole can give the required force. If more force is required, the rotor is
    `strained` until it is two steps away from the pole. The rotor is then `slipping`, and only the damping pulls it
    along, until a pole can hold it again.
    """

    def __init__(self, drive: Drive) -> None:
        self.drive = drive
        self.state: Literal["caught", "strained", "slipping"] = "caught"
        self.place = 0.0  # steps
        self.off = 0  # steps (whole poles) between its pole and the pole that it should follow
        self._lag = self._growing = 0.0  # steps behind its pole, steps/s
        self._speed = self._before = 0.0  # steps/s of the rotor, and of the field a millisecond ago

    def follow(self, there: float, pace: float, force: float) -> None:
        """Let a millisecond pass. During this millisecond, the field is at the position `there` (steps), moves at
        `pace` (steps/s), and requires a force (N).
        """
        pull, jump = self.drive.pull_out(pace), abs(pace - self._before)
        if self.state != "slipping" and jump > _JUMP and not _catches(self.drive, pace, self._before):
            self.state, self._speed = "slipping", self._before
        self._before = pace
        if self.state == "caught" and abs(force) > pull:
            self.state, self._lag, self._growing = "strained", math.copysign(POLE / 4, force), 0.0
        match self.state:
            case "caught":
                self._lag = lag_for(force, pull)
            case "strained":
                self._strain(pace, force, pull)
            case "slipping":
                self._slip(there, pace, force, pull)
        if self.state != "slipping":
            self.place, self._speed = there + self.off - self._lag, pace - self._growing

    def _strain(self, pace: float, force: float, pull: float) -> None:
        drive = self.drive
        lacking = (force - pull * math.sin(self._lag * _FULL)) / drive.mass / STEP
        self._growing = (self._growing + lacking * _COARSE) / (1 + drive.damper / drive.mass * _COARSE)
        self._lag += self._growing * _COARSE
        if abs(self._lag) >= POLE / 2:
            self.state, self._speed = "slipping", pace - self._growing
        elif abs(force) <= pull and self._growing * self._lag <= 0:
            self.state, self._lag, self._growing = "caught", lag_for(force, pull), 0.0

    def _slip(self, there: float, pace: float, force: float, pull: float) -> None:
        drive = self.drive
        drawn = drive.damper / drive.mass  # 1/s
        gained = self._speed + (drawn * pace - drive.load / drive.mass / STEP) * _COARSE
        self._speed = max(0.0, gained / (1 + (drive.friction + drawn) * _COARSE))
        self.place += self._speed * _COARSE
        if abs(force) <= pull and _catches(drive, pace, self._speed):
            self.off = round((self.place - there) / POLE) * POLE
            self.state, self._lag, self._growing = "caught", lag_for(force, pull), 0.0


def by_balance(pulses: Pulses, drive: Drive) -> Followed:
    """Let a rotor follow a pulse train in the balance model."""
    field, _ = commanded(pulses, _COARSE)
    forces, speeds = wanted(pulses, drive)
    rest = np.zeros(max(0, len(field) - len(forces)))
    moves = zip(field.tolist(), [*speeds, *rest], [*forces, *rest], strict=False)
    balance, rotor = Balance(drive), np.empty(len(field))
    for index, (there, pace, force) in enumerate(moves):
        balance.follow(there, float(pace), float(force))
        rotor[index] = balance.place
    margin, tightest = _margin(forces, speeds, drive)
    return Followed(
        lost=round((field[-1] - balance.place) / POLE),
        lag=float(np.abs(field - rotor).max()),
        margin=margin,
        tightest=tightest,
        rotor=rotor,
        period=_COARSE,
    )


def _margin(forces: NDArray[np.float64], speeds: NDArray[np.float64], drive: Drive) -> tuple[float, float]:
    """Return the least ratio of the pull-out force to the required force, and the time at which it occurs (s)."""
    margins = np.array([drive.pull_out(speed) for speed in speeds]) / np.maximum(np.abs(forces), _NOTHING)
    tightest = int(margins.argmin())
    return float(margins[tightest]), (tightest + 1) * _COARSE


def lag_for(force: float, most: float) -> float:
    """Return the lag (steps) at which a rotor gives the force `force`. `most` is the greatest force of the rotor."""
    return math.asin(min(max(force / most, -1.0), 1.0)) / _FULL


def _catches(drive: Drive, field: float, speed: float) -> bool:
    """Return True if the field can catch the rotor, although the field and the rotor move at different speeds
    (steps/s).
    """
    return _holds(drive, abs(field - speed), drive.pull_out(field))


def _holds(drive: Drive, between: float, pull: float) -> bool:
    """Return True if a pole holds the rotor although the speeds of field and rotor differ by `between` (steps/s). A
    load reduces the energy that the pole can absorb.
    """
    lag = lag_for(drive.load, pull) * _FULL
    depth = pull * (math.cos(lag) - math.cos(math.pi - lag)) - drive.load * (math.pi - 2 * lag)
    return drive.load < pull and drive.mass * (between * STEP) ** 2 / 2 <= depth * STEP / _FULL


def by_sine(pulses: Pulses, drive: Drive) -> Followed:
    """Let a rotor follow a pulse train in the sine model, in steps of a tenth of a millisecond."""
    field, speeds = commanded(pulses, _FINE)
    pulls = [drive.pull_out(speed) for speed in speeds.tolist()]
    damper, mass = drive.damper, drive.mass
    drag = drive.friction * mass
    place, velocity, most = 0.0, 0.0, 0.0  # steps, m/s, steps
    rotor = np.empty(len(field))
    for index, (there, pace, pull) in enumerate(zip(field.tolist(), speeds.tolist(), pulls, strict=True)):
        lag = there - place
        force = (
            pull * math.sin(lag * _FULL) + damper * (pace * STEP - velocity) - drag * velocity - drive.load
        )
        velocity += force / mass * _FINE
        place += velocity / STEP * _FINE
        most = max(most, abs(lag))
        rotor[index] = place
    margin, tightest = _margin(*wanted(pulses, drive), drive)
    return Followed(
        lost=round((field[-1] - place) / POLE),
        lag=most,
        margin=margin,
        tightest=tightest,
        rotor=rotor,
        period=_FINE,
    )
