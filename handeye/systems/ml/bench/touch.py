"""One guarded touch in physics: the hand of the rectilinear arm descends on a block until the reading of a strain
gauge exceeds a limit. The caller chooses the speed, the bandwidth of the servo, and the period in which the sensors
are read.
"""

from dataclasses import dataclass
from functools import lru_cache
from math import ceil, pi
from typing import Final

import mujoco
import numpy as np

from handeye.cell.bench import Bench
from handeye.cell.bench_axes import BenchAxes
from handeye.core.errors import BadArgument
from handeye.core.record import Record
from handeye.core.units import MILLIMETRE
from handeye.systems.ml.bench.arm import AXES, RESOLVED, STRAINED
from handeye.systems.ml.bench.station import scene
from handeye.systems.ml.bench.world import ArmWorld
from handeye.systems.ml.machine.spec import GRAM_FORCE

PERIOD: Final = 10  # ms, as in the paper
BANDWIDTH: Final = 50.0  # Hz, as in the paper
SPEED: Final = 25.0  # mm/s
LIMIT: Final = 300  # grams on a finger
PERIODS: Final = (1, 100)  # ms: range of periods that can be simulated
BANDWIDTHS: Final = (5.0, 120.0)  # Hz
SPEEDS: Final = (1.0, 200.0)  # mm/s; the slides of the paper move at no more than 200
LIMITS: Final = (10, 1500)  # grams; 1500 is the greatest reading of a gauge
PHASES: Final = 4
_DAMPING: Final = 0.8
_CARRIED: Final = 29.08  # kg that the z slide moves
_DRAG: Final = 300.0  # N s/m: damping of the slide's joint
_BLOCK: Final = 0.04  # m, height of the block
_REACH: Final = 0.25  # m from the fingertips to the table at z = 0
STIFFNESS: Final = 10_000.0  # N/m of a finger along z
_START: Final = 0.15  # s after which the jolt of a start has died away
_BEFORE: Final = 30.0  # ms before the contact that are kept
_AFTER: Final = 0.1  # s after the contact that are simulated
_MS: Final = 0.001  # s, the step of the physics


class Touch(Record, frozen=True, kw_only=True):
    """A guarded touch and its result."""

    period: int  # ms
    bandwidth: float  # Hz
    speed: float  # mm/s
    limit: int  # grams on the right finger
    phase: float  # when the contact occurs in the period: 0 just after a reading, near 1 just before one
    jolt: float  # N: greatest force on the finger before the contact, caused by the start of the motion
    noticed: float | None  # ms from the contact to the reading that is beyond the limit; None: there was none
    way: float  # mm that the slide goes on after the contact
    force: float  # N, the greatest force of both fingers on the block
    times: tuple[float, ...] = ()  # ms from the contact on, for the courses below
    places: tuple[float, ...] = ()  # mm of the slide below the place of contact
    goals: tuple[float, ...] = ()  # mm, the set-points of the servo
    forces: tuple[float, ...] = ()  # N of both fingers
    readings: tuple[float, ...] = ()  # ms at which the sensors are read

    @property
    def bound(self) -> float:
        """The greatest distance (mm) that the slide can move after the contact, to within a few per cent. The slide
        first moves until the force on the fingers reaches the limit. After that it moves for one more period, and then
        for the time by which the servo lags behind its set-point.
        """
        lag = 2 * _DAMPING / (2 * pi * self.bandwidth)
        return self.limit * GRAM_FORCE / STIFFNESS / MILLIMETRE + self.speed * (self.period * _MS + lag)

    @property
    def trips(self) -> bool:
        """True if the jolt at the start of the motion would trip a guard that had been set before."""
        return self.jolt > self.limit * GRAM_FORCE


@dataclass(frozen=True, slots=True)
class _Course:
    """A touch, millisecond by millisecond."""

    z: list[float]
    goal: list[float]
    strain: list[float]  # N, of the right finger
    load: list[float]  # N, of both fingers


