"""The hand-eye system of 1973. It executes plans of motions, and stores camera calibrations."""

from handeye.core.entries import PLANNED, Entry

ENTRY = Entry(
    name=PLANNED,
    title="the system of 1973",
    help="Programs in the 1973 arm language, planned for an arm and run with camera, touch and force.",
    system="handeye.systems.stanford.executor_run:PROGRAM",
    can=(
        "plans",
        "undo",
        "compare",
        "faults",
        "levels",
        "senses",
        "video",
        "chaos",
        "format",
        "python",
        "leg",
    ),
    leg="handeye.systems.stanford.leg:LEGS",
    commands="""
cache = handeye.systems.stanford.cache:cache: List the kept camera calibrations and start states, or remove them.
""",
)
