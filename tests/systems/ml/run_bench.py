"""ML programs as runs, for tests."""

from collections.abc import Sequence
from typing import Any, Final

from level_bench import STRAIN

from handeye.core.resources import plans
from handeye.core.source import read_source
from handeye.core.variation import WorldSpec
from handeye.program.events import to_line
from handeye.runs.advance import advance
from handeye.runs.runner import Runner
from handeye.runs.setup import Setup
from handeye.runs.snapshot import Checkpoint
from handeye.systems.ml.happenings import Printed
from handeye.systems.ml.machine.surroundings import Stimulus
from handeye.systems.ml.run.plan import MlPlan

HELD: Final = Stimulus(channel="left_strain_z", value=-700 * STRAIN)
NEAR: Final = Stimulus(channel="range", value=0.03)
FELT: Final = Stimulus(channel="right_strain_x", value=500 * STRAIN, motor=3, beyond=2750)


def program(name: str) -> str:
    """The text of a program of `plans`."""
    return read_source(plans() / f"{name}.ml").text


def begin(text: str, *stimuli: Stimulus, **settings: Any) -> Checkpoint:
    """A run of a program that has not begun."""
    plan = MlPlan(name="test.ml", text=text, stimuli=stimuli, **settings)
    return Checkpoint(setup=Setup(system="ml", plan=plan, world=WorldSpec(seed=0), camera="auto"))


def ran(text: str, *stimuli: Stimulus, **settings: Any) -> Runner:
    """A run of a program that went as far as it could."""
    runner = Runner(begin(text, *stimuli, **settings))
    advance(runner)
    return runner


def lines(runner: Runner) -> Sequence[bytes]:
    return [to_line(event) for event in runner.events]


def printed(runner: Runner) -> list[str]:
    return [event.text for event in runner.events if isinstance(event, Printed)]
