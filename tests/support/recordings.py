"""A short made-up run to record: three stages, a moving body, a picture, an error, a search."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import NDArray

from handeye.al import compile_text
from handeye.arm.robots.stanford import STANFORD
from handeye.core.pose import Array
from handeye.core.source import Source
from handeye.core.units import JIFFY
from handeye.core.variation import WorldSpec
from handeye.execution.servo import ServoPeriod
from handeye.planfile.plan import Plan
from handeye.planfile.store import encode, plan_digest
from handeye.planning.planner import make_plan
from handeye.ports.camera import Picture, Renderer
from handeye.ports.workcell import Sensed
from handeye.program import events as happened
from handeye.program.events import Event, RunStarted, StageFinished
from handeye.program.guards import GuardKind
from handeye.program.taught import Taught
from handeye.touch.guards import ActiveGuard
from handeye.trace.frames import Frames
from handeye.trace.messages import Poses
from handeye.trace.recorder import PictureSource, Recorder
from handeye.vision.marks import GREEN, RED, Disc, Line, Loop, Mark

SCRIPT: Final = 'STAGE "open"\nOPEN 1\nSTAGE "close"\nCLOSE .1\nSTAGE "again"\nOPEN 2\n'
GUARD: Final = ActiveGuard(guard=GuardKind.FORCE, limit=8.0, axis=np.array([0.0, 0.0, -1.0]))
MARKS: Final[tuple[Mark, ...]] = (
    Loop(points=((1.0, 0.0), (4.0, 0.0), (4.0, 3.0), (1.0, 3.0)), colour=RED),
    Line(ends=((1.0, 1.0), (4.0, 2.0)), colour=RED),
    Disc(centre=(2.5, 1.5), colour=GREEN, diameter=2.0),
)
"""The marks for the findings in the picture."""
BODIES: Final = ("base", "finger", "screw", "carrier")


@cache
def plan() -> Plan:
    """A plan of three steps."""
    program, _ = compile_text(Source(name="short.al", text=SCRIPT), Taught(positions={}, parts={}))
    assert program is not None
    made, _ = make_plan(program, STANFORD, task="water_pump")
    assert made is not None
    return made


PLAN: Final = encode(plan()).encode()


class FakeFrames(Frames):
    """Bodies at the places that a test gives them. At first, the carrier is hidden."""

    def __init__(self) -> None:
        self.names = BODIES
        self.joints = tuple(joint.name for joint in STANFORD.joints)
        self.now = np.tile(np.float32([0, 0, 0, 1, 0, 0, 0]), (len(BODIES), 1))
        self.carrier_shown = False

    def poses(self) -> Poses:
        return self.now.copy()

    def there(self) -> NDArray[np.bool_]:
        return np.array([True, True, True, self.carrier_shown])

    def scene(self, time: int) -> bytes:
        return b""


@dataclass(frozen=True)
class Moment:
    """An event or a servo period, with the poses of the bodies at that time."""

    what: Event | Sensed
    poses: Poses
    carrier_shown: bool
    effort: Array = field(default_factory=lambda: np.zeros(6))
    picture: Picture | None = None
    guarded: bool = False

    @property
    def period(self) -> ServoPeriod:
        """The servo period. If it is guarded, its sensed force is the commanded torque, so that it is not zero."""
        assert isinstance(self.what, Sensed)
        felt = {"wrench": -self.effort, "guards": (GUARD,)} if self.guarded else {}
        return ServoPeriod(sensed=self.what, effort=self.effort, **felt)


class _Clock:
    """Makes the moments of a run, in order."""

    def __init__(self) -> None:
        self.time = 0.0
        self.rng = np.random.default_rng(1973)
        self.poses = FakeFrames().now
        self.shown = False

    @property
    def now(self) -> float:
        return round(self.time, 6)

    def event(self, kind: Callable[..., Event], shot: Picture | None = None, **fields: object) -> Moment:
        return Moment(kind(time=self.now, **fields), self.poses.copy(), self.shown, picture=shot)

    def ticks(self, count: int, *, guarded: bool = False) -> Iterator[Moment]:
        for _ in range(count):
            self.time += JIFFY
            self.poses[1, :3] += np.float32(self.rng.normal(0, 1e-3, 3))
            if self.shown:
                self.poses[2, 2] -= np.float32(1e-4)  # a hidden body still moves a little
            q, qd, effort = self.rng.normal(size=(3, 6))
            sensed = Sensed(
                time=self.time, q=q, qd=qd, gap=0.02, touch=(False, False), tool_torque=0.0, braked=False
            )
            yield Moment(sensed, self.poses.copy(), self.shown, effort, guarded=guarded)


def started(time: float = 0.0) -> RunStarted:
    """The beginning of the run."""
    return RunStarted(
        time=time, program="short", steps=3, plan=plan_digest(plan()), arm=STANFORD.name, arm_digest="0" * 16,
        world=WorldSpec(seed=7), camera=Renderer(method="none"), versions={"handeye": "0", "mujoco": "4"},
    )  # fmt: skip


def history() -> list[Moment]:
    """The whole run."""
    clock = _Clock()
    hand = {"hand": (0.1, 0.2, 0.3), "planned": (0.1, 0.2, 0.35), "gap": 0.02}
    moments = [Moment(started(), clock.poses.copy(), False)]
    for number, stage in enumerate(("open", "close", "again")):
        moments += [clock.event(happened.StageStarted, stage=stage)]
        for place in range(3):
            moments += [clock.event(happened.StepStarted, step=number, line=2 + 2 * number, text="OPEN 1")]
            moments += clock.ticks(2)
            moments += clock.ticks(4, guarded=True)
            moments += [clock.event(happened.GuardTripped, guard="force", value=9.0, limit=8.0)]
            if stage == "close" and place == 2:
                clock.shown = True  # the screw has become part of a thread
                clock.poses[2, 2] = -2.0
            moments += clock.ticks(2)
            moments += [clock.event(happened.StepFinished, step=number, **hand)]
        if stage == "close":
            picture = clock.rng.integers(0, 16, (4, 6), dtype=np.uint8)
            moments += [clock.event(happened.PictureTaken, picture, picture="WIDE", lens=0.025)]
        if stage == "again":
            moments += [clock.event(happened.PartSeen, part="BASE", x=0.5, y=0.6, yaw=None)]
        moments += [clock.event(StageFinished, stage=stage, status="done")]
    return [*moments, clock.event(happened.RunFinished, completed=True)]


HISTORY: Final = history()
EVENTS: Final = [moment.what for moment in HISTORY if isinstance(moment.what, Event)]
BOUNDARIES: Final = [0, *(n for n, event in enumerate(EVENTS, 1) if isinstance(event, StageFinished))]
"""Numbers of events at which a checkpoint is written."""


@dataclass
class Recording:
    """A recorder in use, and the objects that it records."""

    path: Path
    frames: FakeFrames = field(default_factory=FakeFrames)
    pictures: dict[str, Picture] = field(default_factory=dict)
    recorder: Recorder = field(init=False)

    @property
    def looks(self) -> PictureSource:
        return PictureSource(picture=self.pictures.__getitem__, found=lambda: ("WIDE", MARKS))

    @property
    def part(self) -> Path:
        return self.path.with_name(self.path.name + ".part")

    def begin(self) -> "Recording":
        self.recorder = Recorder(self.path, self.frames, self.looks, PLAN)
        return self

    def resume(self, events: int) -> "Recording":
        prefix = EVENTS[:events]
        self.recorder = Recorder.resumed(self.path, self.frames, self.looks, PLAN, events, prefix)
        return self

    def play(self, first: int = 0, last: int = len(EVENTS)) -> "Recording":
        """Record what happens after event number `first`, up to event number `last`."""
        for moment in between(first, last):
            self.frames.now, self.frames.carrier_shown = moment.poses, moment.carrier_shown
            if isinstance(moment.what, happened.PictureTaken):
                assert moment.picture is not None
                self.pictures[moment.what.picture] = moment.picture
            if isinstance(moment.what, Sensed):
                self.recorder.tick(moment.period)
            else:
                self.recorder.event(moment.what)
            if isinstance(moment.what, StageFinished):
                self.recorder.flush()
        return self

    def kill(self) -> "Recording":
        """Kill the program. What it has not passed to the operating system is lost."""
        self.recorder._writing.file.release()
        return self

    def close(self) -> bytes:
        self.recorder.close()
        return self.path.read_bytes()


def between(first: int, last: int) -> list[Moment]:
    """The moments after event number `first`, up to event number `last`."""
    places = [place for place, moment in enumerate(HISTORY) if isinstance(moment.what, Event)]
    start = places[first - 1] + 1 if first else 0
    return HISTORY[start : places[last - 1] + 1]


def record(path: Path) -> bytes:
    """The bytes of the trace of the whole run."""
    return Recording(path).begin().play().close()
