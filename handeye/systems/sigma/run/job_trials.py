"""Defines the kinds of trials for the jobs on the board of the gantries."""

from collections.abc import Mapping
from typing import Final

from handeye.systems.sigma.run.plan import JobName
from handeye.trials.jobs import JobRow, job_sweep
from handeye.trials.sweep import Sweep


class BoardRow(JobRow, frozen=True, kw_only=True):
    """The trial of one board."""

    pieces: int = 0


def _sentence(means: Mapping[str, float]) -> str:
    return (
        f"on average {means['commands']:.0f} commands and questions in {means['simulated_s']:.1f} s: "
        f"{means['commands_per_second']:.1f} a second, {means['bus_saturation']:.2%} of what the bus can carry; "
        f"the computer is idle for {means['computer_idle']:.0%} of the time"
    )


CHESS_TRIALS: Final = job_sweep("chess", BoardRow, _sentence)
HANDOVER_TRIALS: Final = job_sweep("handover", BoardRow, _sentence)
INSERTION_TRIALS: Final = job_sweep("insert", BoardRow, _sentence)
PRCO_TRIALS: Final = job_sweep("prco", BoardRow, _sentence)
LINE_TRIALS: Final = job_sweep("line", BoardRow, _sentence)
TRIALS: Final[dict[JobName, Sweep[BoardRow]]] = {
    "chess": CHESS_TRIALS,
    "handover": HANDOVER_TRIALS,
    "insert": INSERTION_TRIALS,
    "prco": PRCO_TRIALS,
    "line": LINE_TRIALS,
}
