"""TRIG (MIT, 1982): the user teaches a program by doing the task. The program is displayed as it grows, and can be
run forwards and backwards.
"""

from handeye.core.entries import Entry

ENTRY = Entry(
    name="trig",
    title="TRIG",
    help="Teach a program by example, watch it grow, run it backwards (MIT, 1982).",
    system="handeye.systems.trig.run.system:TAUGHT",
    can=("undo", "compare", "faults", "levels", "video", "chaos", "leg"),
    leg="handeye.systems.trig.leg:LEGS",
    reasons={
        "python": "`handeye resume` continues a run",
        "plans": (
            "each program of TRIG is taught in the world in which the program runs; `handeye trig palletise`, "
            "`handeye trig bucket` and `handeye trig run FILE` teach and run a program"
        ),
    },
    commands="""
trig = handeye.systems.trig.cli.commands:trig: TRIG (MIT, 1982): teach a program by example, watch it grow, run it backwards.
trials pallet = handeye.systems.trig.cli.jobs:pallet_trials: Palletise in many worlds and undo it: success rate, and position errors of the blocks.
""",  # noqa: E501 - a command a line
    tasks={
        "palletise": "handeye.systems.trig.jobs.task:PALLET",
        "bucket": "handeye.systems.trig.jobs.task:BUCKET_TASK",
        "arrange": "handeye.systems.trig.jobs.task:ARRANGE",
    },
    languages={
        ".trig": "handeye.systems.trig.own_language:LANGUAGE",
        ".trig.json": "handeye.systems.trig.own_language:LANGUAGE",
    },
    programs="handeye.systems.trig.run.job:program_plan",
    sweeps={"pallet": "handeye.systems.trig.run.pallet_trials:PALLET"},
    environments={"handeye/Blocks-v0": "handeye.systems.trig.episodes.job:BLOCKS"},
    files=("job.json", "program.trig.json"),
)
