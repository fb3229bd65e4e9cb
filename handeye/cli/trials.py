"""Commands that repeat a trial in many worlds and count the outcomes."""

import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Final

from cyclopts import Parameter

from handeye.cli.common import Camera, TaskWords, WholeNumber, camera_here, positive, say
from handeye.cli.programs import plan_or_own
from handeye.cli.sweeps import ANY, FirstSeed, SweepOptions, carry_out_sweep
from handeye.cli.tally import Tally
from handeye.cli.world_options import ANY_WORLD, WorldOptions
from handeye.core.diagnostics import quoted, suggestion
from handeye.core.entries import PLANNED, entries, entry_named, require
from handeye.core.errors import NoSuchName, Refused
from handeye.core.variation import WorldSpec, checked_seed
from handeye.planfile.plan import Plan
from handeye.runs.setup import Setup
from handeye.runs.systems import digest_of, system_named
from handeye.tasks import DEFAULT, any_task, named, planned
from handeye.tasks.interface import Task
from handeye.tasks.trial import Known

if TYPE_CHECKING:
    from handeye.tasks.interface import Disturbance
    from handeye.trials.chaos.schedule import Schedule

Worldly = Annotated[
    WholeNumber,
    Parameter(
        name="--n",
        help=("Number of worlds for each disturbance. Their seeds are consecutive and begin with --seed."),
    ),
]


@Parameter(name="*")
@dataclass(frozen=True, slots=True, kw_only=True)
class AttemptOptions:
    """Options for the number of trials, their worlds and the camera."""

    world: Annotated[WorldOptions, Parameter(name="*")] = ANY_WORLD
    worlds: Annotated[
        WholeNumber | None,
        Parameter(
            help="Number of worlds; their seeds count up from --seed. Default: one world for each trial (--n)."
        ),
    ] = None
    eye: Annotated[
        Known,
        Parameter(
            help="How the program knows the pose of its camera. `lamp`: from a calibration with the lamp on the "
            "arm. `sightings`: from simulated sightings of the lamp; simulated sightings are faster and more "
            "accurate than real ones. `drawn`: from the drawing of the cell. `true`: exactly."
        ),
    ] = "lamp"
    camera: Camera = "auto"

    def carry_out(self, name: str, count: int, options: SweepOptions) -> int:
        """Run `count` trials of the kind `name`; raises NoSuchName if the task has no such kind of trial."""
        from handeye.trials.eye import EyeWork, eye_cases, eye_sweep
        from handeye.trials.folder import head_of

        worlds = count if self.worlds is None else self.worlds
        for each, what in ((count, "world"), (worlds, "world"), (options.jobs, "process")):
            positive(each, what)
        options.check()
        first, work, number = self.world.spec, planned(self.world.work), min(count, worlds)
        if name not in work.trials:
            raise NoSuchName(f"the task {quoted(work.name)} has no trial {quoted(name)}")
        sweep = eye_sweep(name, work.trials[name])
        camera = camera_here(self.camera)
        settings = {"eye": self.eye, "number of worlds": str(number), "task": work.name}
        return carry_out_sweep(
            sweep,
            EyeWork(task=work.name, trial=name, world=first, camera=camera, known=self.eye),
            eye_cases(first.seed, count, number),
            head_of(sweep, first, settings=settings, camera=camera),
            options,
            title=f"{name} in worlds from {first} on; camera pose: {self.eye}",
            more={"worlds": number, "eye": self.eye},
        )


ATTEMPTS: Final = AttemptOptions()


def base_vision_trials(
    *,
    n: Annotated[
        WholeNumber,
        Parameter(
            help="Number of poses of the base to try. The first is the pose that the base has in the world; the "
            "others are random."
        ),
    ] = 100,
    attempts: AttemptOptions = ATTEMPTS,
    options: SweepOptions = ANY,
) -> int:
    """Find the base of the pump on the belt, at many poses: how often it is found, how accurately, and how often in
    the wrong place.

    In every world, the camera is first calibrated, as in a run: the arm moves its lamp through the camera's view. The
    calibration takes most of the time of a trial; with `--worlds`, several poses share a world and its calibration.

    Exit code 0: no wrong pose was accepted; 3: a wrong pose was accepted.
    """
    return attempts.carry_out("base", n, options)


