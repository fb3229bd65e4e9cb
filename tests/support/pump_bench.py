"""A work cell that the experimenter has arranged, and a short program that is executed in it. Before a run begins, the
experimenter may place parts by writing the simulator's state. During the run, the experimenter touches nothing, unless
the test says so.
"""

import pickle
import re
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from typing import Final, TypeVar

import mujoco
import numpy as np
import pytest
from driving import Drive, tick
from kept_measurements import Measurements

from handeye.al import compile_text
from handeye.arm.robots.stanford import STANFORD
from handeye.cell.compiled_arm import CompiledArm
from handeye.cell.simulated import SimulatedCell
from handeye.core.pose import Array, Pose, planar, pose, translated
from handeye.core.resources import plans
from handeye.core.source import Source
from handeye.core.units import DEGREE, INCH
from handeye.execution.context import ExecutionContext
from handeye.execution.executor import Executor
from handeye.execution.friction_measurement import measure_joints
from handeye.planning.planner import make_plan
from handeye.program.diagnosis.cause_text import call_sentence
from handeye.program.events import ErrorRaised, Event, OperatorCalled, SearchAdvanced
from handeye.program.program import Part, Position
from handeye.program.taught import Taught, load_taught
from handeye.tasks.stanford_cell.dimensions import base_top, dimensions, screw_holes, standard
from handeye.tasks.water_pump.cell import build_cell
from handeye.tasks.water_pump.world.nominal import DRAWING
from handeye.tasks.water_pump.world.pump_world import Placing, PumpWorld

Kind = TypeVar("Kind", bound=Event)

TAUGHT: Final = load_taught(plans() / "water_pump.toml")
"""Positions and parts of the water-pump program."""

INSERT: Final = """
        MOVE  P              ;GO TO THE PIN
        CLOSE 0.1            ;grasp it
        MOVE  T              ;GO TO THE HOLE
        SEARCH .07
L1:     MOVE  T              ;GO TO THE HOLE
        STOP  [0 0 -50]
        CHANGE [0 0 -1] 0.6  ;TRY TO GO DOWN WITHOUT MEETING RESISTANCE
        SKIPE 23
        AOJ   L1
        STOP  [0 0 -60]
        CHANGE [0 0 -1] 0.6  ;IT SHOULD MEET SOME RESISTANCE
        SKIPN 23
        AOJ   L1
        SAVE  H
        OPEN  .5
        CLOSE 0.1            ;AND CHECK THAT IT IS STILL THERE
        OPEN  1
"""
"""The pin-insertion listing of 1973, reference 3.6, with the taught names P and T."""


SCRIPT: Final = (plans() / "water_pump.al").read_text(encoding="utf-8")
"""The water-pump program."""


MACROS: Final = SCRIPT[: SCRIPT.index("        STAGE")]
"""The macros that its stages share."""


def stage(*names: str) -> str:
    """The text of some stages of the water-pump program, after its macros."""
    texts = dict(re.findall(r'STAGE\s+"([^"]+)"\n(.*?)(?=\n\s+STAGE|\Z)', SCRIPT, re.DOTALL))
    return MACROS + "\n".join(f'STAGE "{name}"\n{texts[name]}' for name in names)


def without(word: str, script: str) -> str:
    """A script without the lines that begin with an instruction."""
    return re.sub(rf"(?m)^\s*{word}\b.*\n", "", script)


_MEASURED: Final = Measurements()
"""What the arm has measured of its joints in drawn worlds, with parts laid as they were."""
LAID: Final = 1.81
"""Height (in) of the gasket on the base, where closed fingers feel it."""
SEEDS: Final = (None, 1)
"""Worlds in which a claim is tested that holds in every world: the world without errors, and the worlds of some seeds.
"""
IN_WORLDS: Final = pytest.mark.parametrize(
    "seed", SEEDS, ids=lambda seed: "nominal" if seed is None else f"seed {seed}"
)
"""Tests a claim in each of these worlds."""
COUNT: Final = {"nominal": SEEDS.count(None), "drawn": len(SEEDS) - SEEDS.count(None)}
"""Their number, for the mark of a row."""


def world_of(seed: int | None) -> PumpWorld:
    """The world without errors, or the drawn one of a seed."""
    return PumpWorld.nominal() if seed is None else PumpWorld.sample(seed)


