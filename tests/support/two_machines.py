"""A system of two machines on one bench that work and rest: a gripper of two motors (10 ms), a pusher (1/60 s)."""

from collections.abc import Mapping
from typing import Literal

import msgspec
import mujoco
import numpy as np
from toy_system import Line, Lines

from handeye.cell.bench import Bench
from handeye.cell.bench_axes import BenchAxes, BenchOutputs, sensor, switch
from handeye.cell.snapshot_cell import SnapshotCell
from handeye.core.entries import Entry, register
from handeye.core.mutable_records import put_back
from handeye.core.variation import Variation, WorldSpec
from handeye.execution.scheduler import Task, run
from handeye.execution.servo import ServoPeriod
from handeye.judge.finding import Findings
from handeye.planfile.store import written_digest
from handeye.ports.axes import AxisSpec, Channel
from handeye.ports.camera import Renderer
from handeye.ports.workcell import sense_axes
from handeye.program.events import (
    RunFinished,
    RunStarted,
    StageFinished,
    StageStarted,
    StepFinished,
    StepStarted,
)
from handeye.program.system_state import SystemState
from handeye.runs.setup import Setup
from handeye.runs.snapshot import Checkpoint
from handeye.runs.system import RunCallbacks, RunningSystem, System
from handeye.tasks.interface import AnyTask, Words

SCENE = """<mujoco><option timestep=".00083333333333" integrator="implicitfast"><flag sleep="enable"/></option>
<default><geom group="2" density="2700"/><position kp="2000" kv="80"/></default>
<worldbody><camera name="studio" pos="0 -1 .3" xyaxes="1 0 0 0 .3 1"/><light pos="0 0 2"/>
<body name="wall" pos=".15 0 0"><geom type="box" size=".01 .1 .1"/></body>
<body name="carriage" gravcomp="1"><joint name="x" type="slide" axis="1 0 0" damping="5"/>
 <geom type="box" size=".02 .02 .02"/>
 <geom name="pad" type="sphere" pos=".03 0 0" size=".01"/><site name="pad" pos=".03 0 0" size=".012"/>
 <body name="one" pos="0 0 -.05" gravcomp="1"><joint name="one" type="slide" axis="0 1 0" damping="5"/>
  <geom type="box" pos="0 .03 0" size=".005 .005 .02"/></body>
 <body name="other" pos="0 0 -.05" gravcomp="1"><joint name="other" type="slide" axis="0 -1 0" damping="5"/>
  <geom type="box" pos="0 -.03 0" size=".005 .005 .02"/></body></body>
<body name="pusher" pos="-.4 0 0" gravcomp="1"><joint name="push" type="slide" axis="1 0 0" damping="5"/>
 <geom type="box" size=".02 .02 .02"/><site name="eye" pos=".021 0 0" zaxis="1 0 0"/></body>
</worldbody>
<actuator><position name="x" joint="x"/><position name="one" joint="one"/><position name="other" joint="other"/>
 <position name="push" joint="push"/></actuator>
<sensor><touch name="pad" site="pad"/><rangefinder name="range" site="eye"/></sensor></mujoco>"""


def slide(name: str, force: float | None = None) -> AxisSpec:
    return AxisSpec(name=name, kind="prismatic", lower=-0.2, upper=0.2, speed=0.2, force=force)


class Work(Lines, frozen=True, kw_only=True):
    """A program: one line for each piece of work."""

    name: str = "machines"
    stages: tuple[str, ...] = ("hour",)
    task: str = "bench"


class Rest(SystemState, kw_only=True):
    """The state of the system, which is only the place in its program."""