def gasket_vision_trials(
    *,
    n: Annotated[WholeNumber, Parameter(help="Number of gaskets of each kind.")] = 50,
    attempts: AttemptOptions = ATTEMPTS,
    options: SweepOptions = ANY,
) -> int:
    """Inspect the gasket by camera in four cases: in place, shifted by .3 in, absent, and with a second gasket on top.

    The camera cannot see a second gasket on top of the first, so accepting two gaskets counts as right here; in a
    run, the hand detects two gaskets by their height.

    Exit code 0: no case with a shifted or absent gasket was accepted; 3: such a case was accepted.
    """
    return attempts.carry_out("gasket", n, options)


def disturbed_trials(
    *,
    only: Annotated[
        list[str] | None,
        Parameter(help="Try only this disturbance. May be repeated.", consume_multiple=False),
    ] = None,
    listed: Annotated[bool, Parameter(name="--list", help="List the disturbances; run nothing.")] = False,
    n: Worldly = 1,
    world: WorldOptions = ANY_WORLD,
    camera: Camera = "auto",
    options: SweepOptions = ANY,
) -> int:
    """Disturb a finished pump without telling the program, then take the pump apart: does a guard stop the arm before
    the arm does damage?

    A stop is in time if, before it, no part outside the hand moved by more than 2 mm in one step, and the hand felt at
    most 60 N. Each trial first builds the pump, which takes one CPU minute.

    Exit code 0: every trial was stopped in time; 3: a trial was not stopped in time; 2: bad input; 130: interrupted.
    """
    from handeye.trials.disturbing import DISTURBED, DisturbanceWork
    from handeye.trials.folder import head_of
    from handeye.trials.sweep import cases

    chosen = _chosen(planned(world.work).disturbances(), only)
    positive(n, "world")
    options.check()
    if listed:
        for each in chosen:
            say(f"{each.name:16} {each.meaning}")
        return 0
    spec, plan, camera = world.spec, plan_or_own(None, world.task), camera_here(camera)
    return carry_out_sweep(
        DISTURBED,
        DisturbanceWork(plan=plan, world=spec, camera=camera),
        cases(spec.seed, range(n), [each.name for each in chosen]),
        head_of(DISTURBED, spec, plan, camera=camera),
        options,
        title=f"{plan.program.name} assembled, disturbed and taken apart, in worlds from {spec} on",
        plan=plan,
    )


def _chosen(known: "Sequence[Disturbance]", only: "list[str] | None") -> "list[Disturbance]":
    """The disturbances with these names; all disturbances if no names are given."""
    names = [each.name for each in known]
    if not names:
        raise Refused("this task has no disturbances")
    for name in only or ():
        if name not in names:
            near = suggestion(name, names) or "--list lists all disturbances"
            raise NoSuchName(f"there is no disturbance {quoted(name)}; {near}")
    return [each for each in known if not only or each.name in only]