SEATED: Final = 1.75
"""Height (in) of a seated pin's shoulder over the underside of the base: on the mouth of its hole."""


@dataclass(slots=True, kw_only=True)
class Bench:
    """A cell, a program in it, and everything that happened."""

    cell: SimulatedCell
    executor: Executor
    events: list[Event]
    first: dict[str, Array]
    """Places of the bodies before the run, in inches."""

    # -- the run ------------------------------------------------------------------------------------

    def go(self, until: Callable[[], bool] = lambda: False) -> "Bench":
        """Execute steps until the program ends or calls the operator, or until `until` returns True."""
        while self.executor.state.at is not None and not until():
            self.executor.step()
        return self

    def to(self, word: str) -> "Bench":
        """Execute steps until the text of the next step begins with `word`."""
        return self.go(lambda: self.text.startswith(word))

    @property
    def text(self) -> str:
        """The statement to be done next."""
        assert self.executor.state.at is not None
        return self.run.plan.program.steps[self.executor.state.at].text

    @property
    def run(self) -> ExecutionContext:
        return self.executor.run

    # -- what happened ------------------------------------------------------------------------------

    def all(self, kind: type[Kind]) -> list[Kind]:
        """Events of a kind, in order."""
        return [event for event in self.events if isinstance(event, kind)]

    @property
    def errors(self) -> list[int]:
        return [event.number for event in self.all(ErrorRaised)]

    @property
    def tries(self) -> int:
        """Places at which the last search tried."""
        searched = self.all(SearchAdvanced)
        return searched[-1].count + 1 if searched else 1

    @property
    def finished(self) -> bool:
        """The program finished."""
        return self.executor.state.at is None and self.executor.state.stopped is None

    @property
    def told(self) -> str:
        """The message to the operator."""
        return call_sentence(self.called.message, self.called.error, self.called.cause)

    @property
    def called(self) -> OperatorCalled:
        """The call to the operator."""
        assert self.executor.state.stopped is not None, self.events[-5:]
        return self.executor.state.stopped

    def saved(self, name: str) -> Array:
        """A saved difference in inches."""
        return self.run.state.saved[name] / INCH

    # -- the true state ----------------------------------------------------------------------------

    def place(self, body: str) -> Array:
        """True position of a body, in inches; shape (3,), W."""
        return np.array(self.cell.truth.data.body(body).xpos) / INCH

    def pose(self, body: str) -> Pose:
        """`X_WP` of a body."""
        found = self.cell.truth.data.body(body)
        return pose(found.xmat.reshape(3, 3).copy(), found.xpos.copy())

    def moved(self, body: str) -> float:
        """How far a body has moved sideways since the run began, in inches."""
        return float(np.hypot(*(self.place(body) - self.first[body])[:2]))

    def hand(self) -> Array:
        """True position of the point midway between the finger tips, in inches; shape (3,), W."""
        return np.array(self.cell.truth.data.site("stanford/tool").xpos) / INCH

    def flick(self, body: str, force: tuple[float, float, float], seconds: float = 0.1) -> "Bench":
        """Push a body for a moment with a force (N), and wait until the body is at rest."""
        truth = self.cell.truth
        index = truth.model.body(body).id
        truth.data.xfrc_applied[index, :3] = force
        self.rest(seconds)
        truth.data.xfrc_applied[index] = 0.0
        return self.rest(0.5)

    def rest(self, seconds: float = 0.1) -> "Bench":
        """Let time pass, brakes on."""
        self.run.drive.brake(seconds)
        return self