def touch(
    period: int = PERIOD,
    bandwidth: float = BANDWIDTH,
    speed: float = SPEED,
    limit: int = LIMIT,
    phase: float = 0.0,
) -> Touch:
    """Let the hand descend on a block, and stop the hand as the real-time level does. When a reading of the sensors
    shows that a gauge is beyond its limit, the present position becomes the goal.

    The guard is set only when the jolt at the start of the motion has died away, so that only the block can trip the
    guard. `Touch.trips` says whether the jolt would trip the guard in the air if the guard were set before the start.

    Raises:
        BadArgument: a value is out of range.
    """
    _check("the period", period, PERIODS, "ms")
    _check("the bandwidth", bandwidth, BANDWIDTHS, "Hz")
    _check("the speed", speed, SPEEDS, "mm/s")
    _check("the limit", limit, LIMITS, "grams")
    _check("the phase", phase, (0.0, 0.999), "periods")
    v, lag = speed * MILLIMETRE, 2 * _DAMPING / (2 * pi * bandwidth)
    cycles = ceil((_START + 3 / (2 * pi * bandwidth)) / (period * _MS))  # cycles before the contact
    contact = cycles * period * _MS + phase * period * _MS  # s: time at which the slide reaches the block
    bench = Bench(_model(round(bandwidth, 3)))
    far = _REACH - _BLOCK - v * (contact - lag)
    bench.data.joint("z").qpos[0] = far
    mujoco.mj_forward(bench.model, bench.data)
    servo = BenchAxes(bench, AXES[1:2], period=period * _MS)
    course, frozen, noticed = _Course([], [], [], []), False, None
    goal, jolt = far, 0.0
    for cycle in range(cycles + 1 + ceil(_AFTER / (period * _MS))):
        strain = -STIFFNESS * float(bench.data.sensor("right_z").data[0])
        reading = min(max(round(strain / RESOLVED) * RESOLVED, -STRAINED), STRAINED)
        if cycle < cycles:
            jolt = max(jolt, *(abs(each) for each in course.strain[-period:]), 0.0)
        elif not frozen and abs(reading) > limit * GRAM_FORCE:
            frozen, noticed = True, cycle * period * _MS - contact
            goal = float(bench.data.joint("z").qpos[0])
        if not frozen:
            goal = min(goal + v * period * _MS, _REACH)
        servo.put(np.array([goal]))
        for _ in range(period):
            bench.advance(_MS)
            data = bench.data
            course.z.append(float(data.joint("z").qpos[0]))
            course.goal.append(float(data.ctrl[bench.model.actuator("z").id]))
            course.strain.append(-STIFFNESS * float(data.sensor("right_z").data[0]))
            course.load.append(
                -STIFFNESS * float(data.sensor("right_z").data[0] + data.sensor("left_z").data[0])
            )
    surface, count = _REACH - _BLOCK, len(course.z)
    times = [round(ms + 1 - contact / _MS, 2) for ms in range(count)]
    kept = [n for n in range(count) if times[n] >= -_BEFORE]
    return Touch(
        period=period, bandwidth=bandwidth, speed=speed, limit=limit, phase=phase, jolt=round(jolt, 3),
        noticed=None if noticed is None else round(noticed / _MS, 2),
        way=round((max(course.z) - surface) / MILLIMETRE, 3),
        force=round(max(course.load), 2),
        times=tuple(times[n] for n in kept),
        places=tuple(round((course.z[n] - surface) / MILLIMETRE, 3) for n in kept),
        goals=tuple(round((course.goal[n] - surface) / MILLIMETRE, 3) for n in kept),
        forces=tuple(round(course.load[n], 2) for n in kept),
        readings=tuple(
            round(at, 2)
            for cycle in range(count // period)
            if (at := cycle * period - contact / _MS) >= -_BEFORE
        ),
    )  # fmt: skip


def worst(period: int, bandwidth: float, speed: float, limit: int = LIMIT) -> Touch:
    """Simulate contacts at four phases of the period, and return the touch with the greatest force."""
    found = [touch(period, bandwidth, speed, limit, n / PHASES) for n in range(PHASES)]
    return max(found, key=lambda each: each.force)


def lines(found: Touch) -> list[str]:
    """Describe a touch in lines of text."""
    grams = found.jolt / GRAM_FORCE
    air = "so the guard would trip in the air" if found.trips else "less than the limit"
    when = "never" if found.noticed is None else f"{found.noticed:.1f} ms after the contact"
    return [
        f"sensors read every {found.period} ms, servo of {found.bandwidth:g} Hz, {found.speed:g} mm/s, "
        f"limit {found.limit} g on a finger",
        "",
        f"start of the motion    the finger feels up to {found.jolt:.2f} N ({grams:.0f} g), {air}",
        f"limit noticed          {when}",
        f"the slide goes on by   {found.way:.2f} mm",
        f"greatest force         {found.force:.1f} N on both fingers",
    ]


def _check(what: str, value: float, span: tuple[float, float], unit: str) -> None:
    if not span[0] <= value <= span[1]:
        raise BadArgument(f"{what} must be from {span[0]:g} to {span[1]:g} {unit}, not {value:g}")


@lru_cache(maxsize=8)
def _model(bandwidth: float) -> mujoco.MjModel:
    """Return the scene of the arm over a block. The servo of the z slide has the bandwidth `bandwidth` (Hz)."""
    spec = scene(ArmWorld(), wand=False)
    half = _BLOCK / 2
    spec.worldbody.add_geom(
        name="block", type=mujoco.mjtGeom.mjGEOM_BOX, size=[0.04, 0.04, half], pos=[0, 0, half], group=1
    )
    w = 2 * pi * bandwidth
    servo = spec.actuator("z")
    stiffness, damping = _CARRIED * w**2, 2 * _DAMPING * w * _CARRIED - _DRAG
    servo.gainprm[0] = stiffness
    servo.biasprm[1], servo.biasprm[2] = -stiffness, -damping
    return spec.compile()
