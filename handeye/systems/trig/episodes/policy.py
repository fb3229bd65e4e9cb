"""The taught program as a policy: it acts only through the action space, and knows only what the observations say."""

from copy import deepcopy

import numpy as np

from handeye.core.errors import Refused
from handeye.core.pose import Array
from handeye.env.policies import Episode, Policy
from handeye.env.spaces import encoded
from handeye.machines.purbrick import PURBRICK
from handeye.ports.axes import Axes, AxesReading, AxisSpec, Channel
from handeye.ports.clock import Clock
from handeye.systems.trig.episodes.job import BLOCKS
from handeye.systems.trig.episodes.machine import MOVES, TaughtFacts
from handeye.systems.trig.language.axes_arm import AxesArm
from handeye.systems.trig.language.running import Interpreter


class TaughtPolicy(Policy):
    """Runs the taught program from its first step. If the arm cannot reach a place, the arm stands still until the
    time limit.
    """

    facts: TaughtFacts
    actions = ("hand",)
    environments = (BLOCKS.id,)

    def play(self, episode: Episode) -> None:
        axes = _SeenAxes(episode)
        arm = AxesArm(axes, axes.clock, PURBRICK.limits, ready=True)
        arm.remember(self.facts.arm)
        program = deepcopy(self.facts.program)
        try:
            Interpreter(program=program, arm=arm, halted=lambda: False, refresh=lambda: None).run()
        except Refused:
            return
        axes.clock.step(axes.goal, done=True)


class _SeenAxes(Axes):
    """The arm as the observations show it."""

    name = PURBRICK.name

    def __init__(self, episode: Episode) -> None:
        self._episode, self.clock = episode, _SeenClock(episode, self)
        self.goal: Array = episode.observation["goal"]

    @property
    def specs(self) -> tuple[AxisSpec, ...]:
        return (*PURBRICK.axes, PURBRICK.hand)

    @property
    def channels(self) -> tuple[Channel, ...]:
        return (PURBRICK.force,)

    @property
    def period(self) -> float:
        return self._episode.facts.period

    def read(self) -> AxesReading:
        seen = self._episode.observation
        force = dict(zip(PURBRICK.force.parts, map(float, seen["force"]), strict=True))
        return AxesReading(
            time=float(seen["clock"][0]), q=np.concatenate((seen["q"], seen["gap"])), channels=force
        )

    def put(self, goal: Array) -> None:
        self.goal = goal


class _SeenClock(Clock):
    """The clock of an episode. Each period that passes is a step of the environment."""

    def __init__(self, episode: Episode, axes: _SeenAxes) -> None:
        self._episode, self._axes = episode, axes

    @property
    def now(self) -> float:
        return float(self._episode.observation["clock"][0])

    def advance(self, seconds: float) -> None:
        for _ in range(round(seconds / self._axes.period)):
            self.step(self._axes.goal)

    def step(self, goal: Array, *, done: bool = False) -> None:
        """Move the set-points to a goal in one step."""
        moved = goal - self._episode.observation["goal"]
        values = dict(zip(MOVES, map(float, moved), strict=True)) | {"done": float(done)}
        self._episode.step(encoded(self._episode.facts.components, values))
