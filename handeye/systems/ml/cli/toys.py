"""The commands of the toy blocks and the toy train, for one world and for many worlds."""

from handeye.cli.judged_jobs import ANY_FAULTY_RUN, FaultyJobOptions
from handeye.cli.sweeps import ANY, FirstSeed, SweepOptions
from handeye.cli.world_options import ANY_OWN_ERRORS, OwnErrorOptions
from handeye.systems.ml.cli.jobs import (
    JobSeed,
    NumberOfWorlds,
    carry_out,
    carry_out_trials,
)


def blocks(
    *, seed: JobSeed = 0, errors: OwnErrorOptions = ANY_OWN_ERRORS, options: FaultyJobOptions = ANY_FAULTY_RUN
) -> int:
    """Stack three toy blocks by touch.

    `plans/blocks.ml` grasps each block along x and then along y, so that the block lies in the middle of the hand. The
    program then puts the block down with a guarded move, which stops at a contact. A referee then checks that each
    block is centred on the block below to within 2 mm, and that no block leans by more than 2 degrees.

    Exit code 0: right; 1: the program has stopped before its end; 3: it has ended, but the referee disagrees; 2: bad
    input; 130: interrupted.
    """
    from handeye.systems.ml.run.jobs import job_plan

    return carry_out(job_plan("blocks"), seed, errors, options)


def train(
    *, seed: JobSeed = 0, errors: OwnErrorOptions = ANY_OWN_ERRORS, options: FaultyJobOptions = ANY_FAULTY_RUN
) -> int:
    """Couple an engine and two wagons by touch, by inserting each peg into its hole; then pull the train.

    `plans/train.ml` grasps each vehicle along y and then along x, so that the vehicle lies in the middle of the hand.
    The program lowers the peg of each wagon into the hole of the vehicle ahead; if a peg does not go in, the program
    tries places beside the hole. Then the hand pulls the engine forward by 50 mm. A referee checks that both wagons
    have followed the engine.

    Exit code 0: right; 1: the program has stopped before its end; 3: it has ended, but the referee disagrees; 2: bad
    input; 130: interrupted.
    """
    from handeye.systems.ml.run.jobs import job_plan

    return carry_out(job_plan("train"), seed, errors, options)


def blocks_trials(
    *,
    n: NumberOfWorlds = 10,
    seed: FirstSeed = 0,
    errors: OwnErrorOptions = ANY_OWN_ERRORS,
    options: SweepOptions = ANY,
) -> int:
    """Stack three blocks in many worlds. Shows the errors of the stack, and how often the stack is right.

    Each trial does what `handeye ml blocks` does. Ctrl-C ends the batch and prints the trials that have finished. If
    you gave --out, repeat the command to continue the batch.

    Exit code 0: no silent failure; 1: no trial finished; 3: a silent failure: in some trial, the program ended but
    the referee disagrees.
    """
    from handeye.systems.ml.run.job_trials import BLOCKS_TRIALS
    from handeye.systems.ml.run.jobs import job_plan

    return carry_out_trials(BLOCKS_TRIALS, job_plan("blocks"), n, seed, errors, options, title="three blocks")


def train_trials(
    *,
    n: NumberOfWorlds = 10,
    seed: FirstSeed = 0,
    errors: OwnErrorOptions = ANY_OWN_ERRORS,
    options: SweepOptions = ANY,
) -> int:
    """Couple a train in many worlds. Shows the errors of the train, and how often both wagons follow the engine.

    Each trial does what `handeye ml train` does. Ctrl-C ends the batch and prints the trials that have finished. If
    you gave --out, repeat the command to continue the batch.

    Exit code 0: no silent failure; 1: no trial finished; 3: a silent failure: in some trial, the program ended but
    the referee disagrees.
    """
    from handeye.systems.ml.run.job_trials import TRAIN_TRIALS
    from handeye.systems.ml.run.jobs import job_plan

    return carry_out_trials(
        TRAIN_TRIALS, job_plan("train"), n, seed, errors, options, title="a train of three"
    )
