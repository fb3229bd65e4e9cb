"""Trials of dismantling: what was built is taken apart and judged, and what was not built does not count."""

from pathlib import Path

import msgspec
import pytest
from results import result
from short_runs import plan_of

from handeye.core.errors import ERRORS, InvalidInput
from handeye.core.variation import WorldSpec
from handeye.results.result import Check
from handeye.trials.figures import figures
from handeye.trials.folder import BatchFolder
from handeye.trials.plans.row import Row
from handeye.trials.plans.trial import ASSEMBLY, DISMANTLING, DismantlingTrial, Trial
from handeye.trials.sweep import cases

WORLD = WorldSpec(seed=5)
PLAN = plan_of('STAGE "open"\nOPEN 2\nSTAGE "shut"\nOPEN 1\n')
FAR = Check(
    ok=False, subject="pin", value=4, relation="at most", limit=3, unit="mm", sentence="pin (at most 3 mm)"
)


def judged(apart: bool | None, **fields: object) -> Row:
    """A trial in which all was undone; with None a guard stopped it."""
    found = result(
        completed=apart is not None,
        assembled=None,
        checks={} if apart in (None, True) else {"pins": FAR},
    )
    row = Row(trial=0, seed=0, result=msgspec.structs.replace(found, apart=apart), force=9.0)
    return msgspec.structs.replace(row, **fields)


def test_all_that_happened_to_what_was_built_counts_and_nothing_else() -> None:
    rows = [judged(True), judged(True), judged(False, force=30.0), judged(None, force=25.0),
            judged(None, ended="not built"), Row(trial=5, seed=5, ended="killed")]  # fmt: skip
    assert [row.verdict for row in rows] == ["apart", "apart", "silent", "stopped", "not built", "failed"]
    found = figures(DISMANTLING, rows, lambda row: f"again {row.seed}")
    assert (found.n, found.right, found.silent_failures, found.outcomes["stopped"], found.failed) == (
        5,
        2,
        1,
        1,
        1,
    )
    assert (found.uncounted, found.measures["greatest force, N"].most, len(found.failures)) == (1, 9.0, 3)
    assert [cause.cause for cause in found.causes] == [
        "pins",
        ERRORS[32],
        "its process was killed twice",
    ]


@pytest.mark.slow
def test_a_trial_undoes_what_it_did_and_has_that_judged() -> None:
    (case,) = cases(5, [0])
    (row,) = DismantlingTrial(plan=PLAN, world=WORLD, camera="ray", to="open")(case)
    assert (row.verdict, row.ended) == ("apart", "ended")
    assert row.force is not None
    (whole,) = DismantlingTrial(plan=PLAN, world=WORLD, camera="ray")(case)  # no pump, says the referee
    assert (whole.verdict, whole.force) == ("not built", None)
    assert "screws" in whole.detail


def test_a_folder_of_assembling_takes_no_dismantling(tmp_path: Path) -> None:
    BatchFolder(tmp_path, ASSEMBLY, Trial(plan=PLAN, world=WORLD).head(ASSEMBLY), PLAN).close()
    head = DismantlingTrial(plan=PLAN, world=WORLD, to="open").head(DISMANTLING)
    differs = r"of another batch, which differs in work, stage to undo from; choose another folder$"
    with pytest.raises(InvalidInput, match=differs):
        BatchFolder(tmp_path, DISMANTLING, head, PLAN)
