"""A prediction as a caller from Python has it."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Final

import numpy as np

from handeye.api.arguments import given_count, given_names
from handeye.api.plans import FileName, Planned, plan
from handeye.api.worlds import World
from handeye.core.diagnostics import quoted
from handeye.core.errors import NoSuchName, Refused
from handeye.core.plain_text import counted
from handeye.core.pose import Array
from handeye.core.variation import WorldSpec, checked_seed
from handeye.program.senses import SENSES, Sense
from handeye.runs.scripts import default_script
from handeye.trace.table import Table
from handeye.trials.prediction.figures import figures
from handeye.trials.prediction.predicting import Prediction, predict
from handeye.trials.prediction.tables import operations, worlds

_SENSES: Final[dict[str, Sense]] = {sense: sense for sense in SENSES}


@dataclass(frozen=True, slots=True, repr=False)
class PredictedWorlds:
    """What is predicted of a program in many worlds."""

    prediction: Prediction

    @property
    def used(self) -> Array:
        """The largest share of a room that each world uses, shape (n,): beyond 1, something is predicted to fail."""
        return self.prediction.used

    @property
    def beyond(self) -> float:
        """Share of the worlds in which something is predicted to fail."""
        return float((self.used > 1).mean())

    def table(self) -> Table:
        """A row for each thing that can be off in a contact operation."""
        return operations(figures(self.prediction, str, worst=1))

    def worlds(self) -> Table:
        """A row a world: what is thinnest in it, and a column for each thing that is off."""
        return worlds(self.prediction)

    def __repr__(self) -> str:
        worst = int(np.argmax(self.used))
        thin, seed = self.prediction.thinnest[worst], self.prediction.seeds[worst]
        return (
            f"<{counted(len(self.used), 'world')}, {self.beyond:.1%} predicted to fail; worst: seed {seed}, "
            f"{thin.operation}, {thin.at}: {thin.what} {thin.off[worst]:.2f} of {thin.room:.2f} {thin.unit}>"
        )


def predict_from(
    first: int | World,
    n: int,
    *,
    script: FileName | Planned | None,
    taught: FileName | None,
    lacking: Iterable[str],
    jobs: int,
) -> PredictedWorlds:
    """Predict worlds from a first one on; see `handeye.trials.predict`."""
    spec = first.spec if isinstance(first, World) else WorldSpec(seed=checked_seed(first))
    if spec.faults:
        raise Refused("faults are not predicted: only errors, with which every world is drawn")
    count = given_count(n, "n")
    checked_seed(spec.seed + count - 1)
    senses = tuple(_sense(name) for name in given_names(lacking, "`lacking`"))
    program = plan(default_script() if script is None else script, taught=taught).record.program
    seeds = range(spec.seed, spec.seed + count)
    return PredictedWorlds(predict(program, spec, seeds, without=senses, workers=given_count(jobs, "jobs")))


def _sense(name: str) -> Sense:
    if name not in _SENSES:
        raise NoSuchName(f"there is no sense {quoted(name)}; there are {', '.join(_SENSES)}")
    return _SENSES[name]
