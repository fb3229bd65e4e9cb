"""A batch carried out: what is not yet kept is tried, and each trial kept as it ends."""

from collections.abc import Callable, Sequence
from contextlib import closing

import msgspec

from handeye.core.variation import WorldSpec
from handeye.core.versions import code_digest, versions
from handeye.planfile.store import plan_digest
from handeye.trials.batch.engines import Engine
from handeye.trials.batch.folder import BatchFolder, Head
from handeye.trials.batch.row import Row
from handeye.trials.batch.trial import Job, Trial, row_of


def jobs_of(world: WorldSpec, numbers: Sequence[int]) -> list[Job]:
    """The trials of some numbers; the world of trial 0 is given."""
    return [
        Job(trial=k, world=msgspec.structs.replace(world, seed=world.seed + k)) for k in numbers
    ]  # fmt: skip


def head_of(trial: Trial, world: WorldSpec) -> Head:
    """What a batch is whose trial 0 has this world.

    Raises:
        InvalidInput: the installation is incomplete.
    """
    return Head(
        work=trial.work,
        plan=plan_digest(trial.plan),
        program=trial.plan.program.name,
        world=world,
        camera=trial.camera,
        without=trial.without,
        on_stop=trial.on_stop,
        simulated_limit_s=trial.simulated_limit_s,
        versions=versions(),
        code=code_digest(),
    )


def carry_out(
    trial: Trial,
    jobs: Sequence[Job],
    engine: Engine,
    *,
    folder: BatchFolder | None = None,
    told: Callable[[Row], None] = lambda _: None,
) -> tuple[Row, ...]:
    """The rows of trials, by their numbers; those that a folder has are not tried again.

    Args:
        told: is told each row as its trial ends.

    Raises:
        InvalidInput: a row cannot be written.
    """
    rows = {} if folder is None else dict(folder.rows)
    with closing(engine(trial, [job for job in jobs if job.trial not in rows])) as carried_out:
        for answer in carried_out:
            row = row_of(answer)
            if folder is not None:
                folder.append(row)
            rows[row.trial] = row
            told(row)
    return tuple(rows[job.trial] for job in jobs)
