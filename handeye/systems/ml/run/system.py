"""Defines the system of MOS and ML. The system builds runs, and provides the texts that users read in these runs."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Final

from handeye.core.markup import PagePart
from handeye.core.resources import plans
from handeye.core.source import read_source
from handeye.program.events import Choice
from handeye.program.numbered import encode
from handeye.results.result import Result
from handeye.runs.advance import Pause
from handeye.runs.runner import Runner
from handeye.runs.setup import Setup
from handeye.runs.system import Listing, RunCallbacks, StepperWords, System
from handeye.systems.ml import ENTRY
from handeye.systems.ml.dashboard.history import packed
from handeye.systems.ml.dashboard.kept import TABLES, kept_history
from handeye.systems.ml.dashboard.page import tables_part
from handeye.systems.ml.follow.page import kept_page
from handeye.systems.ml.machine.spec import GRAM_FORCE, RANGE_COUNT
from handeye.systems.ml.machine.surroundings import Stimulus
from handeye.systems.ml.run.jobs import PROGRAMS, job_plan
from handeye.systems.ml.run.plan import MlPlan, decode, listing, sound
from handeye.systems.ml.run.running import RunningMl
from handeye.systems.ml.run.state import MlState
from handeye.tasks import any_task

OWN: Final = "guarded_move.ml"  # the program that is run if none is named


WORKED_EXAMPLE: Final = (
    Stimulus(channel="right_strain_x", value=500 * GRAM_FORCE, motor=3, beyond=2750),
    Stimulus(channel="left_strain_z", value=-700 * GRAM_FORCE),
    Stimulus(channel="range", value=300 * RANGE_COUNT),
)
"""What the sensors sense in the paper's example: a force when y passes 2.750 inches, a part in the hand, and a surface
30 mm below the hand.
"""


class MlSystem(System):
    """The system that executes ML programs on the machine of their plan."""

    name = ENTRY.name
    plan = MlPlan
    state = MlState
    words = StepperWords(
        about=(
            "A step is one statement with all its cycles of 10 ms; the arrow points to the statement that comes",
            "next. `type right FILE MT 3 8 10` executes a line of ML for the right arm between two statements.",
        ),
        places=(
            "PLACE is the number of a statement (288), or the first word of a statement (DMOTOR).",
            "WHAT is one of",
        ),
        units="0.001 in, 0.01 deg, cycles of 10 ms",
        commands={
            "proceed": "enable the arm and continue after the statement at which the program was stopped",
            "retry": "enable the arm and execute the statement again",
            "skip": "end the program here",
        },
    )

    def encode(self, plan: MlPlan) -> bytes:
        return encode(plan)

    def decode(self, data: bytes, name: str) -> MlPlan:
        return decode(data, name)

    def listing(self, plan: MlPlan) -> Listing:
        return listing(plan)

    def build(self, setup: Setup, around: RunCallbacks) -> RunningMl:
        self.check(setup)
        sound(setup.plan)  # type: ignore[arg-type]  # as `check` has found
        return RunningMl(setup, around)

    def check(self, setup: Setup) -> None:
        super().check(setup)
        task, world = any_task(setup.task), setup.world
        task.variation().check(world)
        task.faults(world).check(world.faults)

    def own_plan(self, task: str) -> MlPlan:
        if task in PROGRAMS:
            return job_plan(task)
        text = read_source(plans() / OWN).text
        return MlPlan(name=OWN, text=text, stimuli=WORKED_EXAMPLE)

    def files(self, runner: Runner, pause: Pause, result: Result) -> Mapping[str, bytes]:
        assert isinstance(runner.system, RunningMl)
        done = runner.system.tables
        own = runner.system.hardware.files(runner.setup.world, result, (tables_part(done),))
        return {TABLES: packed(done), **own}

    def page(self, folder: Path) -> bytes | None:
        return kept_page(folder, self.parts(folder))

    def parts(self, folder: Path) -> Sequence[PagePart]:
        done = kept_history(folder)
        return () if done is None else (tables_part(done),)

    def choices(self, runner: Runner) -> Mapping[Choice, str]:
        return {
            "proceed": "proceed: enable the arm, and continue after this statement",
            "retry": "retry: enable the arm, and execute the statement again",
            "skip": "skip: end the program here",
        }


ML: Final = MlSystem()
