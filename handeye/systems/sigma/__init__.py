"""SUPERSIGMA (Milan, 1981): a central computer, microcomputers on a bus, and a programming language with tasks
and flags."""

from handeye.core.entries import Entry

ENTRY = Entry(
    name="sigma",
    title="SUPERSIGMA",
    help="Write parallel tasks in MAL, and try every order in which they may run (Milan, 1981).",
    system="handeye.systems.sigma.run.system:SIGMA",
    can=("faults", "levels", "video", "console", "chaos", "leg"),
    leg="handeye.systems.sigma.bridge.leg:LEGS",
    reasons={
        "plans": "`handeye sigma run FILE.mal` runs its programs",
        "undo": "its arms cannot reverse their motions; in the stepper, `back` returns the simulation to an earlier "
        "state",
    },
    commands="""
sigma = handeye.systems.sigma.cli.commands:sigma: SUPERSIGMA (Milan, 1981): programs in MAL, whose tasks run in parallel and are synchronised by flags.
trials chess = handeye.systems.sigma.cli.jobs:chess_trials: Sort chess pieces in many worlds: success rate, height and position errors.
trials prco = handeye.systems.sigma.cli.jobs:prco_trials: Assemble the plate of the pump in many worlds: success rate, depth and clamping force of the screws.
trials handover = handeye.systems.sigma.cli.jobs:handover_trials: Hand pieces from arm to arm in many worlds: success rate, and position errors.
trials insert = handeye.systems.sigma.cli.jobs:insert_trials: Find holes by force in many worlds: success rate, forces, and tries.
trials line = handeye.systems.sigma.cli.jobs:line_trials: Run an assembly line in many worlds: success rate, and position errors.
""",  # noqa: E501 - a command a line
    tasks={
        "mal": "handeye.systems.sigma.run.task:MAL_TASK",
        "gantries": "handeye.systems.sigma.gantries.task:GANTRIES",
        "chess": "handeye.systems.sigma.chess.task:CHESS",
        "handover": "handeye.systems.sigma.handover.task:HANDOVER",
        "insert": "handeye.systems.sigma.insert.task:INSERTION",
        "prco": "handeye.systems.sigma.prco.task:PRCO",
        "line": "handeye.systems.sigma.line.task:LINE",
    },
    languages={".mal": "handeye.systems.sigma.mal.language:LANGUAGE"},
    sweeps={
        "chess": "handeye.systems.sigma.run.job_trials:CHESS_TRIALS",
        "handover": "handeye.systems.sigma.run.job_trials:HANDOVER_TRIALS",
        "insert": "handeye.systems.sigma.run.job_trials:INSERTION_TRIALS",
        "prco": "handeye.systems.sigma.run.job_trials:PRCO_TRIALS",
        "line": "handeye.systems.sigma.run.job_trials:LINE_TRIALS",
    },
    programs="handeye.systems.sigma.run.jobs:program_plan",
    faults="handeye.systems.sigma.run.fault_trials:fault_trials",
    orders="handeye.systems.sigma.mal.orders:order_problems",
    exercises=("handeye.systems.sigma.order_exercise:SHARE",),
    environments={"handeye/Chess-v0": "handeye.systems.sigma.episodes.job:CHESS"},
    events="handeye.systems.sigma.mal.happenings:EVENTS",
)