class TwoMachines(RunningSystem):
    """WORK: both machines go there and back in a second. REST n: n seconds pass."""

    trouble = None
    joints = ("x", "one", "other", "push")

    def __init__(self, setup: Setup, around: RunCallbacks) -> None:
        self._setup, self._around, self._state = setup, around, Rest(at=0)
        self.bench = bench = Bench(mujoco.MjModel.from_xml_string(SCENE))
        touched = {Channel(name="pad"): switch("pad"), Channel(name="ever", latched=True): switch("pad")}
        jaws = [slide("one", 10.0), slide("other", 10.0)]
        self.gripper = BenchAxes(bench, [slide("x"), *jaws], period=0.01, name="gripper", channels=touched)
        range_channel = {Channel(name="range", unit="m"): sensor("range")}
        self.pusher = BenchAxes(bench, [slide("push")], period=1 / 60, name="pusher", channels=range_channel)
        self.lamps: list[float] = []
        self.outputs = BenchOutputs(bench, "lamps", {"lamp": self.lamps.append})
        self.rings = 0
        bench.handlers["bell"] = self._ring
        self._cell = bench.cell()
        self._sensed = sense_axes([self.gripper, self.pusher])
        bench.after_period.append(self._tell)

    def _ring(self) -> None:
        self.rings += 1
        self.bench.call_at(round(self.bench.now * 1e6) + 600_000_000, "bell")

    def _tell(self) -> None:
        self._sensed = sensed = sense_axes([self.gripper, self.pusher], self._sensed)
        self._around.watch(ServoPeriod(sensed=sensed, effort=np.zeros(len(sensed.q))))

    @property
    def state(self) -> Rest:
        return self._state

    @property
    def cell(self) -> SnapshotCell:
        return self._cell

    @property
    def channels(self) -> tuple[Channel, ...]:
        return tuple(sense_axes([self.gripper, self.pusher]).channels)

    @property
    def time(self) -> float:
        return self.bench.now

    def begin(self) -> list[RunStarted | StageStarted]:
        steps, plan = self._setup.plan.steps, written_digest(msgspec.json.encode(self._setup.plan))
        self.bench.call_at(0, "bell")
        begun = RunStarted(
            system="machines", time=0.0, program="machines", steps=len(steps), plan=plan, arm="both", arm_digest="",
            world=self._setup.world, task="bench", camera=Renderer(method="none"), versions={},
        )  # fmt: skip
        return [begun]

    def step(self) -> None:
        at, lines = self._state.at, self._setup.plan.steps
        assert at is not None
        if self._state.stage is None:
            self._state.stage = 0
            self._around.emit(StageStarted(time=self.time, stage="hour"))
        self._around.emit(StepStarted(time=self.time, step=at, line=at + 1, text=lines[at].text))
        word, *seconds = lines[at].text.split()
        if word == "WORK":
            self.outputs.set("lamp", 1.0)
            run(self.bench, [self._go(self.gripper, (0.12, -0.01, -0.01)), self._go(self.pusher, (0.1,))])
            self.outputs.set("lamp", 0.0)
        else:
            self.bench.advance(float(seconds[0]))
        self._around.emit(StepFinished(time=self.time, step=at, hand=None, planned=None, gap=None))
        self._state.at = lines[at].ways[0]
        if self._state.at is None:
            self._around.emit(StageFinished(time=self.time, stage="hour", status="done"))
            self._state.stage = None

    def _go(self, machine: BenchAxes, far: tuple[float, ...]) -> Task[None]:
        """Move a machine there and back in a second, with one goal for each period."""
        periods = round(1 / machine.period)
        for period in range(1, periods + 1):
            machine.put(np.sin(np.pi * period / periods) * np.array(far))
            yield machine.period

    def finish(self) -> bool:
        self._around.emit(RunFinished(time=self.time, completed=True))
        return True

    def restore(self, state: SystemState) -> None:
        put_back(self._state, state)
        self._sensed = sense_axes([self.gripper, self.pusher])


class MachinesSystem(System):
    """Two machines on a bench."""

    name, plan, state = "machines", Work, Rest

    def encode(self, plan: Work) -> bytes:
        return msgspec.json.encode(plan)

    def decode(self, data: bytes, name: str) -> Work:
        return msgspec.json.decode(data, type=Work)

    def listing(self, plan: Work) -> Work:
        return plan

    def machine(self, plan: Work) -> tuple[str, str]:
        return "both", ""

    def build(self, setup: Setup, around: RunCallbacks) -> TwoMachines:
        return TwoMachines(setup, around)


class BenchTask(AnyTask):
    """A task in which nothing is required of the two machines."""

    name, words = "bench", Words(product="the bench", done="Both machines stand.")

    @property
    def joint_kinds(self) -> Mapping[str, Literal["revolute", "prismatic"]]:
        return dict.fromkeys(TwoMachines.joints, "prismatic")

    def variation(self) -> Variation:
        return Variation()

    def scene(self, spec: WorldSpec) -> mujoco.MjModel:
        return mujoco.MjModel.from_xml_string(SCENE)

    def judge(self, truth: object) -> Findings:
        return {}


MACHINES, BENCH = MachinesSystem(), BenchTask()
ENTRY = Entry(
    name="machines", title="the two machines", help="Work and rest.", system="two_machines:MACHINES",
    tasks={"bench": "two_machines:BENCH"},
)  # fmt: skip
register(ENTRY)


def begin_hour() -> Checkpoint:
    """An hour that has not begun: a second of work, half an hour of rest, and both once more."""
    texts = ("WORK", "REST 1799", "WORK", "REST 1799")
    steps = tuple(
        Line(stage=0, line=number, text=text, ways=(number if number < len(texts) else None,))
        for number, text in enumerate(texts, 1)
    )
    plan = Work(steps=steps)
    return Checkpoint(setup=Setup(system="machines", plan=plan, world=WorldSpec(seed=0), camera="ray"))
