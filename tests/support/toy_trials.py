"""Trials of the counter machine: how far it counts, by the seed."""

from collections.abc import Mapping
from typing import Final

from toy_system import Registers, begin_toy

from handeye.cli.common import WholeNumber
from handeye.cli.sweeps import ANY, SweepOptions, carry_out_sweep
from handeye.core.variation import WorldSpec
from handeye.runs.operator import NOBODY, attend
from handeye.runs.runner import Runner
from handeye.trials.folder import head_of
from handeye.trials.sweep import Case, Sweep, TrialRow, cases


class CountRow(TrialRow, frozen=True, kw_only=True):
    """One count."""

    counted: int = 0

    @property
    def outcome(self) -> str:
        return "right" if self.counted == self.seed else "wrong"

    @property
    def measures(self) -> Mapping[str, float]:
        return {"count, lines": self.counted}


def count(case: Case) -> list[CountRow]:
    """Count as far as the seed says."""
    runner = Runner(begin_toy(case.seed))
    attend(runner, NOBODY)
    assert isinstance(runner.system.state, Registers)
    return [CountRow(trial=case.trials[0], seed=case.seed, counted=runner.system.state.values["B"])]


COUNTING: Final = Sweep(
    kind="counting", row=CountRow, outcomes={"right": "right", "wrong": "wrong"}, success="right"
)


def counting_trials(*, n: WholeNumber = 10, options: SweepOptions = ANY) -> int:
    """Count with many seeds."""
    return carry_out_sweep(
        COUNTING, count, cases(1, range(n)), head_of(COUNTING, WorldSpec(seed=1), settings={}), options,
        title="the counter machine", again=lambda row: f"handeye trials counting --n 1 --seed {row.seed}",
    )  # fmt: skip
