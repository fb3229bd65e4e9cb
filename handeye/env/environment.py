"""The environment: one job in many worlds; each step is one servo period."""

from collections.abc import Mapping
from typing import Any, Final, cast

import gymnasium
import numpy as np

from handeye import tasks
from handeye.api.worlds import World
from handeye.core.distributions import random_numbers
from handeye.core.errors import BadArgument, NoSuchName, PhysicsFailed, Refused
from handeye.core.faults import Fault
from handeye.core.mutable_records import copied
from handeye.core.plain_text import counted
from handeye.core.pose import Array
from handeye.core.variation import Level, WorldSpec, checked_seed
from handeye.env.controls import Controls
from handeye.env.jobs import job_named
from handeye.env.policies import Facts
from handeye.env.privileged import potential
from handeye.env.spaces import (
    SWITCHED,
    ActionKind,
    Observation,
    action_space,
    components,
    named,
    observation,
    observation_space,
)
from handeye.env.television import Television
from handeye.env.verdict import Verdict, verdict
from handeye.runs.runner import Runner
from handeye.runs.snapshot import Checkpoint
from handeye.runs.starts import StartStates, planted

_SEEDS: Final = 1 << 53  # seeds of worlds are below this number
_PASSED_OVER: Final = 20  # worlds in a row in which no episode can start


class AssemblyEnv(gymnasium.Env[Observation, Array]):
    """A job in the work cell. Each episode takes place in a world of its own.

    The policy sees what the working phase of a program sees: the readings of the sensors. The last component of the
    action says that the work is done; then, or at the time limit, the referee judges the true state of the cell.
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
            action: `hand`: each step moves the set-point of the hand; `torques`: each step sets the joint torques.
            level: size of the errors of the worlds: `low`, `nominal` or `high`.
            world: further arguments of `handeye.World` (`without`, `set`, `scale`, `faults`) for every world.
            pictures: add the last television picture to the observation, and the commands to the camera to the
                action.
            shaped: in every step, add a reward that is computed from the true state. The episode is then marked as
                privileged.
            limit_s: time limit of an episode (s on the cell's clock) instead of the job's.
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
        self._work = tasks.task(self.job.task)
        if pictures and self._work.eye is None:
            raise Refused(f"{self.job.id} has no television camera")
        self.components = components(action, self._work.arm, pictures=pictures)
        self._actions = action_space(self.components)
        self._observations = observation_space(self._work.arm, pictures=pictures)
        self.action_space = cast(gymnasium.Space[Array], self._actions)
        self.observation_space = self._observations
        self._action, self._starts = action, StartStates(self.job.task, camera)
        self._pictures = pictures
        self._television: Television | None = None
        self._runner: Runner | None = None
        self._over = True

    # -- an episode -----------------------------------------------------------------------------------

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Observation, dict[str, Any]]:
        """Begin an episode in the world of `seed` or, without a seed, in a world whose seed is drawn.

        Args:
            options: arguments of `handeye.World` for this episode only, such as `{"level": "high"}`.

        Returns: the first observation, and a dictionary with the world, the stage of the program that begins, what the
            arm has measured of itself, and the seeds of worlds that were passed over because, in them, the program
            does not reach the start of the job.

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
        self._controls = Controls(runner.context.drive, self._action)
        self._television = self._switched_on(runner)
        if runner.next is not None:
            runner.arm_cell.begin_stage(runner.next.stage + 1)
        self._began, self._over = runner.arm_cell.now, False
        self._height = self._potential()
        return self._seen(), self._beginning(runner, passed_over)

    def step(self, action: Array) -> tuple[Observation, float, bool, bool, dict[str, Any]]:
        """Let a servo period pass with an action, or end the episode if the action says that the work is done.
        Values outside of the action space are clipped.

        Raises:
            InvalidInput: the action has the wrong size or is not finite, or the episode has ended.
        """
        if self._over or self._runner is None:
            raise Refused("the episode has ended; `reset` begins the next one")
        values, stopped = named(self.components, self._checked(action)), ""
        done = values["done"] > SWITCHED
        try:
            self._passed(values, done=done)
        except PhysicsFailed as error:
            stopped = str(error)
        late = self._runner.arm_cell.now - self._began >= self.limit_s - 1e-9
        terminated = done or bool(stopped)
        self._over = terminated or late
        reward, info = self._progress(stopped), {}
        if self._over:
            found = self._judged(done=done, stopped=stopped)
            reward, info = reward + found.reward, {"referee": found.shown()}
        return self._seen(), reward, terminated, late and not terminated, info

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
        """Return what a policy may know at the beginning of the present episode. `seed` is the seed of the policy's
        own random numbers.

        Raises:
            InvalidInput: no episode has begun.
        """
        if self._runner is None:
            raise Refused("there are no facts before the first `reset`")
        memory = self._runner.context.state
        links = memory.drive.links
        return Facts(
            environment=self.job.id,
            task=self.job.task,
            action=self._action,
            components=self.components,
            action_space=self._actions,
            observation_space=self._observations,
            arm=self._work.arm,
            friction=memory.drive.friction.copy(),
            links=np.ones(len(memory.drive.q)) if links is None else links.copy(),
            memory=copied(memory),
            seed=seed,
        )

    def close(self) -> None:
        """Let go of the cell."""
        self._runner, self._over = None, True

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
        """Return the start of an episode in a world; None if the program does not reach this start."""
        job = self.job
        stage = job.stages[int(random_numbers(world.seed, "env.start").integers(len(job.stages)))]
        start = self._starts.before(stage, world)
        if start is None or not job.plants:
            return start
        drawn = random_numbers(world.seed, "env.fault")
        name = job.plants[int(drawn.integers(len(job.plants)))]
        return planted(start, Fault(name=name, value=float(drawn.uniform(*job.sizes)), stage=stage + 1))

    def _beginning(self, runner: Runner, passed_over: list[int]) -> dict[str, Any]:
        world, facts = runner.setup.world, self.facts()
        return {
            "world": {"seed": world.seed, "level": world.level},
            "stage": "" if runner.next is None else runner.listing.stages[runner.next.stage],
            "friction": facts.friction,
            "links": facts.links,
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

    def _switched_on(self, runner: Runner) -> Television | None:
        """Return the television camera of an episode, or None if no pictures are wanted."""
        drive, camera = runner.context.drive, runner.arm_cell.devices.camera
        wanted = self._pictures and camera is not None
        return Television(drive, camera, runner.context.state.camera_ready) if wanted and camera else None

    def _passed(self, values: Mapping[str, float], *, done: bool) -> None:
        """Let a servo period pass with the commands of an action, or bring the arm to rest if the work is done."""
        if done:
            self._controls.stop()
            return
        if self._television is not None:
            self._television.command(values)
        self._controls.act(values)
        if self._television is not None:
            self._television.expose()

    def _seen(self) -> Observation:
        assert self._runner is not None
        seen = observation(self._runner.arm_cell.devices.sense(), self._controls.torque)
        return seen if self._television is None else seen | self._television.seen()

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
    """Return the settings of a world as a dictionary. Raises BadArgument if the settings are anything else."""
    if not isinstance(given, Mapping | None):
        raise BadArgument(f"`{name}` must be a dictionary of settings of a world, not {given!r}")
    return dict(given or {})
