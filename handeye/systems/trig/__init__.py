"""TRIG (MIT, 1982): programs taught by doing, drawn as they grow, and run forwards and backwards."""

from handeye.core.entries import Entry

ENTRY = Entry(
    name="trig",
    title="TRIG",
    help="Teach a program by doing, see it as it grows, run it backwards (MIT, 1982).",
    system="handeye.systems.trig.run.system:TAUGHT",
    can=("undo", "compare", "faults", "levels", "video", "chaos"),
    reasons={
        "python": "`handeye resume` goes on with one",
        "plans": "its programs are taught in the world they work in; `handeye trig palletise`, `handeye trig "
        "bucket` and `handeye trig run FILE` carry them out",
    },
    commands="""
trig = handeye.systems.trig.cli.commands:trig: TRIG (MIT, 1982): teach a program by doing, see it as it grows, run it backwards.
trials pallet = handeye.systems.trig.cli.jobs:pallet_trials: Palletise in many worlds, and take everything back: how often it comes out right, and how far off blocks are.
""",  # noqa: E501 - a command a line
    tasks={
        "palletise": "handeye.systems.trig.jobs.task:PALLET",
        "bucket": "handeye.systems.trig.jobs.task:BUCKET_TASK",
    },
    languages={
        ".trig": "handeye.systems.trig.own_language:LANGUAGE",
        ".trig.json": "handeye.systems.trig.own_language:LANGUAGE",
    },
    sweeps={"pallet": "handeye.systems.trig.run.pallet_trials:PALLET"},
    files=("job.json", "program.trig.json"),
)
