"""The environment: one job in many worlds; each step is one control period of the job's machine."""

from collections.abc import Mapping
from typing import Any, Final, cast

import gymnasium
import numpy as np

from handeye.api.worlds import World
from handeye.core.distributions import random_numbers
from handeye.core.errors import BadArgument, NoSuchName, PhysicsFailed, Refused
from handeye.core.faults import Fault
from handeye.core.plain_text import counted
from handeye.core.pose import Array
from handeye.core.variation import Level, WorldSpec, checked_seed
from handeye.env.controls import Controls, MachineStopped, machine_of
from handeye.env.jobs import job_named
from handeye.env.policies import Facts
from handeye.env.privileged import potential
from handeye.env.spaces import SWITCHED, ActionKind, Observation, action_space, named
from handeye.env.verdict import Verdict, verdict
from handeye.runs.runner import Runner
from handeye.runs.snapshot import Checkpoint
from handeye.runs.starts import StartStates, planted

_SEEDS: Final = 1 << 53  # seeds of worlds are below this number
_PASSED_OVER: Final = 20  # worlds in a row in which no episode can start


class AssemblyEnv(gymnasium.Env[Observation, Array]):
    """A job in the work cell. Each episode takes place in a world of its own.

    The policy sees what a program in the cell sees: the readings of the sensors. With the last component of an action,
    the policy reports that the work is done. After this report, or at the time limit, the referee judges the true
    state of the cell.
    """

    metadata: dict[str, Any] = {"render_modes": ["rgb_array"], "render_fps": 60}  # noqa: RUF012 - as in Gymnasium

    def __init__(
        self,
        job: str = "handeye/Pin-v0",
        *,
        action: ActionKind = "hand",
        level: Level = "nominal",
        world: Mapping[str, Any] | None = None,
        pictures: bool = False,
        shaped: bool = False,
        limit_s: float | None = None,
        camera: str = "ray",
        render_mode: str | None = None,
    ) -> None:
        """Prepare an environment; the cell is built when an episode begins.

        Args:
            job: id of the environment, such as `handeye/Pin-v0`.
            action: `hand`: each step moves the set-point of the hand; `torques`: each step sets the joint torques. Not
                every machine takes torques.
            level: size of the errors of the worlds: `low`, `nominal` or `high`.
            world: further arguments of `handeye.World` (`without`, `set`, `scale`, `faults`) for every world.
            pictures: add the last television picture to the observation, and the commands to the camera to the
                action.
            shaped: in every step, add a reward that is computed from the true state. The episode is then marked as
                privileged.
            limit_s: time limit of an episode (s on the cell's clock), instead of the time limit of the job.
            camera: renderer of the television camera: `ray` gives the same pictures on every computer.
            render_mode: None, or `rgb_array`: `render` photographs the cell.

        Raises:
            InvalidInput: an argument cannot be used.
        """
        self.job = job_named(job)
        if action not in ("hand", "torques"):
            raise NoSuchName(f"there is no action {action!r}; the actions are hand and torques")
        if render_mode not in (None, *self.metadata["render_modes"]):
            raise NoSuchName(f"there is no render mode {render_mode!r}; the only one is rgb_array")
        self.limit_s = self.job.limit_s if limit_s is None else limit_s
        if not isinstance(self.limit_s, int | float) or not 0 < self.limit_s < float("inf"):
            raise BadArgument(f"limit_s must be more than 0 s, not {limit_s!r}")
        if shaped and potential(self.job) is None:
            raise Refused(f"{self.job.id} has no shaped reward; handeye/Pin-v0 has one")
        self.render_mode, self.shaped = render_mode, shaped
        self._settings = {"level": level, **_settings("world", world)}
        self._spec(0, self._settings)  # refuses wrong names now
        self._machine = machine_of(self.job)
        self._machine.check(action, pictures=pictures)
        self.metadata = self.metadata | {"render_fps": round(1 / self._machine.period)}
        self.components = self._machine.components(action, pictures=pictures)
        self._actions = action_space(self.components)
        self._observations = self._machine.observations(pictures=pictures)
        self.action_space = cast(gymnasium.Space[Array], self._actions)
        self.observation_space = self._observations
        self._action, self._starts = action, StartStates(self.job.task, camera)
        self._pictures = pictures
        self._controls: Controls | None = None
        self._runner: Runner | None = None
        self._over = True

    # -- an episode -----------------------------------------------------------------------------------

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Observation, dict[str, Any]]:
        """Begin an episode in the world of `seed` or, without a seed, in a world whose seed is chosen at random.

        Args:
            options: arguments of `handeye.World` for this episode only, such as `{"level": "high"}`.

        Returns: the first observation, and a dictionary. The dictionary names the world and the stage of the program
            with which the episode begins. It contains what the machine measured or was taught before the episode. It
            also lists the seeds of worlds that `reset` passed over, because the program does not reach the stage in
            them.

        Raises:
            InvalidInput: the seed or an option cannot be used.
        """
        chosen = None if seed is None else checked_seed(seed)
        super().reset(seed=chosen)
        settings = self._settings | _settings("options", options)
        drawn, passed_over = self._drawn() if chosen is None else chosen, []
        start = self._start(self._spec(drawn, settings))
        while start is None:
            passed_over.append(drawn)
            if len(passed_over) == _PASSED_OVER:
                raise Refused(
                    f"in {_PASSED_OVER} worlds in a row the program stops before the start of {self.job.id}"
                )
            drawn = self._drawn()
            start = self._start(self._spec(drawn, settings))
        self._runner = runner = Runner(start)
        self._controls = self._machine.begin(runner, self._action, pictures=self._pictures)
        self._began, self._over = runner.time, False
        self._height = self._potential()
        return self._controls.seen(), self._beginning(runner, self._controls, passed_over)

    def step(self, action: Array) -> tuple[Observation, float, bool, bool, dict[str, Any]]:
        """Make the machine execute an action for one control period or, if the action says that the work is done, end
        the episode. Values outside of the action space are clipped.

        Raises:
            InvalidInput: the action has the wrong size or is not finite, or the episode has ended.
        """
        if self._over or self._runner is None or self._controls is None:
            raise Refused("the episode has ended; `reset` begins the next one")
        values, stopped = named(self.components, self._checked(action)), ""
        done = values["done"] > SWITCHED
        try:
            if done:
                self._controls.stop()
            else:
                self._controls.act(values)
        except (PhysicsFailed, MachineStopped) as error:
            stopped = str(error)
        late = self._runner.time - self._began >= self.limit_s - 1e-9
        terminated = done or bool(stopped)
        self._over = terminated or late
        reward, info = self._progress(stopped), {}
        if self._over:
            found = self._judged(done=done, stopped=stopped)
            reward, info = reward + found.reward, {"referee": found.shown()}
        return self._controls.seen(), reward, terminated, late and not terminated, info

    def render(self) -> Any:
        """Return a photograph of the cell, shape (height, width, 3), if the render mode is `rgb_array`.

        Raises:
            InvalidInput: no episode has begun, or OpenGL is missing.
        """
        if self.render_mode is None:
            return None
        if self._runner is None:
            raise Refused("there is nothing to show before the first `reset`")
        from handeye.env.photographs import photographed

        return photographed(self._runner)

    def facts(self, seed: int = 0) -> Facts:
        """Return the facts that a policy is allowed to know at the beginning of the present episode. `seed` is the
        seed of the policy's own random numbers.

        Raises:
            InvalidInput: no episode has begun.
        """
        if self._controls is None:
            raise Refused("there are no facts before the first `reset`")
        return self._controls.facts(
            {
                "environment": self.job.id,
                "task": self.job.task,
                "period": self._machine.period,
                "action": self._action,
                "components": self.components,
                "action_space": self._actions,
                "observation_space": self._observations,
                "seed": seed,
            }
        )

    def close(self) -> None:
        """Let go of the cell."""
        self._runner, self._controls, self._over = None, None, True

    # -- inside ---------------------------------------------------------------------------------------

    def _drawn(self) -> int:
        return int(self.np_random.integers(_SEEDS))

    def _spec(self, seed: int, settings: Mapping[str, Any]) -> WorldSpec:
        """Return the world of a seed. Raises InvalidInput if the settings do not fit the task."""
        known = {"level", "without", "set", "scale", "faults"}
        unknown = next((name for name in settings if name not in known), None)
        if unknown is not None:
            raise NoSuchName(
                f"there is no setting {unknown!r} of a world; the settings are {', '.join(sorted(known))}"
            )
        return World(seed, task=self.job.task, **settings).spec

    def _start(self, world: WorldSpec) -> Checkpoint | None:
        """Return the state in which an episode starts in a world. Returns None if the program does not reach this
        state.
        """
        job = self.job
        stage = job.stages[int(random_numbers(world.seed, "env.start").integers(len(job.stages)))]
        start = self._starts.before(stage, world)
        if start is None or not job.plants:
            return start
        drawn = random_numbers(world.seed, "env.fault")
        name = job.plants[int(drawn.integers(len(job.plants)))]
        return planted(start, Fault(name=name, value=float(drawn.uniform(*job.sizes)), stage=stage + 1))

    def _beginning(self, runner: Runner, controls: Controls, passed_over: list[int]) -> dict[str, Any]:
        world = runner.setup.world
        return {
            "world": {"seed": world.seed, "level": world.level},
            "stage": "" if runner.next is None else runner.listing.stages[runner.next.stage],
            **controls.known,
            "passed_over": list(passed_over),
            "privileged": self.shaped,
        }

    def _checked(self, action: Array) -> Array:
        size = len(self.components)
        try:
            values = np.asarray(action, dtype=float)
        except (TypeError, ValueError):
            values = np.empty(0)
        if values.shape != (size,) or not np.isfinite(values).all():
            raise BadArgument(
                f"an action of {self.job.id} must have {counted(size, 'finite number')}, not {action!r}"
            )
        return values

    def _judged(self, *, done: bool, stopped: str) -> Verdict:
        assert self._runner is not None
        return verdict(self.job, self._runner, done=done, stopped=stopped)

    def _potential(self) -> float:
        of = potential(self.job)
        return of(self._runner) if self.shaped and of is not None and self._runner is not None else 0.0

    def _progress(self, stopped: str) -> float:
        """Return the shaped reward of a step: by how much the true state has come nearer to the goal."""
        if not self.shaped or stopped:
            return 0.0
        before, self._height = self._height, self._potential()
        return self._height - before


def _settings(name: str, given: object) -> dict[str, Any]:
    """Return settings of a world as a dictionary. Raises BadArgument if they are neither a dictionary nor None."""
    if not isinstance(given, Mapping | None):
        raise BadArgument(f"`{name}` must be a dictionary of settings of a world, not {given!r}")
    return dict(given or {})
