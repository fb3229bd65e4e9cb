"""A kind of trial from another package: one coin is thrown in each world."""

import os
import signal
from collections.abc import Mapping
from pathlib import Path
from typing import Final

from handeye.cli.sweeps import sweep_command
from handeye.trials.sweep import Case, Sweep, TrialRow


class Coin(TrialRow, frozen=True, kw_only=True):
    """A coin that was thrown."""

    side: str = ""
    height: float = 0.0

    @property
    def outcome(self) -> str:
        return self.side

    @property
    def measures(self) -> Mapping[str, float]:
        return {} if self.broken_off else {"height, m": self.height}


def throw(case: Case) -> list[Coin]:
    """Throw a coin. The world of seed 7 has no coin, and in the world of seed 13 the process is killed once."""
    (number,) = case.trials
    if case.seed == 7:
        raise ValueError("there is no coin")
    mark = Path("killed")
    if case.seed == 13 and not mark.exists():
        mark.touch()
        os.kill(os.getpid(), signal.SIGKILL)
    side = ("heads", "tails", "rolled away")[case.seed % 3]
    return [Coin(trial=number, seed=case.seed, condition=case.condition, side=side, height=case.seed / 10)]


COINS: Final = Sweep(
    kind="coins",
    row=Coin,
    outcomes={"heads": "right", "tails": "wrong", "rolled away": "uncounted"},
    success="heads",
    noun="throw",
    work=throw,
)
coins = sweep_command(COINS, n=4)
