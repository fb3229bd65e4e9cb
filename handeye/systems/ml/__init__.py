"""MOS and ML (IBM, 1975). ML is a language of numbered statements in which sensors can stop motions. MOS is an
operating system that reads all sensors every ten milliseconds.
"""

from handeye.core.entries import Entry

ENTRY = Entry(
    name="ml",
    title="ML",
    help="Run programs in ML (IBM, 1975), whose motions stop when a sensor, read every 10 ms, passes a limit.",
    system="handeye.systems.ml.run.system:ML",
    can=("faults", "levels", "console", "video", "leg"),
    leg="handeye.systems.ml.leg:LEGS",
    reasons={
        "plans": "`handeye ml run FILE.ml` runs its programs",
        "undo": "no record of its motions is kept; in the stepper, `back` returns the simulation to an earlier state",
    },
    commands="""
ml = handeye.systems.ml.cli.commands:ml: ML (IBM, 1975): motions that stop when a sensor, read every 10 ms, passes a limit.
trials follow = handeye.systems.ml.cli.follow:follow_trials: Follow an outline by touch in many worlds: success rate, errors of the touches.
trials blocks = handeye.systems.ml.cli.toys:blocks_trials: Stack three blocks by touch in many worlds: success rate, position errors.
trials train = handeye.systems.ml.cli.toys:train_trials: Couple a toy train by touch in many worlds: success rate, position errors.
trials support = handeye.systems.ml.cli.support:support_trials: Assemble the rail support in many worlds: success rate, depths, forces.
trials orient = handeye.systems.ml.cli.parts:orient_trials: Turn a bar into a known attitude by touch in many worlds: success rate, errors.
trials bin = handeye.systems.ml.cli.parts:bin_trials: Take parts out of a bin and judge them by touch in many worlds: success rate.
trials typewriter = handeye.systems.ml.cli.support:typewriter_trials: Take a bar out of a bin, orient it, and assemble the rail support with it: success rate.
""",  # noqa: E501 - a command a line
    tasks={
        "ml": "handeye.systems.ml.run.task:ML_TASK",
        "rectilinear": "handeye.systems.ml.bench.hardware:RECTILINEAR",
        "follow": "handeye.systems.ml.follow.task:FOLLOW",
        "blocks": "handeye.systems.ml.blocks.task:BLOCKS",
        "train": "handeye.systems.ml.train.task:TRAIN",
        "support": "handeye.systems.ml.support.task:SUPPORT",
        "orient": "handeye.systems.ml.orient.task:ORIENT",
        "bin": "handeye.systems.ml.bin.task:BIN",
        "typewriter": "handeye.systems.ml.typewriter.task:TYPEWRITER",
    },
    languages={
        ".ml": "handeye.systems.ml.language.language:LANGUAGE",
        ".sym": "handeye.systems.ml.language.language:SYMBOLIC_LANGUAGE",
    },
    sweeps={
        "follow": "handeye.systems.ml.run.job_trials:FOLLOW_TRIALS",
        "blocks": "handeye.systems.ml.run.job_trials:BLOCKS_TRIALS",
        "train": "handeye.systems.ml.run.job_trials:TRAIN_TRIALS",
        "support": "handeye.systems.ml.run.job_trials:SUPPORT_TRIALS",
        "orient": "handeye.systems.ml.run.job_trials:ORIENT_TRIALS",
        "bin": "handeye.systems.ml.run.job_trials:BIN_TRIALS",
        "typewriter": "handeye.systems.ml.run.job_trials:TYPEWRITER_TRIALS",
    },
    programs="handeye.systems.ml.run.jobs:program_plan",
    faults="handeye.systems.ml.run.fault_trials:fault_trials",
    events="handeye.systems.ml.happenings:EVENTS",
    files=("tables.gz", "follow.json"),
)