def chaos_trials(
    *,
    count: Annotated[
        WholeNumber, Parameter(name="--n", help="Number of random schedules (tests) to try.")
    ] = 100,
    seed: FirstSeed = 0,
    worlds: Annotated[
        WholeNumber,
        Parameter(
            help=(
                "Number of worlds. The first world has nominal errors, the second low errors, the third high errors, "
                "the fourth nominal errors, and so on."
            )
        ),
    ] = 3,
    schedule: Annotated[
        list[str] | None,
        Parameter(
            help="Schedule to run instead of random schedules, in the form in which the command prints schedules. "
            "May be repeated.",
            consume_multiple=False,
        ),
    ] = None,
    checkpoints: Annotated[
        Path | None,
        Parameter(
            help="Folder for the fault-free runs from which schedules start; created if missing, and kept afterwards."
        ),
    ] = None,
    task: TaskWords = None,
    camera: Camera = "auto",
    options: SweepOptions = ANY,
) -> int:
    """Chaos test: random faults, crashes, interruptions and operator answers; each failure is reduced to one
    command that repeats it.

    A schedule is one test. It starts from a random step of a fault-free run, and continues for a few steps, or to the
    end of the stage. It has up to two faults, and up to two interruptions: the panic button, a pause, going back, or a
    killed process. After each interruption, the run resumes from disk. A simulated operator answers each call: it
    retries, skips, proceeds or aborts. The same schedule then runs again without its interruptions.

    There are six checks. `silent`: the program never reports success with a wrong pump. `resume`: trace, events and
    state are the same, to the byte, as in the run without interruptions. `brakes`: the brakes are on after every stop.
    `trace`: the trace can be read and says what happened. `disk`: nothing is lost on disk. `error`: no exception is
    raised. If a schedule fails, the trial removes its elements one by one, and keeps only the elements that are needed
    for the failure. The trial then prints this shortest failing schedule as a command. If a fault spoiled a part of
    the pump only after the program's last look at this part, the schedule counts as `unseen`, not as `silent`. Before
    the schedules, the command makes one complete run in each world. A complete run takes one CPU minute, and a
    schedule takes some seconds.

    Exit code 0: all checks passed; 3: a check failed; 2: bad input; 130: interrupted.
    """
    from handeye.trials.chaos.schedule import parse_schedule
    from handeye.trials.chaos.trials import CHAOS, ChaosWork
    from handeye.trials.folder import head_of
    from handeye.trials.sweep import Case

    for number, what in ((count, "schedule"), (worlds, "world"), (options.jobs, "worker")):
        positive(number, what)
    checked_seed(seed)
    checked_seed(seed + max(worlds, count) - 1)
    options.check()
    given = [parse_schedule(text) for text in schedule or ()]
    camera = camera_here(camera)
    setup = _own_setup(task, camera)
    plan = setup.plan if isinstance(setup.plan, Plan) else None
    settings = {"worlds drawn from": str(worlds), "plan of the system": "" if plan else digest_of(setup)}
    with _folder(checkpoints) as folder:
        drawn = given or _drawn(setup, folder, seed, count, worlds, options.jobs)
        return carry_out_sweep(
            CHAOS,
            ChaosWork(setup=setup, folder=folder),
            [Case(trials=(k,), seed=seed + k, condition=str(each)) for k, each in enumerate(drawn)],
            head_of(CHAOS, WorldSpec(seed=seed), plan, settings, camera=camera),
            options,
            title=f"random schedules of faults and interruptions of {setup.task}, from seed {seed}",
            plan=plan,
        )


@contextmanager
def _folder(named: Path | None) -> Iterator[Path]:
    """The folder of the fault-free runs; a temporary one by default."""
    if named is not None:
        yield named
        return
    with tempfile.TemporaryDirectory(prefix="handeye-") as name:
        yield Path(name)


def _own_setup(words: str | None, camera: str) -> Setup:
    """The set-up of a run that uses the task's own plan. The world is chosen later."""
    work = any_task(DEFAULT) if words is None else named(words)
    if isinstance(work, Task):
        return Setup(plan=plan_or_own(None, words), world=WorldSpec(seed=0), camera=camera)
    system = next((entry.name for entry in entries().values() if work.name in entry.tasks), PLANNED)
    require(system, "chaos")
    plan = system_named(system).own_plan(work.name)
    return Setup(system=system, plan=plan, world=WorldSpec(seed=0), camera=camera)


def _drawn(setup: Setup, folder: Path, seed: int, count: int, worlds: int, jobs: int) -> "list[Schedule]":
    """Choose random schedules, after executing the fault-free runs from which they start."""
    from handeye.trials.chaos import trials
    from handeye.trials.sound_run import sound_runs

    specs = trials.worlds(seed, worlds, levels="levels" in entry_named(setup.system).can)
    tally = Tally(len(specs), "worlds finished")
    runs = sorted(tally.counting(sound_runs(setup, folder, specs, jobs)), key=lambda run: run.world.seed)
    return list(trials.schedules(seed, count, runs, any_task(setup.task)))