def bench(
    script: str,
    *,
    world: PumpWorld | None = None,
    positions: dict[str, Position] | None = None,
    parts: dict[str, Part] | None = None,
    lay: dict[str, Pose] | None = None,
    felt: dict[str, float] | None = None,
    camera: str = "ray",
) -> Bench:
    """Return a cell with a script compiled for it, ready to run.

    Args:
        positions: taught positions besides those of the water-pump program.
        parts: parts as the program believes them, instead of the water pump's.
        lay: where the experimenter lays free bodies (`X_WP`) before the run begins.
        felt: heights of the hand (in) that earlier stages would have saved, besides that of the table.
    """
    taught = Taught(
        positions={**TAUGHT.positions, **(positions or {})}, parts={**TAUGHT.parts, **(parts or {})}
    )
    program, diagnostics = compile_text(Source(name="test.al", text=script), taught)
    assert program is not None, diagnostics
    plan, problems = make_plan(program, STANFORD, task="water_pump")
    assert plan is not None, problems
    cell = build_cell(world or PumpWorld.nominal(), camera=camera)
    for part, X_WP in (lay or {}).items():
        put(cell, part, X_WP)
    settle(cell)
    events: list[Event] = []
    run = ExecutionContext(
        plan=plan, arm=STANFORD, cell=cell.devices, camera=DRAWING, emit=events.append, arithmetic=CompiledArm
    )
    if program.feels and world is not None and world.arm_build.friction.any():
        _MEASURED.behind(pickle.dumps(world), cell, run, partial(_measure, run))
    heights = {"TABLE": 0.0} | (felt or {})
    run.state.heights.update({name: height * INCH for name, height in heights.items()})
    first = {name: np.array(cell.truth.data.body(name).xpos) / INCH for name in ("base", "top", "pin0")}
    return Bench(cell=cell, executor=Executor(run=run), events=events, first=first)


def _measure(run: ExecutionContext) -> float:
    """Measure the joints, as a run does."""
    found = measure_joints(run.cell, STANFORD, run.state.drive, arithmetic=CompiledArm)
    run.state.drive.friction, run.state.drive.links = found.friction, found.links
    return 0.0


def put(cell: SimulatedCell, part: str, X_WP: Pose) -> None:
    """Place a free body at a pose, at rest."""
    quat = np.zeros(4)
    mujoco.mju_mat2Quat(quat, X_WP[:3, :3].ravel())
    joint = cell.truth.data.joint(part)
    joint.qpos, joint.qvel = [*X_WP[:3, 3], *quat], 0.0
    mujoco.mj_forward(cell.truth.model, cell.truth.data)


def settle(cell: SimulatedCell) -> None:
    """Let a tenth of a second pass with the brakes set. The placed parts come to rest, and the sensors are read."""
    gap = cell.devices.sense().gap
    tick(cell.devices, Drive(gap=gap, grip=80.0), ticks=6)


def at_standard(x: float = 0.0, y: float = 0.0, turn: float = 0.0) -> dict[str, Pose]:
    """The base in its standard position, or off it (in, degrees)."""
    return {"base": translated(standard(), (x * INCH, y * INCH, 1e-5)) @ planar(0, 0, 0, turn * DEGREE)}


def stacked(x: float = 0.0, y: float = 0.0, turn: float = 0.0) -> dict[str, Pose]:
    """Base, gasket and top in their places, or off them (in, degrees), held together by the two pins, without
    screws.
    """
    X_WP, seat = at_standard(x, y, turn)["base"], base_top()
    lay = {"base": X_WP, "gasket": X_WP @ planar(0, 0, seat, 0)}
    lay["top"] = X_WP @ planar(0, 0, seat + dimensions()("gasket.thickness"), 0)
    for pin, hole in zip(
        ("pin0", "pin1"), (int(k) for k in dimensions().all("base.screw_holes.pinned")), strict=True
    ):
        lay[pin] = X_WP @ planar(*screw_holes()[hole], SEATED * INCH, 0)
    return lay


def base_off(x: float, y: float, seed: int | None = None) -> PumpWorld:
    """The world without errors, or the world of a seed, with the base on the belt as planned, except for its place
    (in).
    """
    base, world = PumpWorld.nominal().base, world_of(seed)
    return replace(world, base=Placing(x=base.x + x * INCH, y=base.y + y * INCH, yaw=base.yaw))


def shifted(name: str, x: float = 0.0, y: float = 0.0, z: float = 0.0) -> Position:
    """A taught position of the water-pump program moved by inches in W."""
    position = TAUGHT.positions[name]
    turned = position.of == "PUMP"  # stands turned half round
    px, py, pz, o, a, t = position.at
    sign = -1 if turned else 1
    at = (px + sign * x * INCH, py + sign * y * INCH, pz + z * INCH, o, a, t)
    return Position(at=at, of=position.of)


def written(x: float, y: float, z: float, o: float, a: float = 90.0, t: float = 0.0) -> Position:
    """A hand position in table inches and degrees."""
    return Position(at=(x * INCH, y * INCH, z * INCH, o * DEGREE, a * DEGREE, t * DEGREE))
