"""Workers of dask give the rows that processes give.

It is large, so the ordinary suite does without it: `pip install distributed`, then `pytest tests/xcheck`.
"""

import pytest
from short_runs import FEEL, plan_of

from handeye.core.errors import InvalidInput
from handeye.core.variation import WorldSpec
from handeye.trials.dask_engine import dask_workers
from handeye.trials.plans.trial import ASSEMBLY, Trial
from handeye.trials.sweep import carry_out, cases, processes

pytestmark = pytest.mark.filterwarnings("default")  # those of others
TRIAL = Trial(plan=plan_of(FEEL), world=WorldSpec(seed=5), camera="ray")
CASES = cases(5, range(4))


def test_two_workers_give_the_same_rows_as_processes() -> None:
    there, here = (
        carry_out(ASSEMBLY, TRIAL, CASES, engine) for engine in (dask_workers(2, None), processes(2))
    )
    assert [(each.seed, each.verdict, each.events) for each in there] == [
        (each.seed, each.verdict, each.events) for each in here
    ]


def test_a_scheduler_that_there_is_not_is_told_in_one_sentence() -> None:
    with pytest.raises(InvalidInput, match=r"^no dask scheduler answers at tcp://127\.0\.0\.1:1$"):
        carry_out(ASSEMBLY, TRIAL, CASES, dask_workers(2, "tcp://127.0.0.1:1"))
